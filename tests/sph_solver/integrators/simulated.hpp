/// Small scenes in time.
#pragma once

#include "integrators/simulation.hpp"
#include "small_scenes.hpp"

namespace cupel::small_scenes
{

inline Simulation simulate(const Case& definition, int steps)
{
    Simulation simulation(place_particles(definition));
    simulation.start();
    for (int step = 0; step < steps; ++step)
        simulation.step(1.0);
    return simulation;
}

inline Case heavy_pool()
{
    Case definition = pool();
    definition.physics = {"flow", "gravity"};
    definition.gravity = {0.3, 0, -1};
    return definition;
}

/// A disc of liquid in nothing, at rest.
inline Case drop_in_nothing()
{
    Case definition = pool(2, 0.05);
    definition.physics = {"flow", "surface_tension"};
    definition.domain.lower = {0, 0, -0.5};
    definition.domain.boundaries[5]->kind = BoundaryKind::wall;
    definition.materials.at("liquid").surface_tension = 1.0;
    Body& body = definition.bodies.front();
    body.shape = BodyShape::sphere;
    body.center = {1, 0, 0.5};
    body.radius = 0.4;
    return definition;
}

inline double mass_of(const Particles& particles)
{
    return ordered_sum(particles.count(), [&](Index i) { return particles.mass[i]; });
}

/// Settles a run and makes another of what a checkpoint of it would hold.
inline Simulation resume(Simulation& unbroken, const Case& definition)
{
    unbroken.settle();
    std::map<std::string, double> numbers;
    unbroken.save(numbers);

    Simulation resumed(place_particles(definition));
    Particles& to = resumed.particles();
    const Particles& from = unbroken.particles();
    for (std::size_t k = 0; k < from.scalars().size(); ++k)
        to.scalars()[k]->values = from.scalars()[k]->values;
    for (std::size_t k = 0; k < from.vectors().size(); ++k) {
        to.vectors()[k]->x = from.vectors()[k]->x;
        to.vectors()[k]->y = from.vectors()[k]->y;
        to.vectors()[k]->z = from.vectors()[k]->z;
    }
    to.kind = from.kind;
    to.material = from.material;
    to.identity = from.identity;
    to.surface_parent = from.surface_parent;
    to.rebuild_places();
    resumed.load(numbers);
    resumed.settle();
    return resumed;
}

} // namespace cupel::small_scenes
