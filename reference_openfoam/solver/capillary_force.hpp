/// Surface tension as a balanced continuum force on faces (Brackbill 1992; Francois 2006).
///
///   F = σ(T) κ ∂S/∂n          [N/m³] on a face,     S(α) = 3α² − 2α³
///
/// S steps from 0 to 1 as α does, in fewer cells, so that the pressure of the surface acts where the surface is; α
/// itself puts a part of it a cell too deep or too high. A light gas is not thrown about by it, because accelerations
/// on faces have the mean of the two cells' densities (momentum_equation.hpp): ∂S/∂n / ρ stays within three times that
/// of a step in proportion to mass. Solid metal has no mobile surface: the force carries the liquid fraction there.
#pragma once

#include "surface_temperature.hpp"

namespace cupel
{
/// ∂S/∂n on faces [1/m]: shared by the capillary force and the recoil pressure.
tmp<surfaceScalarField> interface_step_gradient(const Fields& fields);

/// Adds σ κ ∂S/∂n to `force` [N/m³]; `surface`: none where the scene has no temperature.
void add_capillary_force(surfaceScalarField& force, const surfaceScalarField& interface_gradient, const Scene& scene,
                         const InterfaceGeometry& geometry, const SurfaceTemperature* surface);
} // namespace cupel
