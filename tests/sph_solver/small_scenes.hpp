/// Small scenes for tests of the engine and the flow, built by hand in units that make numbers easy to check.
#pragma once

#include <cstdint>
#include <random>

#include "integrators/neighbourhood.hpp"
#include "models/term.hpp"
#include "scene/place_particles.hpp"

namespace cupel::small_scenes
{

/// Lattice of spacing 1 in a box of n cells along each axis (y stays one cell in 2-D), each particle displaced by up to
/// `jitter` at random (the same for the same seed).
inline Particles jittered_lattice(int n, int dimensions, double jitter, std::uint32_t seed = 1)
{
    const int layers = dimensions == 2 ? 1 : n;
    Particles particles(static_cast<Index>(n * n * layers));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> noise(-jitter, jitter);
    Index i = 0;
    for (int z = 0; z < n; ++z)
        for (int y = 0; y < layers; ++y)
            for (int x = 0; x < n; ++x, ++i) {
                const double flat = dimensions == 2 ? 0.0 : 1.0;
                particles.position.set(
                    i, {x + 0.5 + noise(random), flat * (y + 0.5 + noise(random)), z + 0.5 + noise(random)});
                particles.mass[i] = particles.density[i] = particles.volume[i] = 1.0;
            }
    return particles;
}

/// A liquid that fills a box with walls below and at the sides and an open top, case values that a test may change.
inline Case pool(int dimensions = 2, double spacing = 0.1)
{
    Case definition;
    definition.name = "pool";
    definition.hash = "pool";
    definition.level = "coarse";
    definition.dimensions = dimensions;
    definition.spacing = spacing;
    definition.physics = {"flow"};
    Material liquid;
    liquid.name = "liquid";
    liquid.density = 1.0;
    liquid.viscosity = 0.05;
    definition.materials.emplace("liquid", liquid);
    definition.domain.lower = {0, 0, 0};
    definition.domain.upper = {2, dimensions == 2 ? 0.0 : 1.0, 1.5};
    for (std::size_t side = 0; side < 6; ++side)
        if (dimensions == 3 || (side != 2 && side != 3)) definition.domain.boundaries[side] = Boundary{};
    definition.domain.boundaries[5]->kind = BoundaryKind::open;
    Body body;
    body.material = "liquid";
    body.lower = definition.domain.lower;
    body.upper = {2, dimensions == 2 ? 0.0 : 1.0, 1};
    definition.bodies.push_back(body);
    definition.numerics.reference_speed = 1.0;
    definition.numerics.density_diffusion = 0.1;
    definition.numerics.skin = 0.3;
    definition.numerics.shifting = 1.0;
    definition.time = {1.0, 0.1};
    return definition;
}

} // namespace cupel::small_scenes
