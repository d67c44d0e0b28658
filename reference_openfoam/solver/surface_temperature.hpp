/// Temperature of the interface itself, along which it varies smoothly, where that of the cells has a kink across it.
///
/// In a column of cells along the axis nearest to the normal T is continued in a straight line to the height of the
/// interface from each side, T₁ and T₂, and
///
///   T_s = (k₁ T₁ + k₂ T₂)/(k₁ + k₂),     ∇_s T = g^{ij} (∂T_s/∂x_j) e_i,     e_x = (1, 0, H_x), e_y = (0, 1, H_y)
///
/// so that T_s beside a gas is the metal's. With the mean of the cells' gradient instead, less its part along the
/// normal, what a kink leaves in it does not become less with the size of the cells; and with σ of the cells inside,
/// weighted by α, the surface tension is that of a place a fraction of a cell too deep: over a drop in a gradient of
/// temperature its sum is then off by that fraction over the radius.
#pragma once

#include "interface_geometry.hpp"

namespace cupel
{
struct SurfaceTemperature
{
    /// At the present α and T.
    SurfaceTemperature(const Scene& scene, const Fields& fields, const InterfaceGeometry& geometry);

    volScalarField value;    ///< T_s [K] in cells at the interface, T elsewhere
    volVectorField gradient; ///< ∇_s T [K/m] in cells at the interface
    volVectorField outward;  ///< unit normal toward the surrounding there, 0 elsewhere
};
} // namespace cupel
