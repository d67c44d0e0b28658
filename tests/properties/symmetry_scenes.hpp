/// Scenes with everything that a symmetry could break: small, off their axes, in motion.
#pragma once

#include <string>

#include "scene/place_particles.hpp"

namespace cupel::properties
{

inline Material molten_steel()
{
    Material metal;
    metal.name = "steel";
    metal.density = metal.density_solid.emplace(6900.0);
    metal.viscosity = 6e-3;
    metal.specific_heat = 780.0;
    metal.specific_heat_solid = 700.0;
    metal.conductivity = 18.14;
    metal.conductivity_solid = 36.71;
    metal.solidus = 1673.0;
    metal.liquidus = 1773.0;
    metal.melting_temperature = 1723.0;
    metal.latent_heat = 2.47e5;
    metal.mushy_drag = 1e13;
    metal.surface_tension = 1.2;
    metal.surface_tension_slope = -4.3e-4;
    metal.surface_tension_reference_temperature = 1723.0;
    metal.surface_tension_minimum = 0.1;
    metal.contact_angle = 0.785;
    metal.boiling_temperature = 3050.0;
    metal.vaporization_heat = 6.1e6;
    metal.molar_mass = 0.0558;
    metal.emissivity = 0.6;
    return metal;
}

/// The numbers that every case has by default.
inline Numerics default_numerics()
{
    Numerics numerics;
    numerics.density_diffusion = 0.1;
    numerics.shifting = 1.0;
    numerics.skin = 0.3;
    numerics.acoustic_substeps = 4;
    return numerics;
}

inline Case empty_box(int dimensions, double spacing, const Vector3& lower, const Vector3& upper, BoundaryKind sides)
{
    Case definition;
    definition.name = definition.hash = "symmetry";
    definition.level = "coarse";
    definition.dimensions = dimensions;
    definition.spacing = spacing;
    definition.domain.lower = lower;
    definition.domain.upper = upper;
    for (std::size_t side = 0; side < 6; ++side)
        if (dimensions == 3 || side / 2 != 1) definition.domain.boundaries[side] = Boundary{sides};
    definition.numerics = default_numerics();
    definition.time = {1.0, 0.1};
    return definition;
}

/// A drop of eight spacings that oscillates, in two dimensions: with a free surface or in a liquid of a tenth of its
/// density and viscosity.
inline Case oscillating_drop(bool two_phase, BoundaryKind sides)
{
    Case definition = empty_box(2, 0.1, {-1, 0, -1}, {1, 0, 1}, sides);
    definition.physics = {"flow", "surface_tension"};
    Material liquid;
    liquid.name = "liquid";
    liquid.density = 1.0;
    liquid.viscosity = 0.05;
    liquid.surface_tension = 1.0;
    Material outside = liquid;
    outside.name = "outside";
    outside.density = 0.1;
    outside.viscosity = 0.005;
    definition.materials = {{"liquid", liquid}, {"outside", outside}};
    definition.surrounding.emplace();
    definition.surrounding->material = "outside";
    definition.surrounding->resolved = two_phase;
    Body drop;
    drop.material = "liquid";
    drop.shape = BodyShape::sphere;
    drop.center = {0.13, 0, -0.07};
    drop.radius = 0.5;
    drop.perturbation = Perturbation{2, 0.1};
    definition.bodies = {drop};
    return definition;
}

/// A drop on a wall that it wets, pulled sideways by gravity, in three dimensions.
inline Case drop_on_a_wall()
{
    Case definition = empty_box(3, 0.1, {-0.8, -0.8, 0}, {0.8, 0.8, 0.8}, BoundaryKind::wall);
    definition.physics = {"flow", "gravity", "surface_tension", "wetting"};
    definition.gravity = {0.5, 0.2, -1};
    Material liquid;
    liquid.name = "liquid";
    liquid.density = 1.0;
    liquid.viscosity = 0.1;
    liquid.surface_tension = 1.0;
    liquid.contact_angle = 0.785;
    definition.materials = {{"liquid", liquid}};
    Body drop;
    drop.material = "liquid";
    drop.shape = BodyShape::sphere;
    drop.center = {0.03, -0.02, 0};
    drop.radius = 0.5;
    definition.bodies = {drop};
    return definition;
}

/// Steel that melts and boils under a beam, all models at work. The beam is off the symmetry of the lattice, where rays
/// would be as near to one particle as to another.
inline Case melt_pool()
{
    constexpr double micron = 1e-6;
    const double half = 120 * micron, depth = 120 * micron, free = 80 * micron;
    Case definition = empty_box(3, 20 * micron, {-half, -half, -depth}, {half, half, free}, BoundaryKind::wall);
    definition.domain.boundaries[5]->kind = BoundaryKind::open;
    definition.physics = {"flow",        "surface_tension", "wetting", "marangoni", "recoil",
                          "evaporation", "radiation",       "laser",   "heat",      "melting"};
    const Material metal = molten_steel();
    Material argon;
    argon.name = "argon";
    argon.density = 1.62;
    definition.materials = {{"steel", metal}, {"argon", argon}};
    definition.surrounding = Surrounding{"argon", false, 300.0, 101325.0, 80.0};
    definition.initial.temperature = 1640.0;
    definition.initial.temperature_gradient = {1e5, -2e5, 3e5};
    Body plate;
    plate.material = "steel";
    plate.solid = true;
    plate.lower = {-half, -half, -depth};
    plate.upper = {half, half, 0};
    definition.bodies = {plate};
    definition.laser.emplace();
    *definition.laser = {400.0, 0.3, 60 * micron, 0.35, {-13.1 * micron, 5.7 * micron}, {51.3 * micron, 17.9 * micron},
                         0.0};
    return definition;
}

/// A drop of hot melt in flight: heat, Marangoni stress, recoil and losses, and nothing that stands.
inline Case drop_of_melt()
{
    constexpr double micron = 1e-6;
    Case definition = melt_pool();
    definition.laser.reset();
    definition.physics = {"flow",        "surface_tension", "marangoni", "recoil",
                          "evaporation", "radiation",       "heat",      "melting"};
    for (auto& boundary : definition.domain.boundaries)
        boundary->kind = BoundaryKind::open;
    definition.domain.lower = {-200 * micron, -200 * micron, -200 * micron};
    definition.domain.upper = {200 * micron, 200 * micron, 200 * micron};
    definition.initial.temperature = 2400.0;
    definition.initial.temperature_gradient = {1e6, 5e5, 1e6};
    Body drop;
    drop.material = "steel";
    drop.shape = BodyShape::sphere;
    drop.center = {3 * micron, -5 * micron, 1 * micron};
    drop.radius = 90 * micron;
    definition.bodies = {drop};
    return definition;
}

} // namespace cupel::properties
