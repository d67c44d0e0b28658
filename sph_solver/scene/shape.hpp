/// Shapes of the bodies at the start, and how far a perturbed one has moved each point of the undisturbed one.
///
/// A perturbation of 1 % of a drop's radius is a tenth of a particle spacing or less: cut out of a lattice it would be
/// lost. The particles of the undisturbed shape are therefore displaced, each by as much as the surface at r = R or z =
/// upper z, by a motion that moves no volume: inside by grad(phi), phi the velocity potential of the mode (Lamb 1932,
/// sections 231, 273 and 275),
///
///   drop, 2-D   phi = (a R^2/n) (r/R)^n cos(n theta)
///   drop, 3-D   phi = (a R^2/n) (r/R)^n P_n(cos theta)
///   wave        phi = (A/k) cos(kx) cosh(k (z - bottom))/sinh(k depth), and likewise downward from the top outside
///
/// theta from the vertical. Outside a drop the stream function goes on as it is inside, times a share that fades to
/// nothing at twice the radius or at the nearest side of the domain. The potential of the outside, (R/r)^n, slips along
/// the surface by 2 a R: particles on both sides of it, a tenth of a spacing out of step, had 1 % of a wrong volume,
/// and the elastic energy of that was a hundred times the energy of the mode (oscillating_drop_2d, air around water).
#pragma once

#include "scene/case.hpp"

namespace cupel
{

/// Whether a place [m] is inside a box or sphere as it is at the start, perturbation and wave included; false for a
/// powder bed.
bool contains(const Body& body, const Vector3& position, int dimensions);

/// The same for the undisturbed shape.
bool contains_undisturbed(const Body& body, const Vector3& position, int dimensions);

/// Displacement [m] of a point of the undisturbed scene by a body's perturbation or wave; zero where it has none.
Vector3 displacement(const Body& body, const Domain& domain, const Vector3& position, int dimensions);

} // namespace cupel
