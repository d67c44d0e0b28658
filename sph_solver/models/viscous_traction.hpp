#pragma once

#include "models/velocity_gradient.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// The part of the viscous stress that a free surface feels and the bulk does not:
///
///   m_i dv_i/dt += Σ_j V_i V_j μ (∇v_iᵀ + ∇v_jᵀ) ∇W_ij,   (∇vᵀ n)_a = Σ_b ∂_a v_b n_b      [N]
///
/// Viscous stress is μ(∇v + ∇vᵀ). Morris's sum (momentum.hpp) is the divergence of the first half, μ∇²v; that of the
/// second is μ∇(∇·v), zero in a liquid that keeps its volume, and this sum is then zero as well. But where the kernel
/// is cut off by a free surface it gives the second half's traction, without which the surface is not free of stress:
/// a drop then dissipates ∫μ ∇v:∇v instead of ∫2μ S:S and its potential oscillation decays half as fast as it should
/// (Colagrossi, Antuono, Souto-Iglesias, Le Touzé 2011). Monaghan and Gingold's sum has both halves in one, but on a
/// lattice with h = Δx its shear viscosity is a tenth off. Antisymmetric: momentum is conserved to round-off. Walls and
/// solids continue the gradient of the liquid before them.
///
/// Between two viscosities the same half is (∇v)ᵀ·∇μ, which Morris's sum lacks as well: with it left out a drop of half
/// the viscosity that Marangoni stress drives moves with τa/(2 μ_o + 6 μ_i), not τa/(4 μ_o + 4 μ_i), a fifth too fast.
/// There each side has its own μ, less the least of all: a share that is the same everywhere adds nothing.
struct ViscousTraction
{
    Mobility mobility;
    const ScalarField& volume;
    VelocityGradientFields gradient;
    double viscosity;       ///< μ of the liquid, Pa·s; 1 between two
    const ScalarField* own; ///< μ_i less the least of all, Pa·s; null where there is one
    VectorField& force;     ///< added to

    double share(Index i) const { return own ? (*own)[i] : 1.0; }

    struct Near
    {};
    struct Far
    {
        Real own;               ///< how often the gradient at i counts: 1, beside what continues it 2
        VectorOf<Real> x, y, z; ///< rows of ∇v_j; zero of what continues that at i

        Far mirrored(const Vector& sign) const
        {
            const auto row = [&](double component, const VectorOf<Real>& g) {
                return VectorOf<Real>{real(component * sign.x) * g.x, real(component * sign.y) * g.y,
                                      real(component * sign.z) * g.z};
            };
            return {own, row(sign.x, x), row(sign.y, y), row(sign.z, z)};
        }
    };
    struct Sum
    {
        VectorLanes own{}, others{}; ///< Σ V_j ∇W, which ∇v_iᵀ multiplies, and Σ V_j ∇v_jᵀ ∇W
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index) const { return {}; }
    Far far(Index j) const
    {
        const double liquid = mobility.weight[j], weight = liquid * share(j);
        return {real(2.0 - liquid), real(weight * gradient.x[j]), real(weight * gradient.y[j]),
                real(weight * gradient.z[j])};
    }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        const VectorLanes& n = pair.volume_gradient;
        sum.own += Lanes(j.own) * n;
        sum.others += n.x * broadcast(j.x) + n.y * broadcast(j.y) + n.z * broadcast(j.z);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane)
            if (const Index i = cluster.first + lane; mobility.weight[i] != 0.0) {
                const Vector n{sum.own.x[lane], sum.own.y[lane], sum.own.z[lane]};
                const Vector others{sum.others.x[lane], sum.others.y[lane], sum.others.z[lane]};
                const Vector traction =
                    share(i) * (n.x * gradient.x[i] + n.y * gradient.y[i] + n.z * gradient.z[i]) + others;
                force.set(i, force[i] + viscosity * volume[i] * traction);
            }
    }
};

} // namespace cupel::inline CUPEL_ENGINE
