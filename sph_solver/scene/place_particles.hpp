#pragma once

#include <memory>
#include <vector>

#include "particles/particles.hpp"
#include "scene/case.hpp"

namespace cupel
{

/// A case turned into particles.
struct Scene
{
    Case definition;
    /// In the order of Particles::material; the first is the primary one (the liquid whose surface is followed), the
    /// second, in a two-phase scene, the surrounding. Wall particles bear the index of the primary one.
    std::vector<Material> materials;
    std::unique_ptr<Particles> particles;
    double spacing = 0; ///< m
    int dimensions = 3;
    bool two_phase = false; ///< the surrounding has particles of its own

    double particle_volume = 0; ///< spacing³ (spacing² · 1 m in two dimensions), or what a ball's share is, m³
};

/// Fills the domain's bodies with particles on a cubic lattice (a lone disc of liquid on rings), the surrounding as
/// well where it is resolved, and puts layers of wall particles behind every wall that a fluid can touch. Throws
/// CaseError where the case cannot be filled.
Scene place_particles(const Case& definition);

} // namespace cupel
