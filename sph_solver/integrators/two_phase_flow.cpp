#include "integrators/two_phase_flow.hpp"

#include <algorithm>
#include <cmath>

#include "models/density_summation.hpp"
#include "models/momentum.hpp"
#include "models/viscous_traction.hpp"

namespace cupel::inline CUPEL_ENGINE
{

TwoPhaseFlow::TwoPhaseFlow(Scene& scene, const FlowParameters& parameters, const ScalarField& mobility)
    : Flow(scene, parameters, mobility), viscosity_(particles_.add_scalar({"viscosity", "Pa s"})),
      transport_rate_(particles_.add_scalar({"transport_rate", "m3/s"})),
      imbalance_(particles_.add_scalar({"pressure_imbalance", "W"})),
      transport_velocity_(particles_.add_vector({"transport_velocity", "m/s"}))
{
    double heaviest = 0.0;
    for (const Material& material : scene.materials)
        heaviest = std::max(heaviest, material.density);
    double most_viscous = 0.0;
    least_viscosity_ = scene.materials.front().viscosity.value();
    for (const Material& material : scene.materials) {
        least_viscosity_ = std::min(least_viscosity_, material.viscosity.value());
        most_viscous = std::max(most_viscous, material.viscosity.value());
    }
    if (most_viscous > least_viscosity_) stress_gradient_.emplace(VelocityGradientFields::register_in(particles_));
    if (temperature_gradient_ || stress_gradient_) correction_.emplace(CorrectionMatrix::register_in(particles_));
    const double sound_speed = parameters.equation_of_state.sound_speed;
    stiffness_ = heaviest * sound_speed * sound_speed;
    for (Index i = 0; i < particles_.count(); ++i)
        viscosity_[i] = scene.materials[particles_.material[static_cast<std::size_t>(i)]].viscosity.value();
}

void TwoPhaseFlow::drift(const Neighbourhood& neighbourhood, double time_step)
{
    neighbourhood.for_each_moving([&](Index i) {
        particles_.position.set(i,
                                particles_.position[i] + time_step * (particles_.velocity[i] + transport_velocity_[i]));
    });
}

/// Both phases have the heavier one's stiffness.
double TwoPhaseFlow::elastic_energy(Index i) const
{
    const double rest = scene_.materials[particles_.material[static_cast<std::size_t>(i)]].density;
    return EquationOfState{std::sqrt(stiffness_ / rest)}.elastic_energy(particles_.density[i], rest);
}

void TwoPhaseFlow::evaluate(const Neighbourhood& neighbourhood, double time_step)
{
    const auto& list = neighbourhood.list();
    const auto& moving = neighbourhood.moving_particles();
    const auto elastic = [&] {
        return ordered_sum(static_cast<Index>(moving.size()), [&](Index m) {
            const Index i = moving[static_cast<std::size_t>(m)];
            return particles_.mass[i] * elastic_energy(i);
        });
    };
    const double before = elastic();
    for_each_pair(list, particles_, kernel_, neighbourhood.moving(),
                  DensitySummation{mobility_, particles_.mass, transport_velocity_, particles_.volume,
                                   particles_.density, transport_rate_});
    MechanicalWork work;
    work.density_diffusion = ordered_sum(static_cast<Index>(moving.size()), [&](Index m) {
        const Index i = moving[static_cast<std::size_t>(m)];
        const double rest = scene_.materials[particles_.material[static_cast<std::size_t>(i)]].density;
        const double pressure = particles_.pressure[i];
        particles_.pressure[i] = stiffness_ * (particles_.density[i] / rest - 1.0);
        return -time_step * 0.5 * (pressure + particles_.pressure[i]) * transport_rate_[i];
    });
    work.compression = time_step > 0.0 ? elastic() - before - work.density_diffusion : 0.0;
    books_ += work;
    for_each_pair(list, particles_, kernel_, neighbourhood.standing(), wall_extrapolation(true, particles_.pressure));
    const double lattice_volume = scene_.particle_volume();
    for (const Index c : neighbourhood.standing()) {
        const Cluster cluster = list.cluster(c);
        for (Index i = cluster.first; i < cluster.first + cluster.count; ++i)
            if (mobility_.weight[i] == 0.0)
                particles_.volume[i] = lattice_volume / (1.0 + particles_.pressure[i] / stiffness_);
    }
    if (surface_) {
        for_each_pair(list, particles_, kernel_, neighbourhood.moving(), surface_->colour_gradient());
        surface_->find(neighbourhood);
    }
    find_forces(neighbourhood);
    books_.imbalance += time_step * ordered_sum(static_cast<Index>(moving.size()), [&](Index m) {
                            return imbalance_[moving[static_cast<std::size_t>(m)]];
                        });
    add_up_forces(neighbourhood);
    find_load(neighbourhood);
    accelerate(neighbourhood);
}

void TwoPhaseFlow::find_forces(const Neighbourhood& neighbourhood)
{
    const auto sum = [&](const auto&... terms) {
        for_each_pair(neighbourhood.list(), particles_, kernel_, neighbourhood.moving(), terms...);
    };
    const TwoPhaseMomentum momentum{mobility_,      particles_.volume,   particles_.density,    particles_.pressure,
                                    viscosity_,     particles_.velocity, parameters_.transport, pressure_force_,
                                    viscous_force_, imbalance_,          transport_velocity_};
    if (temperature_gradient_) find_temperature_gradient(neighbourhood, *correction_);
    if (!stress_gradient_) return sum(momentum);
    // What all of the space has of a viscosity leaves no traction, and its noise can be spared.
    if (!temperature_gradient_) sum(GradientCorrection{mobility_, scene_.dimensions, particles_.volume, *correction_});
    sum(VelocityGradient{mobility_, particles_.volume, particles_.velocity, *correction_, *stress_gradient_});
    neighbourhood.for_each_moving([&](Index i) {
        for (VectorField* row : {&stress_gradient_->x, &stress_gradient_->y, &stress_gradient_->z})
            row->set(i, (viscosity_[i] - least_viscosity_) * (*row)[i]);
    });
    // The second adds to what the first has just stored for the same cluster.
    sum(momentum, ViscousTraction{mobility_, particles_.volume, *stress_gradient_, 1.0, viscous_force_});
}

} // namespace cupel::inline CUPEL_ENGINE
