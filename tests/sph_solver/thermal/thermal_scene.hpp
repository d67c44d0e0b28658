/// Small scenes of heat, built by hand: a lattice block of one material, jittered on request.
#pragma once

#include <omp.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <vector>

#include "integrators/thermal_step.hpp"

namespace cupel::thermal_tests
{

inline Material plain_metal()
{
    Material metal;
    metal.name = "metal";
    metal.density = 6900;
    metal.specific_heat = 780;
    metal.conductivity = 25;
    return metal;
}

inline Material steel()
{
    Material metal;
    metal.name = "steel";
    metal.density = 6900;
    metal.specific_heat = 780;
    metal.specific_heat_solid = 700;
    metal.conductivity = 18.1;
    metal.conductivity_solid = 36.7;
    metal.solidus = 1673;
    metal.liquidus = 1773;
    metal.latent_heat = 247000;
    metal.boiling_temperature = 3050;
    metal.vaporization_heat = 6.1e6;
    metal.molar_mass = 0.0558;
    metal.emissivity = 0.6;
    return metal;
}

/// Case without bodies; `physics` beside "heat".
inline Case heat_case(const Material& material, int dimensions, double spacing, std::vector<std::string> physics = {})
{
    Case definition;
    definition.dimensions = dimensions;
    definition.spacing = spacing;
    definition.physics = std::move(physics);
    definition.physics.emplace_back("heat");
    definition.materials.emplace(material.name, material);
    return definition;
}

inline Boundary wall(std::optional<double> temperature = std::nullopt)
{
    Boundary boundary;
    boundary.temperature = temperature;
    return boundary;
}

/// Particles on the lattice points of the box lower … upper for which keep(point) holds, each coordinate moved by up to
/// ± jitter/2 spacings, the same for the same seed everywhere.
inline Scene lattice_scene(
    const Case& definition, const Vector& lower, const Vector& upper, double jitter = 0.0,
    const std::function<bool(const Vector&)>& keep = [](const Vector&) { return true; })
{
    const double dx = definition.spacing;
    const bool flat = definition.dimensions == 2;
    const auto cells = [&](double low, double high) { return static_cast<int>(std::lround((high - low) / dx)); };
    std::mt19937 random(3);
    const auto shift = [&] { return jitter * dx * (static_cast<double>(random()) / 4294967296.0 - 0.5); };
    std::vector<Vector> points;
    for (int b = 0; b < (flat ? 1 : cells(lower.y, upper.y)); ++b)
        for (int a = 0; a < cells(lower.x, upper.x); ++a)
            for (int c = 0; c < cells(lower.z, upper.z); ++c) {
                const Vector p{lower.x + (a + 0.5) * dx, flat ? 0.0 : lower.y + (b + 0.5) * dx,
                               lower.z + (c + 0.5) * dx};
                if (keep(p)) points.push_back({p.x + shift(), flat ? 0.0 : p.y + shift(), p.z + shift()});
            }
    // Threads would spend more time waiting for each other than working in scenes of a few hundred particles.
    omp_set_num_threads(points.size() < 3000 ? 1 : omp_get_num_procs());
    Scene scene;
    scene.definition = definition;
    scene.spacing = dx;
    scene.dimensions = definition.dimensions;
    for (const auto& [name, material] : definition.materials)
        scene.materials.push_back(material);
    scene.particles = std::make_unique<Particles>(static_cast<Index>(points.size()));
    Particles& particles = *scene.particles;
    const double volume = flat ? dx * dx : dx * dx * dx;
    for (Index i = 0; i < particles.count(); ++i) {
        particles.position.set(i, points[static_cast<std::size_t>(i)]);
        particles.kind[static_cast<std::size_t>(i)] = Kind::solid;
        particles.volume[i] = volume;
        particles.density[i] = scene.materials.front().density;
        particles.mass[i] = volume * particles.density[i];
    }
    return scene;
}

/// Support of the quintic spline with h = spacing, and a list of a scene that does not move.
inline NeighbourList neighbours(Scene& scene)
{
    NeighbourList list(3.0 * scene.spacing, 0.0, scene.spacing, scene.dimensions);
    list.build(*scene.particles);
    return list;
}

/// Equal steps, none longer than the stable one, to `end`. Returns how many.
inline int run(ThermalStep& step, const NeighbourList& list, double end, double begin = 0.0)
{
    const int steps = static_cast<int>(std::ceil((end - begin) / step.stable_time_step()));
    const double time_step = (end - begin) / steps;
    for (int n = 0; n < steps; ++n)
        step.advance(list, begin + n * time_step, time_step);
    return steps;
}

} // namespace cupel::thermal_tests
