/// The scene as the solver sees it: which models take part, materials, beam, times. Read once from
/// constant/cupelProperties.
#pragma once

#include "foam.hpp"
#include "material.hpp"

namespace cupel
{
/// The models that the case names; whatever is false allocates nothing and computes nothing.
struct Physics
{
    explicit Physics(const wordList& names);

    bool flow, surface_tension, wetting, marangoni, recoil, evaporation, radiation, laser, heat, melting, gravity;
    /// A frozen temperature field drives Marangoni stress and recoil when there is no energy equation.
    bool has_temperature() const { return heat || marangoni || recoil; }
};

/// A Gaussian beam that travels down a straight line at constant speed, shining along −z.
struct LaserPath
{
    explicit LaserPath(const dictionary& entries);

    scalar power, speed, spot_radius, absorptivity, start_time;
    point from, to;

    bool is_on(scalar time) const;
    /// Where the beam's axis is at `time`.
    point axis(scalar time) const;
};

struct Scene
{
    explicit Scene(const IOdictionary& entries);

    Physics physics;
    PrimaryMaterial primary;
    SurroundingMaterial surrounding;
    scalar ambient_temperature, ambient_pressure, convection_coefficient;
    scalar end_time, output_interval;
    scalar spacing;
    autoPtr<LaserPath> laser;
    /// Numerics of this solver: Courant limits, curvature smoothing, iteration limits.
    dictionary numerics;
};
} // namespace cupel
