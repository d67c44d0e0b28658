#include "integrators/two_phase_flow.hpp"

#include <algorithm>
#include <cmath>

#include "models/density_summation.hpp"
#include "models/interface_pressure.hpp"
#include "models/momentum.hpp"
#include "models/shifting.hpp"
#include "models/viscous_traction.hpp"
#include "models/wall_compression.hpp"

namespace cupel::inline CUPEL_ENGINE
{

namespace
{

/// Σ W over a lattice, 1/m³: near 1/Δx³ and not quite.
double lattice_number(const SmoothingKernel& kernel, double spacing, int dimensions)
{
    const int reach = static_cast<int>(std::ceil(kernel.support() / spacing)), across = dimensions == 2 ? 0 : reach;
    double sum = 0.0;
    for (int x = -reach; x <= reach; ++x)
        for (int y = -across; y <= across; ++y)
            for (int z = -reach; z <= reach; ++z)
                if (const double r = spacing * std::sqrt(x * x + y * y + z * z); r < kernel.support())
                    sum += kernel(r).value;
    return sum;
}

} // namespace

TwoPhaseFlow::TwoPhaseFlow(Scene& scene, const FlowParameters& parameters, const ScalarField& mobility)
    : Flow(scene, parameters, mobility), viscosity_(particles_.add_scalar({"viscosity", "Pa s"})),
      liquid_number_(particles_.add_scalar({"wall_liquid_number", "1/m3"})),
      liquid_number_at_start_(particles_.add_scalar({"wall_liquid_number_at_start", "1/m3"})),
      transport_number_(particles_.add_scalar({"wall_transport_number", "1/(m3 s)"})),
      wall_energy_(particles_.add_scalar({"wall_elastic_energy", "J"})),
      transport_rate_(particles_.add_scalar({"transport_rate", "m3/s"})),
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
    viscosities_differ_ = most_viscous > least_viscosity_;
    if (scene.definition.numerics.shifting > 0.0) transport_speed_ = &particles_.add_scalar({"transport_speed", "m/s"});
    if (viscosities_differ_ || transport_speed_)
        velocity_gradient_.emplace(VelocityGradientFields::register_in(particles_));
    if (load_) {
        excess_pressure_ = &particles_.add_scalar({"excess_pressure", "Pa"});
        carried_load_ = &particles_.add_scalar({"carried_load", "Pa"});
        carried_load_of_other_ = &particles_.add_scalar({"carried_load_of_other", "Pa"});
        carried_mean_ = &particles_.add_scalar({"carried_load_mean", "Pa"});
        carried_acceleration_ = &particles_.add_vector({"carried_load_acceleration", "m/s2"});
    }
    if (temperature_gradient_ || velocity_gradient_ || carried_load_)
        correction_.emplace(CorrectionMatrix::register_in(particles_));
    lattice_number_ = lattice_number(kernel_, scene.spacing, scene.dimensions);
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
        double& pressure = (*excess_pressure_)[i];
        const double pressure_before = pressure;
        pressure = stiffness_ * (particles_.density[i] / rest - 1.0);
        return -time_step * 0.5 * (pressure_before + pressure) * transport_rate_[i];
    });
    work.compression = time_step > 0.0 ? elastic() - before - work.density_diffusion : 0.0;
    books_ += work;
    compress_walls(neighbourhood, time_step);
    if (surface_) {
        for_each_pair(list, particles_, kernel_, neighbourhood.moving(), surface_->colour_gradient());
        surface_->find(neighbourhood);
    }
    find_forces(neighbourhood);
    add_up_forces(neighbourhood);
    find_load(neighbourhood);
    if (carried_load_) carry_load(neighbourhood, time_step == 0.0);
    accelerate(neighbourhood);
}

/// Walls feel the liquid before them as liquid would; they have its extrapolated velocity, for viscosity.
void TwoPhaseFlow::compress_walls(const Neighbourhood& neighbourhood, double time_step)
{
    const NeighbourList& list = neighbourhood.list();
    for_each_pair(list, particles_, kernel_, neighbourhood.standing(), wall_velocity(),
                  WallCompression{mobility_, transport_velocity_, liquid_number_, transport_number_});
    const double lattice_volume = scene_.particle_volume();
    double change = 0.0, transported = 0.0;
    for (const Index c : neighbourhood.standing()) {
        const Cluster cluster = list.cluster(c);
        for (Index i = cluster.first; i < cluster.first + cluster.count; ++i) {
            if (mobility_.weight[i] != 0.0) continue;
            if (time_step == 0.0) liquid_number_at_start_[i] = liquid_number_[i];
            const double crowding = lattice_volume * (lattice_number_ + liquid_number_[i] - liquid_number_at_start_[i]);
            const double pressure = stiffness_ * (crowding - 1.0), volume = lattice_volume / crowding;
            transported +=
                time_step * 0.5 * ((*excess_pressure_)[i] + pressure) * volume * volume * transport_number_[i];
            particles_.volume[i] = volume;
            (*excess_pressure_)[i] = pressure;
            const double energy = stiffness_ * lattice_volume * EquationOfState{1.0}.elastic_energy(crowding, 1.0);
            change += energy - wall_energy_[i];
            wall_energy_[i] = energy;
        }
    }
    // What motion, and not the transport of places, has done to walls.
    books_.imbalance -= change - transported;
}

void TwoPhaseFlow::find_forces(const Neighbourhood& neighbourhood)
{
    const auto sum = [&](const auto&... terms) {
        for_each_pair(neighbourhood.list(), particles_, kernel_, neighbourhood.moving(), terms...);
    };
    if (velocity_gradient_) {
        // The gradient reads the matrix that has just been stored for the same cluster.
        sum(GradientCorrection{mobility_, scene_.dimensions, *correction_},
            VelocityGradient{mobility_, particles_.velocity, *correction_, *velocity_gradient_});
        if (transport_speed_) {
            // Fitted on a drop that Marangoni stress drives (thermocapillary_drop, greatest error at coarse): 4 times
            // the strength of a free surface's shifting, since momentum does not follow (1: 35 %, 2: 14 %, 5: 7.7 %,
            // 15: 8.8 %, and with 5 a drop at rest is stirred by 1.0e-4 instead of 0.9e-4), and never faster than
            // c₀/100.
            const double strength = 4.0 * scene_.definition.numerics.shifting;
            const double greatest = 0.02 * parameters_.equation_of_state.sound_speed;
            neighbourhood.for_each_moving([&](Index i) {
                (*transport_speed_)[i] = shifting_speed(strength, parameters_.smoothing_length,
                                                        velocity_gradient_->strain_rate(i), greatest);
            });
        }
    }
    else if (correction_)
        sum(GradientCorrection{mobility_, scene_.dimensions, *correction_});
    if (temperature_gradient_) {
        sum(ScalarGradient{mobility_, *temperature_, *temperature_gradient_});
        neighbourhood.for_each_moving(
            [&](Index i) { temperature_gradient_->set(i, (*correction_)[i] * (*temperature_gradient_)[i]); });
    }
    const TwoPhaseMomentum momentum{mobility_,          particles_.volume,   *excess_pressure_,
                                    viscosity_,         particles_.velocity, parameters_.smoothing_length,
                                    transport_speed_,   pressure_force_,     viscous_force_,
                                    transport_velocity_};
    start_artificial_force(neighbourhood);
    // What follows momentum adds to what it has just stored for the same cluster.
    const auto sum_forces = [&](const auto&... others) {
        artificial_force_ ? sum(momentum, others..., artificial_viscosity(), artificial_stress())
                          : sum(momentum, others...);
    };
    // What all of the space has of a viscosity leaves no traction, and its noise can be spared.
    if (!viscosities_differ_) return sum_forces();
    neighbourhood.for_each_moving([&](Index i) {
        for (VectorField* row : {&velocity_gradient_->x, &velocity_gradient_->y, &velocity_gradient_->z})
            row->set(i, (viscosity_[i] - least_viscosity_) * (*row)[i]);
    });
    sum_forces(ViscousTraction{mobility_, particles_.volume, *velocity_gradient_, 1.0, viscous_force_});
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
