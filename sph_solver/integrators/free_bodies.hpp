#pragma once

#include <cstdint>
#include <vector>

#include "integrators/neighbourhood.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// The bodies of liquid that touch nothing: moving particles that hang together from one to the next within the
/// reach of neighbour lists, none of which has a wall, a solid or a mirror within the kernel's support. On each of them
/// a closed surface's tension has no resultant, whatever its shape.
class FreeBodies
{
public:
    /// Places of the particles of each body, in order. Found anew only where lists have changed since.
    const std::vector<std::vector<Index>>& find(const Neighbourhood& neighbourhood, const Particles& particles,
                                                const ScalarField& mobility);

private:
    std::vector<std::vector<Index>> bodies_;
    std::uint64_t found_for_ = 0; ///< Neighbourhood::version() then
};

} // namespace cupel::inline CUPEL_ENGINE
