#include <cmath>

#include "time_step.hpp"

namespace cupel
{
namespace
{
const scalar growth = 1.2; // a step is at most so much longer than the one before
}

TimeStep::TimeStep(const Scene& scene, const Fields& fields)
    : scene_(scene), fields_(fields), smallest_cell_(scene.spacing), gravity_speed_(0),
      last_(1e-3 * scene.output_interval), taken_(0), longer_(0)
{
    if (!scene.physics.flow || !scene.physics.gravity) return;
    // the difference of g·x over the scene is g H
    const scalarField& potential = fields.flow->gravity_potential.primitiveField();
    gravity_speed_ = Foam::sqrt(gMax(potential) - gMin(potential));
}

scalar TimeStep::flux_rate(scalar low, scalar high) const
{
    const surfaceScalarField& flux = fields_.flow->flux;
    const scalarField sums(fvc::surfaceSum(mag(flux))().primitiveField() / fields_.mesh.V().field());
    scalar greatest = 0;
    forAll (sums, cell)
        if (fields_.fraction[cell] > low && fields_.fraction[cell] < high) greatest = max(greatest, 0.5 * sums[cell]);
    reduce(greatest, maxOp<scalar>());
    return greatest;
}

scalar TimeStep::courant(scalar step) const
{
    return scene_.physics.flow ? step * flux_rate(-GREAT, GREAT) : 0;
}

scalar TimeStep::next(scalar time, scalar target)
{
    std::string name = "output";
    scalar limit = scene_.output_interval;
    const auto consider = [&name, &limit](const std::string& candidate, scalar value) {
        if (value < limit) {
            limit = value;
            name = candidate;
        }
    };
    const PrimaryMaterial& primary = scene_.primary;
    const SurroundingMaterial& surrounding = scene_.surrounding;
    const scalar factor = scene_.numerics.get<scalar>("time_step_factor");
    if (scene_.physics.flow) {
        if (scene_.physics.surface_tension && primary.surface_tension_at_reference > 0) {
            consider("capillary",
                     factor * Foam::sqrt((primary.density + surrounding.density) * pow3(smallest_cell_) /
                                         (4 * constant::mathematical::pi * primary.surface_tension_at_reference)));
        }
        const scalar viscosity =
            max(4 * primary.viscosity / primary.density, surrounding.viscosity / surrounding.density);
        consider("viscous", factor * sqr(smallest_cell_) / max(viscosity, VSMALL));
        if (scene_.physics.gravity)
            consider("gravity", factor * scene_.numerics.get<scalar>("courant_limit") * smallest_cell_ /
                                    max(gravity_speed_, VSMALL));
        consider("courant",
                 factor * scene_.numerics.get<scalar>("courant_limit") / max(flux_rate(-GREAT, GREAT), VSMALL));
        consider("interface_courant",
                 factor * scene_.numerics.get<scalar>("interface_courant_limit") / max(flux_rate(0.01, 0.99), VSMALL));
    }
    else if (scene_.physics.heat) {
        const scalar diffusivity = primary.conductivity_liquid / (primary.density * primary.specific_heat_liquid);
        consider("diffusion", factor * sqr(smallest_cell_) / (4 * max(diffusivity, VSMALL)));
    }
    if (scene_.physics.laser && scene_.laser->speed > 0)
        consider("laser", factor * 0.25 * scene_.laser->spot_radius / scene_.laser->speed);
    consider("growth", growth * last_);
    ++binding_[name];
    last_ = limit;
    const scalar steps = std::ceil((target - time) / limit - 1e-6);
    const scalar step = (target - time) / max(steps, scalar(1));
    longer_ = taken_ > 0 ? step - taken_ : 0;
    taken_ = step;
    return step;
}

void TimeStep::save(dictionary& entries) const
{
    entries.set("last_limit", last_);
    entries.set("taken", taken_);
    dictionary counts;
    for (const auto& entry : binding_)
        counts.set(word(entry.first), entry.second);
    entries.set("binding", counts);
}

void TimeStep::restore(const dictionary& entries)
{
    entries.readEntry("last_limit", last_);
    entries.readEntry("taken", taken_);
    const dictionary& counts = entries.subDict("binding");
    for (const word& name : counts.toc())
        binding_[name] = counts.get<label>(name);
}
} // namespace cupel
