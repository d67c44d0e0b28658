/// Marangoni stress as a body force at the interface (Brackbill 1992; the paper, section 2.6).
///
///   F = (dσ/dT) ∇_s T (n̂·∇S) f_l      [N/m³],     S(α) = 3α² − 2α³
///
/// S steps from 0 to 1 as α does, in fewer cells: what acts below the surface drives the liquid above it less (with
/// |∇α| 15 % of the stress acted below the last full cell of a layer of 20, and its surface was 3 % too slow). The step
/// of S across a face is shared out between its two cells by their density: the sum across the interface stays one, and
/// a light gas is not thrown about. f_l: solid metal has no mobile surface.
#pragma once

#include "surface_temperature.hpp"

namespace cupel
{
/// The force density in cells [N/m³].
tmp<volVectorField> marangoni_force(const Scene& scene, const Fields& fields, const SurfaceTemperature& surface);
} // namespace cupel
