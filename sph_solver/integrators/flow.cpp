#include "integrators/flow.hpp"

#include <cmath>

#include "integrators/free_surface_flow.hpp"
#include "integrators/two_phase_flow.hpp"
#include "models/cohesion.hpp"
#include "models/recoil_pressure.hpp"

namespace cupel::inline CUPEL_ENGINE
{

namespace
{

SurfaceTensionLaw surface_tension_law(const Material& liquid)
{
    return {liquid.surface_tension.value_or(0.0), liquid.surface_tension_slope.value_or(0.0),
            liquid.surface_tension_reference_temperature.value_or(0.0), liquid.surface_tension_minimum.value_or(0.0)};
}

} // namespace

Flow::Flow(Scene& scene, const FlowParameters& parameters, const ScalarField& mobility)
    : scene_(scene), particles_(*scene.particles), parameters_(parameters),
      kernel_(scene.definition.numerics.kernel, parameters.smoothing_length, scene.dimensions), mobility_{mobility},
      gravity_{scene.definition.gravity[0], scene.definition.gravity[1], scene.definition.gravity[2]},
      force_(particles_.add_vector({"force", "N"})), pressure_force_(particles_.add_vector({"pressure_force", "N"})),
      viscous_force_(particles_.add_vector({"viscous_force", "N"})),
      acceleration_(particles_.add_vector({"acceleration", "m/s2"})), excess_pressure_(&particles_.pressure),
      tension_(surface_tension_law(scene.materials.front())),
      with_tension_(scene.definition.requires_physics("surface_tension")),
      with_marangoni_(scene.definition.requires_physics("marangoni")),
      with_recoil_(scene.definition.requires_physics("recoil"))
{
    if (!scene.definition.requires_physics("gravity")) gravity_ = {};
    if (scene.two_phase) {
        for (const Material& material : scene.materials)
            mean_density_ += material.density / static_cast<double>(scene.materials.size());
    }
    const bool shifts = !scene.two_phase && scene.definition.numerics.shifting > 0.0;
    const bool loads = with_tension_ || with_recoil_;
    band_bears_load_ = loads && scene.definition.numerics.surface_load == "continuum_force";
    if (loads || with_marangoni_ || shifts)
        surface_ = std::make_unique<SurfaceTracker>(scene, parameters, kernel_, mobility,
                                                    loads && !band_bears_load_ &&
                                                        !scene.definition.requires_physics("melting"));
    if (with_recoil_) {
        const Material& metal = scene.materials.front();
        vapour_pressure_ = {scene.definition.surrounding->pressure, metal.boiling_temperature.value(),
                            metal.vaporization_heat.value(), metal.molar_mass.value()};
    }
    if (particles_.has("temperature")) temperature_ = &particles_.scalar("temperature");
    const Numerics& numerics = scene.definition.numerics;
    if (numerics.artificial_viscosity > 0.0 || numerics.artificial_viscosity_beta > 0.0 ||
        numerics.artificial_stress > 0.0)
        artificial_force_ = &particles_.add_vector({"artificial_force", "N"});
    if (temperature_ && (with_tension_ || with_recoil_ || with_marangoni_))
        mean_temperature_ = &particles_.add_scalar({"surface_temperature", "K"});
    if (loads) load_ = &particles_.add_scalar({"surface_load", "Pa"});
    if (with_tension_ && !scene.two_phase) {
        unresolved_ = &particles_.add_scalar({"unresolved", "1"});
        bonds_ = Cohesion::bonds_across_a_plane(scene.dimensions);
    }
    if (with_marangoni_) temperature_gradient_ = &particles_.add_vector({"temperature_gradient", "K/m"});
}

WallPressure Flow::wall_pressure(ScalarField& pressure, ScalarField* carried_load)
{
    return {mobility_, particles_.density, gravity_, particles_.kind, carried_load, pressure};
}

WallVelocity Flow::wall_velocity()
{
    const bool walls = particles_.has("wall_normal");
    return {mobility_,
            walls ? &particles_.vector("wall_normal") : nullptr,
            walls ? &particles_.scalar("wall_free_slip") : nullptr,
            walls ? &particles_.scalar("wall_depth") : nullptr,
            particles_.has("wall_velocity") ? &particles_.vector("wall_velocity") : nullptr,
            particles_.velocity};
}

void Flow::start_artificial_force(const Neighbourhood& neighbourhood)
{
    if (artificial_force_) neighbourhood.for_each_moving([&](Index i) { artificial_force_->set(i, {}); });
}

ArtificialViscosity Flow::artificial_viscosity()
{
    const Numerics& numerics = scene_.definition.numerics;
    return {mobility_,
            numerics.artificial_viscosity,
            numerics.artificial_viscosity_beta,
            parameters_.equation_of_state.sound_speed,
            parameters_.smoothing_length,
            particles_.mass,
            particles_.density,
            particles_.velocity,
            *artificial_force_};
}

ArtificialStress Flow::artificial_stress()
{
    return {mobility_,
            scene_.definition.numerics.artificial_stress,
            kernel_(scene_.spacing).value,
            particles_.mass,
            particles_.density,
            *excess_pressure_,
            *artificial_force_};
}

SurfaceTemperature Flow::surface_temperature()
{
    return {mobility_, *temperature_, particles_.kind, surface_->fields().delta, *mean_temperature_};
}

SurfaceTemperatureGradient Flow::surface_temperature_gradient()
{
    return {mobility_, *temperature_, stress_share_ ? *stress_share_ : surface_->fields().delta,
            *temperature_gradient_};
}

void Flow::correct_temperature_gradient(const Neighbourhood& neighbourhood, const CorrectionMatrix& correction)
{
    const ScalarField& wanted = surface_temperature_gradient().wanted;
    neighbourhood.for_each_moving([&](Index i) {
        if (wanted[i] > 0.0) temperature_gradient_->set(i, correction[i] * (*temperature_gradient_)[i]);
    });
}

void Flow::hold_surface_forces()
{
    by_surface_ = &particles_.add_vector({"force_by_surface", "N"});
    by_surface_before_ = &particles_.add_vector({"force_by_surface_before", "N"});
}

Vector Flow::sum_of_pair_forces(Index i) const
{
    Vector force = pressure_force_[i] + viscous_force_[i];
    if (artificial_force_) force += (*artificial_force_)[i];
    return force;
}

void Flow::add_up_forces(const Neighbourhood& neighbourhood)
{
    neighbourhood.for_each_moving([&](Index i) { force_.set(i, sum_of_pair_forces(i)); });
}

double Flow::elastic_energy(Index i) const
{
    const double rest = scene_.materials[particles_.material[static_cast<std::size_t>(i)]].density;
    return parameters_.equation_of_state.elastic_energy(particles_.density[i], rest);
}

double Flow::mechanical_energy(const Neighbourhood& neighbourhood) const
{
    const auto& moving = neighbourhood.moving_particles();
    return ordered_sum(static_cast<Index>(moving.size()), [&](Index m) {
        const Index i = moving[static_cast<std::size_t>(m)];
        const Vector v = particles_.velocity[i];
        return particles_.mass[i] * (0.5 * dot(v, v) + elastic_energy(i));
    });
}

void Flow::add_cohesion(const Neighbourhood& neighbourhood)
{
    if (!unresolved_) return;
    const NeighbourList& list = neighbourhood.list();
    const double full = lattice_companions(scene_.dimensions);
    neighbourhood.for_each_moving(
        [&](Index i) { (*unresolved_)[i] = Cohesion::share_unresolved(surface_->fields().companions[i], full); });
    for_each_pair(list, particles_, kernel_, neighbourhood.standing(),
                  CompanionsOfSolids{mobility_, parameters_.smoothing_length, full, particles_.kind, *unresolved_});
    std::vector<Index> unresolved;
    for (const auto* clusters : {&neighbourhood.moving(), &neighbourhood.standing()})
        for (const Index c : *clusters)
            if (!none_in(list.cluster(c), [&](Index i) { return (*unresolved_)[i] > 0.0; })) unresolved.push_back(c);
    const std::vector<Index> near = neighbourhood.moving_near(unresolved);
    if (near.empty()) return;
    const bool flat = scene_.dimensions == 2;
    for_each_pair(list, particles_, kernel_, near,
                  Cohesion{mobility_, scene_.spacing, flat ? 1.0 : scene_.spacing, bonds_, tension_, particles_.kind,
                           temperature_, *unresolved_, force_});
}

double Flow::tension(Index i) const
{
    return mean_temperature_ ? tension_((*mean_temperature_)[i]) : tension_.at_reference;
}

double Flow::tension_of_solid(Index i) const
{
    return temperature_ ? tension_((*temperature_)[i]) : tension_.at_reference;
}

void Flow::find_load(const Neighbourhood& neighbourhood, bool temperature_is_known)
{
    if (!load_) return;
    if (mean_temperature_ && !temperature_is_known)
        for_each_pair(neighbourhood.list(), particles_, kernel_, neighbourhood.moving(), surface_temperature());
    const SurfaceFields& surface = surface_->fields();
    neighbourhood.for_each_moving([&](Index i) {
        double load = 0.0;
        if (surface.delta[i] > 0.0) {
            if (with_tension_) load += surface.curvature[i] * tension(i);
            if (with_recoil_) load += recoil_pressure(vapour_pressure_, (*mean_temperature_)[i]);
        }
        (*load_)[i] = load;
    });
    // A solid beside its melt has the tension of its own temperature, and does not evaporate.
    for (const Index i : surface_->solids())
        (*load_)[i] = with_tension_ && surface.delta[i] > 0.0 ? surface.curvature[i] * tension_of_solid(i) : 0.0;
}

void Flow::accelerate(const Neighbourhood& neighbourhood)
{
    neighbourhood.for_each_moving([&](Index i) {
        Vector acceleration = (1.0 / particles_.mass[i]) * force_[i] + gravity_;
        Vector by_surface{};
        if (by_surface_) by_surface = force_[i] - sum_of_pair_forces(i);
        if (surface_ && surface_->fields().delta[i] > 0.0) {
            const SurfaceFields& surface = surface_->fields();
            const Vector normal = surface.normal[i];
            const double delta = surface.delta[i];
            Vector force_density{};
            if (band_bears_load_) force_density += surface_load_force((*load_)[i], normal, delta);
            if (const VectorField* pull = surface_->contact_pull()) force_density += (delta * tension(i)) * (*pull)[i];
            const double lightness = 1.0 / (mean_density_ > 0.0 ? mean_density_ : particles_.density[i]);
            by_surface += (particles_.mass[i] * lightness) * force_density;
            if (with_marangoni_ && !stress_share_)
                force_density += marangoni_force(tension_.slope, (*temperature_gradient_)[i], normal, delta);
            acceleration += lightness * force_density;
        }
        if (stress_share_ && (*stress_share_)[i] != 0.0)
            acceleration +=
                (1.0 / particles_.density[i]) * marangoni_force(tension_.slope, (*temperature_gradient_)[i],
                                                                (*stress_direction_)[i], (*stress_share_)[i]);
        acceleration_.set(i, acceleration);
        if (!by_surface_) return;
        by_surface_before_->set(i, (*by_surface_)[i]);
        by_surface_->set(i, by_surface);
    });
}

std::unique_ptr<Flow> make_flow(Scene& scene, const FlowParameters& parameters, const ScalarField& mobility)
{
    if (scene.two_phase) return std::make_unique<TwoPhaseFlow>(scene, parameters, mobility);
    return std::make_unique<FreeSurfaceFlow>(scene, parameters, mobility);
}

} // namespace cupel::inline CUPEL_ENGINE
