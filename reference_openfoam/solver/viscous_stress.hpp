/// Viscous stress of the mixture.
///
///   ∇·[μ (∇u + ∇uᵀ)],      μ = α μ₁ + (1 − α) μ₂
///
/// ∇·(μ∇u) is implicit, but for half of it, ½ μ₁ times the lesser α of a face's cells, which has the velocity of the
/// last step (Crank and Nicolson 1947). At the end of a step it would come half a step late, which is an inertia: it
/// slows whatever swings with a decay δ by ½ δ Δt of its frequency, a capillary wave of 32 cells by 0.09 %. Beside the
/// other phase it stays implicit: speeds there are rough, and a drop in light gas was 1.9 % too slow with halves of
/// both. In ∇·(μ∇uᵀ) the rates of stretch ∂u_k/∂x_k are those of the fluxes, net outflow along each axis: they add up
/// to nothing exactly, and see two faces where the cells' gradient sees two cells.
///
/// Between melt and solid the velocity is zero at their face, half a cell from the melt's middle, and not in the middle
/// of the solid's cell, where the drag of the mush holds it: a face's viscosity is the harmonic mean of its cells', a
/// solid's being infinite, μ_f = μ 2/(φ_P + φ_N) with φ the share that is not solid. With μ_f = μ a film of melt was as
/// good as a quarter of a cell deeper, and levelled 45, 29 and 24 % too fast where it is 2, 3 and 4 cells deep
/// (validation_cases/melt_film; now 10, 4 and 0.5 %).
///
/// Damping D: the implicit term's coefficient of a cell's own velocity, Σ μ A/|d| over its faces by its volume, of μ
/// what is implicit [kg/(m³ s)]. The momentum equation lets D act on the change of a face's flux, not on the flux: on
/// the flux it would act, at a face between liquid and gas, on a velocity half a cell away from that of the liquid's
/// cell, D ≈ 4μ/Δ², which is a wrong stress of 0.9 μ |∂u/∂x| at any Δ: a capillary wave had 6 % too much damping at 32
/// and at 64 cells a wave (now 0.5 % at 32).
#pragma once

#include "fields.hpp"

namespace cupel
{
class ViscousStress
{
public:
    ViscousStress(const Scene& scene, const Fields& fields);

    /// What the momentum equation has on its left side [N].
    tmp<fvVectorMatrix> resistance(volVectorField& velocity) const;
    /// D [kg/(m³ s)].
    tmp<volScalarField> damping() const;

private:
    const fvMesh& mesh_;
    const surfaceScalarField& flux_;
    const volScalarField viscosity_;
    const surfaceScalarField on_faces_; ///< μ
    const surfaceScalarField explicit_; ///< its part with the velocity of the last step
};
} // namespace cupel
