#include "integrators/two_phase_flow.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/lattice_sum.hpp"
#include "models/density_summation.hpp"
#include "models/interface_pressure.hpp"
#include "models/momentum.hpp"
#include "models/sound.hpp"
#include "models/transport_velocity.hpp"
#include "models/viscosity_jump.hpp"

namespace cupel::inline CUPEL_ENGINE
{

TwoPhaseFlow::TwoPhaseFlow(Scene& scene, const FlowParameters& parameters, const ScalarField& mobility)
    : Flow(scene, parameters, mobility), viscosity_(particles_.add_scalar({"viscosity", "Pa s"})),
      liquid_number_(particles_.add_scalar({"wall_liquid_number", "1/m3"})),
      liquid_number_at_start_(particles_.add_scalar({"wall_liquid_number_at_start", "1/m3"})),
      transport_number_(particles_.add_scalar({"wall_transport_number", "1/(m3 s)"})),
      wall_energy_(particles_.add_scalar({"wall_elastic_energy", "J"})),
      transport_rate_(particles_.add_scalar({"transport_rate", "m3/s"})),
      volume_potential_(particles_.add_scalar({"volume_potential", "1/s"})),
      transport_velocity_(particles_.add_vector({"transport_velocity", "m/s"}))
{
    double heaviest = 0.0;
    for (const Material& material : scene.materials)
        heaviest = std::max(heaviest, material.density);
    least_viscosity_ = scene.materials.front().viscosity.value();
    double most_viscous = 0.0;
    for (const Material& material : scene.materials) {
        least_viscosity_ = std::min(least_viscosity_, material.viscosity.value());
        most_viscous = std::max(most_viscous, material.viscosity.value());
    }
    viscosity_jumps_ = most_viscous > least_viscosity_;
    transports_ = scene.definition.numerics.shifting > 0.0;
    if (viscosity_jumps_ || transports_) velocity_gradient_.emplace(VelocityGradientFields::register_in(particles_));
    if (load_ && !band_bears_load_) {
        excess_pressure_ = &particles_.add_scalar({"excess_pressure", "Pa"});
        carried_load_ = &particles_.add_scalar({"carried_load", "Pa"});
        carried_load_of_other_ = &particles_.add_scalar({"carried_load_of_other", "Pa"});
        carried_mean_ = &particles_.add_scalar({"carried_load_mean", "Pa"});
        carried_acceleration_ = &particles_.add_vector({"carried_load_acceleration", "m/s2"});
    }
    if (load_ && scene.definition.numerics.acoustic_substeps > 1) hold_surface_forces();
    if (temperature_gradient_ || velocity_gradient_ || carried_load_)
        correction_.emplace(CorrectionMatrix::register_in(particles_));
    lattice_number_ = sum_over_lattice(kernel_, scene.spacing, scene.dimensions);
    lattice_crowding_ = lattice_number_ * scene.particle_volume;
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

/// Both phases have the heavier one's stiffness, and no pressure on the lattice that they start from,
/// p = K (ρ/ρ₀ − C), C = V Σ W there. C is 1 but for what the kernel's sum over a lattice misses (−6·10⁻⁵ in two
/// dimensions), and yet: with 1 in its place all of the space is under a tension of K (1 − C), fifty times the viscous
/// stress around a drop that migrates, and uneven places then feel a force that makes them more so.
double TwoPhaseFlow::elastic_energy(Index i) const
{
    const double rest = scene_.materials[particles_.material[static_cast<std::size_t>(i)]].density;
    return EquationOfState{std::sqrt(stiffness_ / rest)}.elastic_energy(particles_.density[i],
                                                                        rest * lattice_crowding_);
}

void TwoPhaseFlow::evaluate(const Neighbourhood& neighbourhood, double time_step)
{
    const double sound = time_step - sound_ahead_;
    sound_ahead_ = 0.0;
    compress(neighbourhood, sound);
    for_each_pair(neighbourhood.list(), particles_, kernel_, neighbourhood.standing(), wall_velocity(),
                  wall_compression());
    compress_walls(neighbourhood, time_step == 0.0, sound);
    if (surface_ && time_step == 0.0) surface_->start(neighbourhood);
    find_gradients(neighbourhood);
    if (surface_) surface_->find(neighbourhood);
    find_forces(neighbourhood);
    add_up_forces(neighbourhood);
    find_load(neighbourhood, temperature_gradient_ != nullptr);
    if (carried_load_) carry_load(neighbourhood, time_step == 0.0);
    accelerate(neighbourhood);
}

void TwoPhaseFlow::evaluate_sound(const Neighbourhood& neighbourhood, const SoundStep& step)
{
    compress(neighbourhood, step.time_step);
    for_each_pair(neighbourhood.list(), particles_, kernel_, neighbourhood.standing(), wall_compression());
    compress_walls(neighbourhood, false, step.time_step);
    for_each_pair(neighbourhood.list(), particles_, kernel_, neighbourhood.moving(),
                  TwoPhasePressureForce{mobility_, particles_.volume, *excess_pressure_, pressure_force_});
    sound_ahead_ += step.time_step;
}

/// Densities and pressures at the new places, to which the last time_step has led.
void TwoPhaseFlow::compress(const Neighbourhood& neighbourhood, double time_step)
{
    const auto& moving = neighbourhood.moving_particles();
    const auto elastic = [&] {
        return ordered_sum(static_cast<Index>(moving.size()), [&](Index m) {
            const Index i = moving[static_cast<std::size_t>(m)];
            return particles_.mass[i] * elastic_energy(i);
        });
    };
    const double before = elastic();
    for_each_pair(neighbourhood.list(), particles_, kernel_, neighbourhood.moving(),
                  DensitySummation{mobility_, particles_.mass, transport_velocity_, particles_.volume,
                                   particles_.density, transport_rate_});
    MechanicalWork work;
    work.density_diffusion = ordered_sum(static_cast<Index>(moving.size()), [&](Index m) {
        const Index i = moving[static_cast<std::size_t>(m)];
        const double rest = scene_.materials[particles_.material[static_cast<std::size_t>(i)]].density;
        double& pressure = (*excess_pressure_)[i];
        const double pressure_before = pressure;
        pressure = stiffness_ * (particles_.density[i] / rest - lattice_crowding_);
        return -time_step * 0.5 * (pressure_before + pressure) * transport_rate_[i];
    });
    work.compression = time_step > 0.0 ? elastic() - before - work.density_diffusion : 0.0;
    books_ += work;
}

/// Walls feel the liquid before them as liquid would, by the number of it that has just been summed.
void TwoPhaseFlow::compress_walls(const Neighbourhood& neighbourhood, bool at_start, double time_step)
{
    const NeighbourList& list = neighbourhood.list();
    const double lattice_volume = scene_.particle_volume;
    double change = 0.0, transported = 0.0;
    for (const Index c : neighbourhood.standing()) {
        const Cluster cluster = list.cluster(c);
        for (Index i = cluster.first; i < cluster.first + cluster.count; ++i) {
            if (mobility_.weight[i] != 0.0) continue;
            if (at_start) liquid_number_at_start_[i] = liquid_number_[i];
            const double crowding = lattice_volume * (lattice_number_ + liquid_number_[i] - liquid_number_at_start_[i]);
            const double pressure = stiffness_ * (crowding - lattice_crowding_), volume = lattice_volume / crowding;
            transported +=
                time_step * 0.5 * ((*excess_pressure_)[i] + pressure) * volume * volume * transport_number_[i];
            particles_.volume[i] = volume;
            (*excess_pressure_)[i] = pressure;
            const double energy =
                stiffness_ * lattice_volume * EquationOfState{1.0}.elastic_energy(crowding, lattice_crowding_);
            change += energy - wall_energy_[i];
            wall_energy_[i] = energy;
        }
    }
    // What motion, and not the transport of places, has done to walls.
    books_.imbalance -= change - transported;
}

/// Everything that needs nothing but places and volumes: the matrices that correct gradients, the gradients of velocity
/// and temperature, and that of colour.
void TwoPhaseFlow::find_gradients(const Neighbourhood& neighbourhood)
{
    const auto sum = [&](const auto&... terms) {
        for_each_pair(neighbourhood.list(), particles_, kernel_, neighbourhood.moving(), terms...);
    };
    const auto sum_with_colour = [&](const auto&... others) {
        surface_ ? sum(others..., surface_->colour_gradient<true>()) : sum(others...);
    };
    const auto sum_with_velocity = [&](const auto&... others) {
        // The gradient reads the matrix that has just been stored for the same cluster.
        if (!velocity_gradient_) return sum_with_colour(others...);
        sum_with_colour(others..., VelocityGradient{mobility_, particles_.velocity, *correction_, *velocity_gradient_});
    };
    if (!correction_) {
        if (surface_) sum(surface_->colour_gradient<true>());
        return;
    }
    sum_with_velocity(GradientCorrection{mobility_, scene_.dimensions, *correction_});
}

/// Forces between particles, and in the same pass the transport velocity of the next drift and what Marangoni flow
/// needs of temperature.
void TwoPhaseFlow::find_forces(const Neighbourhood& neighbourhood)
{
    const auto sum = [&](const auto&... terms) {
        for_each_pair(neighbourhood.list(), particles_, kernel_, neighbourhood.moving(), terms...);
    };
    const TwoPhaseMomentum momentum{mobility_,           particles_.volume, *excess_pressure_, viscosity_,
                                    particles_.velocity, pressure_force_,   viscous_force_};
    start_artificial_force(neighbourhood);
    // What follows momentum adds to what it has just stored for the same cluster.
    const auto sum_with_remedies = [&](const auto&... others) {
        artificial_force_ ? sum(momentum, others..., artificial_viscosity(), artificial_stress())
                          : sum(momentum, others...);
    };
    const auto sum_with_transport = [&](const auto&... others) {
        if (!transports_) return sum_with_remedies(others...);
        neighbourhood.for_each_moving(
            [&](Index i) { volume_potential_[i] -= transport_rate_[i] / particles_.volume[i]; });
        // Chosen on a drop at rest and one that Marangoni stress drives (static_drop, thermocapillary_drop, both
        // judged): 10 times the strength of a free surface's shifting, since momentum does not follow, and never
        // faster than c₀/100.
        sum_with_remedies(others...,
                          TransportVelocity{mobility_, 10.0 * scene_.definition.numerics.shifting,
                                            parameters_.smoothing_length,
                                            0.02 * parameters_.equation_of_state.sound_speed, particles_.volume,
                                            *velocity_gradient_, volume_potential_, transport_velocity_});
    };
    const auto sum_with_temperature = [&](const auto&... others) {
        if (!temperature_gradient_) return sum_with_transport(others...);
        sum_with_transport(others..., surface_temperature_gradient(), surface_temperature());
    };
    if (viscosity_jumps_)
        sum_with_temperature(ViscosityJump{mobility_, particles_.volume, *velocity_gradient_, viscosity_,
                                           least_viscosity_, viscous_force_});
    else
        sum_with_temperature();
    if (temperature_gradient_) correct_temperature_gradient(neighbourhood, *correction_);
}

/// The load on the interface as a pressure in both phases, one sweep further than the last, and its force. A run starts
/// with its mean over the interface in all of the primary phase.
void TwoPhaseFlow::carry_load(const Neighbourhood& neighbourhood, bool at_start)
{
    const SurfaceFields& surface = surface_->fields();
    const auto& moving = neighbourhood.moving_particles();
    if (at_start) {
        double sum = 0.0, weight = 0.0;
        for (const Index i : moving) {
            sum += surface.delta[i] * (*load_)[i];
            weight += surface.delta[i];
        }
        for (const Index i : moving)
            (*carried_mean_)[i] = weight > 0.0 ? surface.colour[i] * sum / weight : 0.0;
    }
    neighbourhood.for_each_moving([&](Index i) { (*carried_load_)[i] = (*carried_mean_)[i]; });
    for_each_pair(neighbourhood.list(), particles_, kernel_, neighbourhood.standing(),
                  WallInterfacePressure{mobility_, surface.colour, *carried_load_, *carried_load_of_other_});
    for_each_pair(neighbourhood.list(), particles_, kernel_, neighbourhood.moving(),
                  InterfacePressure{mobility_, particles_.volume, particles_.density, surface.colour, surface.delta,
                                    *load_, *carried_load_, *carried_load_of_other_, *correction_, *carried_mean_,
                                    *carried_acceleration_});
    neighbourhood.for_each_moving([&](Index i) {
        force_.set(i, force_[i] + particles_.mass[i] * (*carried_acceleration_)[i]);
        particles_.pressure[i] = (*excess_pressure_)[i] + (*carried_load_)[i];
    });
}

} // namespace cupel::inline CUPEL_ENGINE
