#pragma once

#include <cstddef>
#include <vector>

#include "scene/case.hpp"

namespace cupel
{

/// A particle of a round wall.
struct RoundWallPlace
{
    Vector3 position;   ///< [m]
    Vector3 normal;     ///< out of the wall
    double depth;       ///< below its surface [m]
    double curvature;   ///< of the surface, positive where liquid lies outside the circle [1/m]
    std::size_t parent; ///< the particle of the outermost layer before it, as an index of `walls`
};

/// Places of liquid and walls about the centre of round walls.
struct RoundPlaces
{
    std::vector<Vector3> primary; ///< the drop's [m]
    std::vector<Vector3> other;   ///< the surrounding's, where it is resolved [m]
    std::vector<RoundWallPlace> walls;
    double volume; ///< of a particle of liquid, for a breadth of 1 m [m³]
};

/// Particles between round walls, on rings about their centre, a spacing apart and the first half a spacing before its
/// wall: no step lies between wall and liquid. Each ring has the number of particles that leaves a spacing between them
/// and begins the golden angle further than the last one (as in disc_on_rings), and then all are moved as shifting
/// would (even_out.hpp), walls aside. Of them those nearest to the body's centre are the drop, as many as its area
/// holds; a particle's volume is what makes that area exact, or with a resolved surrounding the mean of what volumes
/// are summed to. `layers`: of each wall. Errors: CaseError where the cylinder is too thin for them.
RoundPlaces place_between_round_walls(const Case& definition, int layers);

} // namespace cupel
