/// A plane that cuts a unit cube: where it lies for a given volume below it, and the volume below it in a part of the
/// cube (Scardovelli and Zaleski 2000, Journal of Computational Physics 164, 228).
///
///   m·x = d,  m_i >= 0, m_1 + m_2 + m_3 = 1;     V(d) = volume of the cube's part with m·x < d, 0 … 1
///
/// V is made of cubic, square and linear pieces in d, point-symmetric about d = ½.
#pragma once

#include "foam.hpp"

namespace cupel
{
/// V(d) for |m| in any order.
scalar volume_below(const vector& slopes, scalar distance);

/// d with V(d) = volume.
scalar distance_of(const vector& slopes, scalar volume);

/// Volume that the region n·x < d, of volume `share` in the unit cube, has in the slab next to the cube's lower (upper
/// = false) or upper side along `axis`, `thickness` of the cube thick. `outward`: n with any signs and length, not
/// zero.
scalar volume_in_slab(const vector& outward, scalar share, int axis, bool upper, scalar thickness);
} // namespace cupel
