#pragma once

#include "models/velocity_gradient.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// The part of the viscous stress that an interface between two viscosities feels and the bulk does not:
///
///   m_i dv_i/dt += Σ_j χ_ij V_i V_j (e_i ∇v_iᵀ + e_j ∇v_jᵀ) ∇W_ij,   (∇vᵀ n)_a = Σ_b ∂_a v_b n_b      [N]
///   e = μ less the least of all,   χ_ij = 2 min(μ_i, μ_j)/(μ_i + μ_j)
///
/// Viscous stress is μ(∇v + ∇vᵀ). Morris's sum (momentum.hpp) is ∇·(μ∇v); what it lacks is (∇v)ᵀ·∇μ. With it left out
/// a drop of half the viscosity that Marangoni stress drives moves with τa/(2 μ_o + 6 μ_i), not τa/(4 μ_o + 4 μ_i), a
/// fifth too fast, and one that oscillates in air dissipates half of what it should. A share of μ that is the same
/// everywhere adds nothing, and its noise is spared.
/// χ puts the share μ_i/(μ_i + μ_j) of the traction on the side of μ_i, where the plain sum puts a half on each. On the
/// side of a liquid that is next to no viscous nothing can bear a traction but a layer of shear: air around an
/// oscillating drop of water slipped along it by 1.6 times the speed of the surface, and the drop, which had to do
/// without that half, decayed at a third of its rate (oscillating_drop_2d, air_water). Antisymmetric: momentum is
/// conserved to round-off. Walls continue the gradient of the liquid before them. Own derivation.
struct ViscosityJump
{
    Mobility mobility;
    const ScalarField& volume;
    VelocityGradientFields gradient;
    const ScalarField& viscosity; ///< μ, Pa·s
    double least_viscosity;       ///< of all, Pa·s
    VectorField& force;           ///< added to

    struct Near
    {
        Lanes viscosity;
    };
    struct Far
    {
        Real liquid, viscosity; ///< liquid: 1 or 0
        VectorOf<Real> x, y, z; ///< columns of e_j ∇v_jᵀ; of a wall zero

        Far mirrored(const Vector& sign) const
        {
            const auto row = [&](double component, const VectorOf<Real>& g) {
                return VectorOf<Real>{real(component * sign.x) * g.x, real(component * sign.y) * g.y,
                                      real(component * sign.z) * g.z};
            };
            return {liquid, viscosity, row(sign.x, x), row(sign.y, y), row(sign.z, z)};
        }
    };
    struct Sum
    {
        VectorLanes own{}, others{}; ///< Σ χ V_j ∇W, which e_i ∇v_iᵀ multiplies, and Σ χ V_j e_j ∇v_jᵀ ∇W
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    void ahead(Index first) const { prefetch(gradient, first); }
    Near near(Index first) const { return {lanes(viscosity, first)}; }
    Far far(Index j) const
    {
        if (mobility.weight[j] == 0.0) return {0, 0, {}, {}, {}};
        const double excess = viscosity[j] - least_viscosity;
        return {1, real(viscosity[j]), real(excess * gradient.x[j]), real(excess * gradient.y[j]),
                real(excess * gradient.z[j])};
    }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        if (j.liquid == 0) { // counts for the liquid before it as well
            sum.own += Lanes(2.0) * pair.volume_gradient;
            return;
        }
        const Lanes share = 2.0 * minimum(i.viscosity, Lanes(j.viscosity)) / (i.viscosity + j.viscosity);
        const VectorLanes n = share * pair.volume_gradient;
        sum.own += n;
        sum.others += n.x * broadcast(j.x); // one by one: each goes into the sum as it is multiplied
        sum.others += n.y * broadcast(j.y);
        sum.others += n.z * broadcast(j.z);
    }
    void store(const Cluster& cluster, const Near& i, const Sum& sum) const
    {
        const VectorLanes& n = sum.own;
        const auto [u, v, w] = gradient.of_cluster(cluster.first);
        const Lanes excess = i.viscosity - Lanes(least_viscosity), own_volume = lanes(volume, cluster.first);
        store_lanes(force, cluster.first, mobility.moving_in(cluster),
                    lanes(force, cluster.first) + own_volume * (excess * (n.x * u + n.y * v + n.z * w) + sum.others));
    }
};

} // namespace cupel::inline CUPEL_ENGINE
