#include "integrators/free_surface_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "kernels/lattice_sum.hpp"
#include "models/closed_surface_tension.hpp"
#include "models/density_diffusion.hpp"
#include "models/momentum.hpp"
#include "models/packing.hpp"
#include "models/shifting.hpp"
#include "models/surface_pressure.hpp"
#include "models/surface_stress.hpp"
#include "models/viscous_traction.hpp"

namespace cupel::inline CUPEL_ENGINE
{

FreeSurfaceFlow::FreeSurfaceFlow(Scene& scene, const FlowParameters& parameters, const ScalarField& mobility)
    : Flow(scene, parameters, mobility), correction_(CorrectionMatrix::register_in(particles_)),
      velocity_gradient_(VelocityGradientFields::register_in(particles_)),
      density_rate_(particles_.add_scalar({"density_rate", "kg/(m3 s)"})),
      density_rate_by_walls_(particles_.add_scalar({"density_rate_by_walls", "kg/(m3 s)"})),
      rest_density_(scene.materials.front().density),
      lattice_packing_(std::pow(scene.spacing, scene.dimensions) *
                       sum_over_lattice(kernel_, scene.spacing, scene.dimensions))
{
    wall_force_ = &particles_.add_vector({"wall_force", "N"});
    if (load_ && !band_bears_load_) {
        excess_pressure_ = &particles_.add_scalar({"excess_pressure", "Pa"});
        replaced_rate_ = &particles_.add_scalar({"replaced_density_rate", "kg/(m3 s)"});
        carried_load_ = &particles_.add_scalar({"carried_load", "Pa"});
        carried_mean_ = &particles_.add_scalar({"carried_load_mean", "Pa"});
        carried_gradient_ = &particles_.add_vector({"carried_load_gradient", "Pa/m"});
        tension_alone_ = scene.definition.requires_physics("surface_tension") &&
                         !scene.definition.requires_physics("recoil") && !temperature_;
    }
    if (temperature_gradient_) {
        stress_share_ = &particles_.add_scalar({"surface_stress_share", "1/m"});
        stress_direction_ = &particles_.add_vector({"surface_stress_direction", "1"});
        kernel_gradient_sum_ = &particles_.add_vector({"kernel_gradient_sum", "1/m"});
    }
    if (scene.definition.numerics.density_diffusion > 0.0) {
        density_gradient_ = &particles_.add_vector({"density_gradient", "kg/m4"});
        diffusion_rate_ = &particles_.add_scalar({"density_diffusion_rate", "kg/(m3 s)"});
    }
    if (scene.definition.numerics.shifting > 0.0) {
        shift_ = &particles_.add_vector({"shifting_velocity", "m/s"});
        shifting_density_rate_ = &particles_.add_scalar({"shifting_density_rate", "kg/(m3 s)"});
        mass_rate_ = &particles_.add_scalar({"mass_rate", "kg/s"});
        momentum_rate_ = &particles_.add_vector({"shifting_momentum_rate", "N"});
        shifting_speed_ = &particles_.add_scalar({"shifting_speed", "m/s"});
        if (scene.definition.requires_physics("melting"))
            shifting_speed_of_band_ = &particles_.add_scalar({"shifting_speed_of_band", "m/s"});
        packing_rate_ = &particles_.add_scalar({"packing_rate", "kg/(m3 s)"});
        balance_ = &particles_.add_scalar({"shifting_balance", "1"}, 1.0);
        if (particles_.has("enthalpy")) {
            enthalpy_ = &particles_.scalar("enthalpy");
            energy_rate_ = &particles_.add_scalar({"shifting_energy_rate", "W"});
        }
    }
    if (load_ && follows_sound() && scene.definition.numerics.acoustic_substeps > 1) hold_surface_forces();
    start_hydrostatic();
}

/// Liquid under gravity starts with the pressure of its own weight, so that it does not first fall into itself.
void FreeSurfaceFlow::start_hydrostatic()
{
    if (gravity_.z == 0.0) return;
    double top = -std::numeric_limits<double>::infinity();
    for (Index i = 0; i < particles_.count(); ++i)
        if (mobility_.weight[i] != 0.0) top = std::max(top, particles_.position[i].z);
    const double surface = top + 0.5 * scene_.spacing;
    for (Index i = 0; i < particles_.count(); ++i)
        if (mobility_.weight[i] != 0.0) {
            const double weight = -rest_density_ * gravity_.z * (surface - particles_.position[i].z);
            particles_.pressure[i] = (*excess_pressure_)[i] = weight;
            particles_.density[i] = parameters_.equation_of_state.density(weight, rest_density_);
            particles_.volume[i] = particles_.mass[i] / particles_.density[i];
        }
}

void FreeSurfaceFlow::drift(const Neighbourhood& neighbourhood, double time_step)
{
    neighbourhood.for_each_moving([&](Index i) {
        Vector speed = particles_.velocity[i];
        if (shift_) speed += (*shift_)[i];
        particles_.position.set(i, particles_.position[i] + time_step * speed);
    });
}

void FreeSurfaceFlow::reset(Index place)
{
    Flow::reset(place);
    velocity_gradient_.reset(place);
    (*excess_pressure_)[place] = 0.0;
    wall_force_->set(place, {});
    density_rate_by_walls_[place] = 0.0;
    if (carried_mean_) (*carried_mean_)[place] = (*carried_load_)[place]; // what the liquid beside it bears
    if (density_gradient_) density_gradient_->set(place, {});
    if (!shift_) return;
    shift_->set(place, {});
    (*shifting_speed_)[place] = 0.0;
    if (shifting_speed_of_band_) (*shifting_speed_of_band_)[place] = 0.0;
    (*packing_rate_)[place] = 0.0;
    // Walls and solids have the mass that they started with or froze with, and no say in it.
    (*balance_)[place] = 1.0;
}

/// Everything that needs nothing but places and the state before: the matrices that correct gradients, rates of
/// density, the gradient of velocity, the colour gradient, and what shifting by the last drift carried between
/// particles. Density diffuses by the gradient of density that the last force pass has found for the same densities,
/// before the drift.
void FreeSurfaceFlow::find_rates(const Neighbourhood& neighbourhood)
{
    const GradientCorrection correction{mobility_, scene_.dimensions, correction_};
    const VelocityGradient gradient{mobility_,          particles_.velocity, correction_,
                                    velocity_gradient_, &density_rate_,      &particles_.density};
    const auto sum_all = [&](const auto&... others) {
        for_each_pair(neighbourhood.list(), particles_, kernel_, neighbourhood.moving(), correction, gradient,
                      others...);
    };
    const auto sum_with_diffusion = [&](auto with_walls, const auto&... others) {
        if (!density_gradient_) return sum_all(others...);
        sum_all(
            DensityDiffusion<with_walls()>{mobility_, particles_.density, *density_gradient_,
                                           scene_.definition.numerics.density_diffusion * parameters_.smoothing_length *
                                               parameters_.equation_of_state.sound_speed,
                                           *diffusion_rate_},
            others...);
    };
    const auto sum_with_walls = [&](auto with_walls, const auto&... others) {
        if constexpr (with_walls())
            sum_with_diffusion(with_walls, continuity_by_walls(), others...);
        else
            sum_with_diffusion(with_walls, others...);
    };
    const auto sum = [&](auto with_walls) {
        if (!surface_) return sum_with_walls(with_walls);
        const auto colour = surface_->colour_gradient<false, with_walls()>();
        if (!shift_ || exchanged_) return sum_with_walls(with_walls, colour);
        sum_with_exchange<with_walls()>(neighbourhood,
                                        [&](const auto& exchange) { sum_with_walls(with_walls, colour, exchange); });
    };
    neighbourhood.standing().empty() ? sum(std::false_type{}) : sum(std::true_type{});
    if (carried_load_) take_trace_in_band(neighbourhood);
}

/// The rate of ContinuityOfBand, from the gradient of velocity.
void FreeSurfaceFlow::take_trace_in_band(const Neighbourhood& neighbourhood)
{
    neighbourhood.for_each_moving([&](Index i) {
        if (!(surface_->fields().delta[i] > 0.0)) return;
        const double rate = -particles_.density[i] * velocity_gradient_.trace(i);
        (*replaced_rate_)[i] = rate - density_rate_[i];
        density_rate_[i] = rate;
    });
}

/// Forces between particles, and in the same pass the shifting velocity of the next drift, the gradient of density by
/// which that of the next step diffuses (where sound takes several steps, the last but one finds it), and what
/// Marangoni flow needs of temperature: all of them need nothing but the state as it is now.
void FreeSurfaceFlow::find_forces(const Neighbourhood& neighbourhood, bool with_density_gradient)
{
    const double viscosity = scene_.materials.front().viscosity.value();
    // What follows momentum adds to what it has just stored for the same cluster.
    start_artificial_force(neighbourhood);
    const auto sum = [&](auto with_walls, const auto&... others) {
        const ViscousTraction<with_walls()> traction{mobility_,   particles_.volume, velocity_gradient_,  viscosity,
                                                     correction_, viscous_force_,    kernel_gradient_sum_};
        const FreeSurfaceMomentum<with_walls()> momentum{mobility_,           particles_.volume, *excess_pressure_,
                                                         particles_.velocity, viscosity,         pressure_force_,
                                                         viscous_force_,      *wall_force_};
        for_each_pair(neighbourhood.list(), particles_, kernel_, neighbourhood.moving(), momentum, traction, others...);
    };
    const auto sum_with_remedies = [&](const auto&... others) {
        if (artificial_force_) return sum(std::true_type{}, artificial_viscosity(), artificial_stress(), others...);
        neighbourhood.standing().empty() ? sum(std::false_type{}, others...) : sum(std::true_type{}, others...);
    };
    const auto sum_with_density = [&](const auto&... others) {
        if (!density_gradient_ || !with_density_gradient) return sum_with_remedies(others...);
        sum_with_remedies(ScalarGradient{mobility_, particles_.density, *density_gradient_}, others...);
    };
    const auto sum_with_gradient = [&](const auto&... others) {
        if (!temperature_gradient_) return sum_with_density(others...);
        sum_with_density(others..., surface_temperature_gradient(), surface_temperature());
    };
    if (!shift_)
        sum_with_gradient();
    else {
        const double h = parameters_.smoothing_length;
        const ShiftingVelocity shifting{mobility_,
                                        scene_.definition.numerics.shifting,
                                        h,
                                        0.1 * parameters_.equation_of_state.sound_speed,
                                        kernel_(scene_.spacing).value,
                                        0.05 / h,
                                        velocity_gradient_,
                                        particles_.mass,
                                        rest_density_ * scene_.particle_volume,
                                        surface_->fields().companions,
                                        surface_->fewest_companions(),
                                        &surface_->fields().colour_gradient,
                                        surface_->fields().delta,
                                        *shift_,
                                        *shifting_speed_,
                                        shifting_speed_of_band_};
        // Packing reads the speed that shifting has just stored for the same cluster.
        sum_with_gradient(shifting, Packing{mobility_, h, lattice_packing_, *shifting_speed_, shifting_speed_of_band_,
                                            particles_.density, *packing_rate_});
    }
    if (temperature_gradient_) correct_temperature_gradient(neighbourhood, correction_);
    if (density_gradient_ && with_density_gradient) correct_density_gradient(neighbourhood);
}

void FreeSurfaceFlow::correct_density_gradient(const Neighbourhood& neighbourhood)
{
    neighbourhood.for_each_moving(
        [&](Index i) { density_gradient_->set(i, correction_[i] * (*density_gradient_)[i]); });
}

/// Clusters whose particles take a share of a stress on the surface: as far as the kernels of the first layer reach.
std::vector<Index> FreeSurfaceFlow::mark_reach_of_surface_stress(const Neighbourhood& neighbourhood)
{
    const SurfaceFields& surface = surface_->fields();
    neighbourhood.for_each_moving([&](Index i) { (*stress_share_)[i] = 0.0; });
    std::vector<Index> first_layer;
    for (const Index c : neighbourhood.moving())
        if (!none_in(neighbourhood.list().cluster(c), [&](Index i) {
                return mobility_.weight[i] != 0.0 && share_of_surface(surface, i, parameters_.smoothing_length) > 0.0;
            }))
            first_layer.push_back(c);
    const std::vector<Index> reached = neighbourhood.moving_near(first_layer);
    for (const Index c : reached) {
        const Cluster& cluster = neighbourhood.list().cluster(c);
        for (Index i = cluster.first; i < cluster.first + cluster.count; ++i)
            if (mobility_.weight[i] != 0.0) (*stress_share_)[i] = SurfaceStressShare::wanted;
    }
    return reached;
}

SurfaceStressShare FreeSurfaceFlow::surface_stress_share()
{
    return {mobility_,      correction_,       *kernel_gradient_sum_, surface_->fields(), parameters_.smoothing_length,
            *stress_share_, *stress_direction_};
}

/// The load on the surface carried into the liquid, one step further than the last, and its force. A run starts with
/// the load's mean over the surface everywhere. A solid has the mean of the liquid that it sees, and where it is the
/// metal's surface its own load.
void FreeSurfaceFlow::carry_load(const Neighbourhood& neighbourhood, bool at_start)
{
    const SurfaceFields& surface = surface_->fields();
    const double h = parameters_.smoothing_length;
    if (at_start) {
        double sum = 0.0, weight = 0.0;
        for (const Index i : neighbourhood.moving_particles()) {
            const double share = share_of_surface(surface, i, h);
            sum += share * (*load_)[i];
            weight += share;
        }
        for (const Index i : neighbourhood.moving_particles())
            (*carried_mean_)[i] = weight > 0.0 ? sum / weight : 0.0;
    }
    for (const Index i : surface_->solids()) {
        const double share = share_of_surface(surface, i, h);
        (*carried_load_)[i] = (1.0 - share) * (*carried_load_)[i] + share * (*load_)[i];
    }
    neighbourhood.for_each_moving([&](Index i) {
        const double share = share_of_surface(surface, i, h);
        (*carried_load_)[i] = (*carried_mean_)[i];
        if (share == 0.0) return;
        // Of a wave that is resolved a load falls off by less than itself within the band. In a thin edge, whose two
        // sides see each other, it would run away.
        const double greatest = std::abs((*load_)[i]);
        const double fall =
            std::clamp(surface.depth[i] * dot((*carried_gradient_)[i], surface.normal[i]), -greatest, greatest);
        const double at_depth = (*load_)[i] - fall;
        (*carried_load_)[i] = (1.0 - share) * (*carried_mean_)[i] + share * at_depth;
    });
    for_each_pair(neighbourhood.list(), particles_, kernel_, neighbourhood.moving(),
                  SurfacePressure{mobility_, correction_, *carried_load_, *carried_mean_, *carried_gradient_});
    neighbourhood.for_each_moving([&](Index i) {
        force_.set(i, force_[i] - particles_.volume[i] * (*carried_gradient_)[i]);
        particles_.pressure[i] = (*excess_pressure_)[i] + (*carried_load_)[i];
    });
    if (!tension_alone_) return;
    const ClosedSurfaceTension tension{particles_.position, particles_.mass, particles_.volume, *carried_gradient_,
                                       force_};
    for (const FreeBody& body : free_bodies_.find(neighbourhood, particles_, mobility_.weight))
        tension.balance(body.particles, body.periods, !body.endless);
}

/// Walls and solids as the liquid before them sees them: pressure, and from it density and volume.
void FreeSurfaceFlow::extrapolate_pressure(const Neighbourhood& neighbourhood)
{
    for_each_pair(neighbourhood.list(), particles_, kernel_, neighbourhood.standing(),
                  wall_pressure(*excess_pressure_, carried_load_));
    for (const Index c : neighbourhood.standing()) {
        const Cluster cluster = neighbourhood.list().cluster(c);
        for (Index i = cluster.first; i < cluster.first + cluster.count; ++i)
            if (mobility_.weight[i] == 0.0) {
                particles_.density[i] = parameters_.equation_of_state.density((*excess_pressure_)[i], rest_density_);
                particles_.volume[i] = particles_.mass[i] / particles_.density[i];
                if (carried_load_) particles_.pressure[i] = (*excess_pressure_)[i] + (*carried_load_)[i];
            }
    }
}

/// The same: how they move.
void FreeSurfaceFlow::extrapolate_velocity(const Neighbourhood& neighbourhood, bool with_shift)
{
    const auto sum = [&](const auto&... terms) {
        for_each_pair(neighbourhood.list(), particles_, kernel_, neighbourhood.standing(), terms...);
    };
    with_shift ? sum(wall_velocity(), WallShift{mobility_, *shift_}) : sum(wall_velocity());
}

void FreeSurfaceFlow::evaluate(const Neighbourhood& neighbourhood, double time_step)
{
    const bool exchanges = shift_ && !exchanged_, alone = sound_ahead_ == 0.0;
    const double sound = time_step - sound_ahead_;
    extrapolate_velocity(neighbourhood, exchanges);
    find_rates(neighbourhood);
    if (exchanges) exchange(neighbourhood, time_step);
    compress(neighbourhood, {sound, time_step, exchanges ? time_step : 0.0});
    sound_ahead_ = 0.0;
    exchanged_ = false;
    extrapolate_pressure(neighbourhood);

    if (surface_) surface_->find(neighbourhood);
    std::vector<Index> stressed;
    if (stress_share_) stressed = mark_reach_of_surface_stress(neighbourhood);
    find_forces(neighbourhood, alone);
    add_up_forces(neighbourhood);
    add_cohesion(neighbourhood);
    find_load(neighbourhood, temperature_gradient_ != nullptr);
    if (carried_load_) carry_load(neighbourhood, time_step == 0.0);
    if (stress_share_) for_each_pair(neighbourhood.list(), particles_, kernel_, stressed, surface_stress_share());
    accelerate(neighbourhood);
}

} // namespace cupel::inline CUPEL_ENGINE
