#pragma once

#include <span>

#include "kernels/pair_loop.hpp"
#include "particles/particles.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Tension, the same everywhere, pulls a body of liquid that touches nothing in no direction, whatever its shape:
///
///   ∮ σκ n̂ dA = 0      (the surface divergence theorem on a closed surface)
///
/// The force −V ∇λ of a carried load (surface_pressure.hpp) is no sum of pairs, so that its sum over a body is what
/// curvature and gradients err by. Here that sum is taken from the whole body, as a weight is:
///
///   F_i ← F_i − (m_i/M) Σ_j F_j,   F = −V ∇λ,   M = Σ_j m_j      [N]
///
/// so that momentum is conserved to round-off, and neither the body's shape nor its rotation feel it: λ may have any
/// part that is linear in space, which is harmonic, and this is the one that obeys the theorem. Own derivation.
struct ClosedSurfaceTension
{
    const ScalarField& mass;             ///< kg
    const ScalarField& volume;           ///< m³
    const VectorField& carried_gradient; ///< ∇λ, Pa/m
    VectorField& force;                  ///< N: has −V ∇λ already

    void balance(std::span<const Index> body) const
    {
        const auto count = static_cast<Index>(body.size());
        const Sum sum = ordered_sum(count, [&](Index k) {
            const Index i = body[static_cast<std::size_t>(k)];
            return Sum{volume[i] * carried_gradient[i], mass[i]};
        });
        for (const Index i : body)
            force.set(i, force[i] + (mass[i] / sum.mass) * sum.force);
    }

private:
    struct Sum
    {
        Vector force;
        double mass;
        Sum& operator+=(const Sum& other)
        {
            force += other.force;
            mass += other.mass;
            return *this;
        }
    };
};

} // namespace cupel::inline CUPEL_ENGINE
