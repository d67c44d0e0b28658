#include "integrators/two_phase_flow.hpp"

#include <algorithm>

#include "models/density_summation.hpp"
#include "models/momentum.hpp"

namespace cupel::inline CUPEL_ENGINE
{

TwoPhaseFlow::TwoPhaseFlow(Scene& scene, const FlowParameters& parameters, const ScalarField& mobility)
    : Flow(scene, parameters, mobility), viscosity_(particles_.add_scalar({"viscosity", "Pa s"})),
      transport_force_(particles_.add_vector({"transport_force", "N"}))
{
    double heaviest = 0.0;
    for (const Material& material : scene.materials)
        heaviest = std::max(heaviest, material.density);
    if (temperature_gradient_)
        correction_ = std::make_unique<CorrectionMatrix>(CorrectionMatrix::register_in(particles_));
    const double sound_speed = parameters.equation_of_state.sound_speed;
    stiffness_ = heaviest * sound_speed * sound_speed;
    for (Index i = 0; i < particles_.count(); ++i)
        viscosity_[i] = scene.materials[particles_.material[static_cast<std::size_t>(i)]].viscosity.value();
}

void TwoPhaseFlow::drift(const Neighbourhood& neighbourhood, double time_step)
{
    neighbourhood.for_each_moving([&](Index i) {
        const Vector transport = (0.5 * time_step / particles_.mass[i]) * transport_force_[i];
        particles_.position.set(i, particles_.position[i] + time_step * (particles_.velocity[i] + transport));
    });
}

void TwoPhaseFlow::evaluate(const Neighbourhood& neighbourhood, double)
{
    const auto& list = neighbourhood.list();
    for_each_pair(list, particles_, kernel_, neighbourhood.moving(),
                  DensitySummation{mobility_, particles_.mass, particles_.volume, particles_.density});
    neighbourhood.for_each_moving([&](Index i) {
        const double rest = scene_.materials[particles_.material[static_cast<std::size_t>(i)]].density;
        particles_.pressure[i] = stiffness_ * (particles_.density[i] / rest - 1.0);
    });
    for_each_pair(list, particles_, kernel_, neighbourhood.standing(), wall_extrapolation(true));
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
    for_each_pair(list, particles_, kernel_, neighbourhood.moving(),
                  TwoPhaseMomentum{mobility_, particles_.volume, particles_.density, particles_.pressure, viscosity_,
                                   particles_.velocity, parameters_.background_pressure, force_, transport_force_});
    if (temperature_gradient_) find_temperature_gradient(neighbourhood, *correction_);
    add_remedies(neighbourhood);
    accelerate(neighbourhood);
}

} // namespace cupel::inline CUPEL_ENGINE
