#pragma once

#include <span>

#include "kernels/pair_loop.hpp"
#include "math/rigid_motion.hpp"
#include "particles/particles.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Tension, the same everywhere, pulls a body of liquid that touches nothing in no direction and turns it no way,
/// whatever its shape:
///
///   ∮ σκ n̂ dA = 0,   ∮ x × σκ n̂ dA = 0      (the surface divergence theorem on a closed surface)
///
/// The force F = −V ∇λ of a carried load (surface_pressure.hpp) is no sum of pairs, so that its sums over a body are
/// what curvature and gradients err by. Here they are taken from the whole body, as a weight is and as if it turned
/// rigidly about its centre of mass:
///
///   F_i ← F_i − m_i [a_c + α × (x_i − x_c)],   M a_c = Σ_j F_j,   I_c α = Σ_j (x_j − x_c) × F_j      [N]
///
/// so that momentum and angular momentum are conserved to round-off, and the body's shape does not feel it: λ may have
/// any part that is linear in space, which is harmonic, and this is the one that obeys the theorem. A body that hangs
/// together with its own image beyond a period has no centre, and is not turned. Own derivation.
struct ClosedSurfaceTension
{
    const VectorField& position;         ///< m
    const ScalarField& mass;             ///< kg
    const ScalarField& volume;           ///< m³
    const VectorField& carried_gradient; ///< ∇λ, Pa/m
    VectorField& force;                  ///< N: has −V ∇λ already

    /// `periods` are added to the positions of the body's particles, m: they put it together where it reaches across a
    /// period. `turns`: whether it has a centre.
    void balance(std::span<const Index> body, std::span<const Vector> periods, bool turns) const
    {
        const auto count = static_cast<Index>(body.size());
        const Vector origin = position[body.front()] + periods.front();
        const auto place = [&](Index k) {
            const auto member = static_cast<std::size_t>(k);
            return position[body[member]] + periods[member] - origin;
        };
        const auto moments = ordered_sum(count, [&](Index k) {
            const Index i = body[static_cast<std::size_t>(k)];
            return RigidMoments::of(mass[i], place(k), (-volume[i]) * carried_gradient[i]);
        });
        RigidAcceleration spurious = moments.acceleration();
        if (!turns) spurious.angular = {};
        for (Index k = 0; k < count; ++k) {
            const Index i = body[static_cast<std::size_t>(k)];
            force.set(i, force[i] - mass[i] * spurious.at(place(k)));
        }
    }
};

} // namespace cupel::inline CUPEL_ENGINE
