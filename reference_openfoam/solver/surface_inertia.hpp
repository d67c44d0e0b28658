/// Inertia of the last half cells below a surface, to one order more than by means of cells.
///
/// Along a column of cells the momentum equation has, from one cell's middle to the next, the mean of their densities
/// times the acceleration a of the face between. Up to a surface that leaves α of its cell to the liquid this sums to
/// ρ ∫ a dx but for the rate at which a changes below the surface, a′ = ∂a/∂x:
///
///   sum − ∫ = ρ Δ² a′ [1/8 + α(1 − α)/2]
///
/// (1/8: the half cell that the sum begins with has the acceleration of its far end; α(1 − α)/2: a cell's liquid has
/// that of the cell's middle, not of its own). This is three quarters of the error of second order of a capillary
/// wave's inertia, 2/3 (kΔ/2)². It is taken off face by face, for the fuller cell X and the other Y,
///
///   ρ C (a − a_X),   C = (X − Y)/8 + n̂ {X(1 − X) X/(1 + 2X) + Y(1 − Y) (1 + Y)/(1 + 2Y)}/2,
///
/// a_X: of the face across X, so that a − a_X = Δ a′; n̂: component along the face's normal of the interface's. What a
/// cell of α has in excess is shared by its faces as their masses are between a full cell and an empty one, 1 + α to
/// α; over such a column C sums to the bracket above. C leaves every face half its mass at least; shared as 1 − α to α
/// it took as much from a sliver's face, and a steel drop off the middle of its cell had 0.056 m/s for 0.045. C is the
/// same seen from the other side, where the lighter phase's a′ is: the density is ρ₁ with the fuller cell's a′, ρ₂
/// with the emptier one's.
///
/// The face's own acceleration is implicit: C ρ is off its inertia. Taken from the last step it would be the force
/// m a(t − Δt) ≈ m a + m ω² Δt u on a wave of frequency ω, which drives it: the shortest waves grow by up to a tenth a
/// step, and a steel drop of five cells a radius shook itself apart. The other face's acceleration, which enters with
/// the other sign and is less by e^(−kΔ), is that of the last pressure correction.
///
/// Cells are accelerated by what their faces feel beside this, pressure and forces, with their whole mass: with the
/// faces' lesser one viscous stress would weigh less than pressure, and a drop drawn to the hot side was 1.3 % too
/// fast.
#pragma once

#include "interface_geometry.hpp"

namespace cupel
{
class SurfaceInertia
{
public:
    SurfaceInertia(const Scene& scene, const Fields& fields, const InterfaceGeometry& geometry);

    /// What means of cells have too much on each face: (ρ₁ + ρ₂) C [kg/m³].
    tmp<surfaceScalarField> excess() const;
    /// What of it moves as the faces across do: C (ρ₁ a_X + ρ₂ a_Y) by area [N], for fluxes that change by
    /// `acceleration` [m³/s²].
    tmp<surfaceScalarField> carried(const surfaceScalarField& acceleration) const;

private:
    const fvMesh& mesh_;
    const dimensionedScalar primary_, surrounding_; ///< densities
    const surfaceScalarField drop_;                 ///< α of a face's owner less that of its neighbour
    surfaceScalarField share_;                      ///< C
};
} // namespace cupel
