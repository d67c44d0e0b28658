#include <cmath>

#include "energy_equation.hpp"
#include "gaussConvectionScheme.H"
#include "upwind.H"

namespace cupel
{
EnergyEquation::EnergyEquation(const Scene& scene, Fields& fields)
    : scene_(scene), fields_(fields), losses_(scene),
      has_losses_(scene.physics.evaporation || scene.physics.radiation || scene.convection_coefficient > 0),
      iterations_(0)
{
    if (scene.physics.laser) laser_.reset(new LaserSource(scene, fields.mesh));
}

tmp<volScalarField> EnergyEquation::volumetric_enthalpy(const volScalarField& fraction) const
{
    const volScalarField& temperature = fields_.heat->temperature;
    tmp<volScalarField> result(
        map_field(temperature, "volumetric_enthalpy", dimEnergy / dimVolume, [](scalar) { return scalar(0); }));
    scalarField& enthalpy = result.ref().primitiveFieldRef();
    const scalar surrounding_capacity = scene_.surrounding.density * scene_.surrounding.specific_heat;
    forAll (enthalpy, cell) {
        enthalpy[cell] =
            max(fraction[cell], scalar(0)) * scene_.primary.density * scene_.primary.enthalpy(temperature[cell]) +
            max(1 - fraction[cell], scalar(0)) * surrounding_capacity * temperature[cell];
    }
    return result;
}

tmp<volScalarField> EnergyEquation::capacity() const
{
    const volScalarField& temperature = fields_.heat->temperature;
    tmp<volScalarField> result(
        map_field(temperature, "capacity", heat_capacity_dimensions, [](scalar) { return scalar(0); }));
    scalarField& values = result.ref().primitiveFieldRef();
    const scalar surrounding_capacity = scene_.surrounding.density * scene_.surrounding.specific_heat;
    forAll (values, cell) {
        values[cell] = max(fields_.fraction[cell], scalar(0)) * scene_.primary.density *
                           scene_.primary.enthalpy_slope(temperature[cell]) +
                       max(1 - fields_.fraction[cell], scalar(0)) * surrounding_capacity;
    }
    return result;
}

tmp<surfaceScalarField> EnergyEquation::conductivity() const
{
    const PrimaryMaterial& primary = scene_.primary;
    const volScalarField share(fields_.bounded_fraction());
    const dimensionedScalar surrounding("surrounding", conductivity_dimensions, scene_.surrounding.conductivity);
    return fvc::interpolate(
        share * map_field(fields_.heat->temperature, "primary_conductivity", conductivity_dimensions,
                          [&primary](scalar temperature) { return primary.conductivity(temperature); }) +
            (1.0 - share) * surrounding,
        "interpolate(conductivity)");
}

scalar EnergyEquation::stored_energy() const
{
    return volume_integral(volumetric_enthalpy(fields_.fraction)().primitiveField(), fields_.mesh);
}

tmp<volScalarField> EnergyEquation::primary_enthalpy() const
{
    const PrimaryMaterial& primary = scene_.primary;
    return tmp<volScalarField>(
        new volScalarField(IOobject("primary_enthalpy", fields_.mesh.time().timeName(), fields_.mesh, IOobject::NO_READ,
                                    IOobject::AUTO_WRITE),
                           map_field(fields_.heat->temperature, "primary_enthalpy", specific_energy_dimensions,
                                     [&primary](scalar temperature) { return primary.enthalpy(temperature); })));
}

void EnergyEquation::restore_from_enthalpy()
{
    IOobject file("volumetric_enthalpy", fields_.mesh.time().timeName(), fields_.mesh, IOobject::MUST_READ,
                  IOobject::NO_WRITE, false);
    if (!file.typeHeaderOk<volScalarField>()) return;
    const volScalarField enthalpy(file, fields_.mesh);
    volScalarField& T = fields_.heat->temperature;
    forAll (T, cell)
        T[cell] = inverted(cell, enthalpy[cell]);
    T.correctBoundaryConditions();
}

scalar EnergyEquation::inverted(label cell, scalar enthalpy) const
{
    const scalar share = fields_.fraction[cell];
    return scene_.primary.mixture_temperature(enthalpy, max(share, scalar(0)) * scene_.primary.density,
                                              max(1 - share, scalar(0)) * scene_.surrounding.density *
                                                  scene_.surrounding.specific_heat);
}

EnergyRates EnergyEquation::advance(const volVectorField& fraction_gradient)
{
    const fvMesh& mesh = fields_.mesh;
    volScalarField& T = fields_.heat->temperature;
    const dimensionedScalar step = mesh.time().deltaT();
    const PrimaryMaterial& primary = scene_.primary;
    EnergyRates rates;
    if (laser_.valid()) rates.laser = laser_->update(mesh.time().value() - 0.5 * step.value(), fields_.fraction);

    const volScalarField old_enthalpy(
        volumetric_enthalpy(scene_.physics.flow ? fields_.fraction.oldTime() : fields_.fraction));
    const dimensionedScalar primary_density("primary_density", dimDensity, primary.density);
    const dimensionedScalar surrounding_capacity("surrounding_capacity", heat_capacity_dimensions,
                                                 scene_.surrounding.density * scene_.surrounding.specific_heat);
    autoPtr<surfaceScalarField> other_flux;
    autoPtr<volScalarField> sharper_convection;
    if (scene_.physics.flow) {
        const surfaceScalarField& primary_flux = fields_.flow->fraction_flux;
        other_flux.reset(new surfaceScalarField("other_flux", fields_.flow->flux - primary_flux));
        // what a limited linear scheme has over upwind, for the primary material, from the old T
        const volScalarField enthalpy(
            map_field(T, "enthalpy", specific_energy_dimensions,
                      [&primary](scalar temperature) { return primary.enthalpy(temperature); }));
        sharper_convection.reset(new volScalarField(
            "sharper_convection", primary_density * (fvc::div(primary_flux, enthalpy, "div(phi,enthalpy)") -
                                                     fvc::div(primary_flux, enthalpy, "div(phi,enthalpy_upwind)"))));
    }

    const scalar tolerance = scene_.numerics.get<scalar>("temperature_tolerance");
    const label limit = scene_.numerics.get<label>("energy_iterations");
    scalar change = GREAT;
    for (iterations_ = 0; iterations_ < limit && change > tolerance; ++iterations_) {
        const volScalarField last_T("last_T", T);
        const volScalarField last_enthalpy(volumetric_enthalpy(fields_.fraction));
        const volScalarField heat_capacity(capacity());
        const surfaceScalarField k(conductivity());
        fvScalarMatrix equation(fvm::Sp(heat_capacity / step, T) - heat_capacity * last_T / step +
                                (last_enthalpy - old_enthalpy) / step - fvm::laplacian(k, T));
        autoPtr<surfaceScalarField> capacity_flux, known_flux;
        if (scene_.physics.flow) {
            // upwind enthalpy flux linearised about the last T: known part, and capacity times the new T
            const surfaceScalarField& primary_flux = fields_.flow->fraction_flux;
            const volScalarField slope(
                map_field(T, "slope", specific_energy_dimensions / dimTemperature,
                          [&primary](scalar temperature) { return primary.enthalpy_slope(temperature); }));
            const volScalarField enthalpy(
                map_field(T, "enthalpy", specific_energy_dimensions,
                          [&primary](scalar temperature) { return primary.enthalpy(temperature); }));
            const upwind<scalar> with_primary(mesh, primary_flux);
            capacity_flux.reset(new surfaceScalarField("capacity_flux", primary_density * primary_flux *
                                                                                with_primary.interpolate(slope) +
                                                                            surrounding_capacity * other_flux()));
            known_flux.reset(new surfaceScalarField(
                "known_flux",
                primary_density * primary_flux * with_primary.interpolate(enthalpy) +
                    surrounding_capacity * other_flux() * upwind<scalar>(mesh, other_flux()).interpolate(T) -
                    capacity_flux() * upwind<scalar>(mesh, capacity_flux()).interpolate(T)));
            fv::gaussConvectionScheme<scalar> scheme(
                mesh, capacity_flux(),
                tmp<surfaceInterpolationScheme<scalar>>(new upwind<scalar>(mesh, capacity_flux())));
            equation += fvc::surfaceIntegrate(known_flux()) + scheme.fvmDiv(capacity_flux(), T) + sharper_convection();
        }
        if (laser_.valid()) equation -= laser_->power_density();
        if (has_losses_) {
            // Q(T*) = Q(T) + dQ/dT (T* − T), implicit in T*
            losses_.update(fields_, fraction_gradient);
            equation.source() -= (losses_.loss() - losses_.slope() * last_T.primitiveField()) * mesh.V().field();
            equation.diag() += losses_.slope() * mesh.V().field();
        }
        if (!std::isfinite(equation.solve().initialResidual()))
            break; // the guards say where; a second solve would fail

        // what crossed the borders, at the temperature that the linear system was solved for: exact for the step taken
        rates.conducted_in = rates.convected_out = 0;
        forAll (T.boundaryField(), patch) {
            const fvPatchScalarField& faces = T.boundaryField()[patch];
            if (faces.coupled() || faces.empty()) continue;
            rates.conducted_in += sum(k.boundaryField()[patch] * faces.snGrad() * mesh.magSf().boundaryField()[patch]);
            if (scene_.physics.flow)
                rates.convected_out +=
                    sum(known_flux().boundaryField()[patch] + capacity_flux().boundaryField()[patch] * faces);
        }
        reduce(rates.conducted_in, sumOp<scalar>());
        reduce(rates.convected_out, sumOp<scalar>());
        if (has_losses_)
            rates.surface_losses = volume_integral(
                losses_.loss() + losses_.slope() * (T.primitiveField() - last_T.primitiveField()), mesh);

        // the enthalpy that the solution means, inverted for the mixture
        change = 0;
        forAll (T, cell) {
            const scalar enthalpy = last_enthalpy[cell] + heat_capacity[cell] * (T[cell] - last_T[cell]);
            T[cell] = inverted(cell, enthalpy);
            change = max(change, mag(T[cell] - last_T[cell]));
        }
        reduce(change, maxOp<scalar>());
        T.correctBoundaryConditions();
    }
    return rates;
}
} // namespace cupel
