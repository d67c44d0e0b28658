#include "integrators/parameters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cupel
{

namespace
{

/// The length that the flow is driven over: the spot of a laser, else the smallest radius of a drop, else the smallest
/// extent of a liquid box, m.
double driven_length(const Case& definition)
{
    if (definition.laser) return definition.laser->spot_radius;
    double length = std::numeric_limits<double>::infinity();
    for (const Body& body : definition.bodies) {
        if (body.shape == BodyShape::sphere)
            length = std::min(length, body.radius);
        else
            for (const std::size_t axis : {std::size_t{0}, std::size_t{1}, std::size_t{2}})
                if (axis != 1 || definition.dimensions == 3)
                    length = std::min(length, body.upper[axis] - body.lower[axis]);
    }
    return length;
}

double liquid_height(const Case& definition)
{
    double height = 0.0;
    for (const Body& body : definition.bodies)
        height = std::max(height, body.shape == BodyShape::sphere ? 2.0 * body.radius : body.upper[2] - body.lower[2]);
    return height;
}

double length_of(const std::array<double, 3>& a)
{
    return std::hypot(a[0], a[1], a[2]);
}

/// Greatest gradient of the temperature at the start, K/m; that of a hot spot is 2 exp(-1/2) rise / radius.
double steepest_gradient(const Initial& initial)
{
    double gradient = length_of(initial.temperature_gradient);
    if (initial.hot_spot)
        gradient += 2.0 * std::exp(-0.5) * std::abs(initial.hot_spot->rise) / initial.hot_spot->radius;
    return gradient;
}

} // namespace

FlowParameters derive_flow_parameters(const Scene& scene)
{
    const Case& definition = scene.definition;
    const Material& liquid = scene.materials.front();
    const Numerics& numerics = definition.numerics;
    const double length = driven_length(definition);

    FlowParameters parameters;
    parameters.smoothing_length = numerics.smoothing_ratio * scene.spacing;
    const auto consider = [&](double speed, const char* name) {
        if (speed > parameters.reference_speed) {
            parameters.reference_speed = speed;
            parameters.reference_speed_from = name;
        }
    };
    if (definition.requires_physics("surface_tension"))
        // Ten times this speed keeps the Laplace pressure 2σ/L from compressing the liquid by more than 0.2 %.
        // (Chosen: at 0.25 % a spreading drop lost 0.11 % of its volume, against the 0.1 % that its case allows.)
        consider(std::sqrt(10.0 * liquid.surface_tension.value() / (liquid.density * length)), "surface tension");
    if (definition.requires_physics("gravity"))
        consider(std::sqrt(length_of(definition.gravity) * liquid_height(definition)), "gravity");
    if (definition.initial.velocity) consider(definition.initial.velocity->speed, "velocity at the start");
    for (const auto& boundary : definition.domain.boundaries)
        if (boundary) consider(length_of(boundary->velocity), "moving wall");
    if (definition.requires_physics("marangoni")) {
        const double slope = std::abs(liquid.surface_tension_slope.value());
        if (definition.laser)
            consider(std::sqrt(slope * (liquid.boiling_temperature.value() - liquid.melting_temperature.value()) /
                               (liquid.density * length)),
                     "Marangoni stress");
        else
            consider(slope * steepest_gradient(definition.initial) * length / (4.0 * liquid.viscosity.value()),
                     "Marangoni stress");
    }
    // The speed that the recoil at the boiling point, 0.54 p₀ (Anisimov), drives (Bernoulli).
    if (definition.requires_physics("recoil"))
        consider(std::sqrt(2.0 * 0.54 * definition.surrounding->pressure / liquid.density), "recoil");
    if (numerics.reference_speed) {
        parameters.reference_speed = *numerics.reference_speed;
        parameters.reference_speed_from = "numerics.reference_speed";
    }
    if (!numerics.sound_speed && !(parameters.reference_speed > 0.0))
        throw CaseError("numerics.reference_speed: no force of this scene tells how fast it will flow; give the "
                        "greatest speed expected");

    const double sound_speed = numerics.sound_speed.value_or(numerics.sound_speed_factor * parameters.reference_speed);
    parameters.equation_of_state = {sound_speed, numerics.formulation == "paper" ? 7.0 : 1.0};
    return parameters;
}

TimeStepLimits derive_time_step_limits(const Scene& scene, const FlowParameters& parameters)
{
    const double dx = scene.spacing, h = parameters.smoothing_length;
    TimeStepLimits limits;
    double viscous = std::numeric_limits<double>::infinity(), lightest = viscous, heaviest = 0.0;
    for (const Material& material : scene.materials) {
        viscous = std::min(viscous, 0.125 * material.density * h * h / material.viscosity.value());
        lightest = std::min(lightest, material.density);
        heaviest = std::max(heaviest, material.density);
    }
    // Both phases have the heavier one's stiffness: sound is faster in the lighter one by the root of their ratio.
    limits["acoustic"] =
        (scene.two_phase ? 0.4 * std::sqrt(lightest / heaviest) : 0.35) * dx / parameters.equation_of_state.sound_speed;
    limits["viscous"] = viscous;
    if (scene.definition.requires_physics("surface_tension"))
        limits["capillary"] = 0.4 * std::sqrt(lightest * dx * dx * dx /
                                              (2.0 * std::numbers::pi * scene.materials[0].surface_tension.value()));
    for (auto& [name, limit] : limits)
        limit *= scene.definition.numerics.time_step_factor;
    return limits;
}

} // namespace cupel
