#pragma once

#include <cstdint>
#include <vector>

#include "integrators/neighbourhood.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// A body of liquid that touches nothing.
struct FreeBody
{
    std::vector<Index> particles; ///< their places, in order
    std::vector<Vector> periods;  ///< what takes each, where the body reaches across a period, to the others, m
    bool endless = false;         ///< whether it hangs together with its own image
};

/// The bodies of liquid that touch nothing: moving particles that hang together from one to the next within the
/// reach of neighbour lists, none of which has a wall, a solid or a mirror within the kernel's support. On each of them
/// a closed surface's tension has no resultant (models/closed_surface_tension.hpp).
class FreeBodies
{
public:
    /// Found anew only where lists have changed since.
    const std::vector<FreeBody>& find(const Neighbourhood& neighbourhood, const Particles& particles,
                                      const ScalarField& mobility);

private:
    std::vector<FreeBody> bodies_;
    std::uint64_t found_for_ = 0; ///< Neighbourhood::version() then
};

} // namespace cupel::inline CUPEL_ENGINE
