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
/// There the fields hold (μ_i − least μ) ∇v_i and `viscosity` is one: a share that is the same everywhere adds nothing.
struct ViscousTraction
{
    Mobility mobility;
    const ScalarField& volume;
    VelocityGradientFields gradient;
    double viscosity;   ///< μ of the liquid, Pa·s; 1 where the fields hold stresses
    VectorField& force; ///< added to

    struct Near
    {
        Lanes volume;
        VectorLanes x, y, z;
    };
    struct Far
    {
        Real volume, liquid; ///< liquid: 1 or 0
        VectorOf<Real> x, y, z;

        Far mirrored(const Vector& sign) const
        {
            const auto row = [&](double component, const VectorOf<Real>& g) {
                return VectorOf<Real>{real(component * sign.x) * g.x, real(component * sign.y) * g.y,
                                      real(component * sign.z) * g.z};
            };
            return {volume, liquid, row(sign.x, x), row(sign.y, y), row(sign.z, z)};
        }
    };
    struct Sum
    {
        VectorLanes force{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const
    {
        return {lanes(volume, first), lanes(gradient.x, first), lanes(gradient.y, first), lanes(gradient.z, first)};
    }
    Far far(Index j) const
    {
        return {real(volume[j]), real(mobility.weight[j]), real(gradient.x[j]), real(gradient.y[j]),
                real(gradient.z[j])};
    }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        const VectorLanes weight = (i.volume * j.volume * pair.gradient_over_r) * pair.offset;
        const auto both = [&](const VectorLanes& own, const VectorOf<Real>& other) {
            return j.liquid != 0 ? own + broadcast(other) : own + own;
        };
        sum.force += weight.x * both(i.x, j.x) + weight.y * both(i.y, j.y) + weight.z * both(i.z, j.z);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane)
            if (const Index i = cluster.first + lane; mobility.weight[i] != 0.0)
                force.set(i, force[i] + viscosity * Vector{sum.force.x[lane], sum.force.y[lane], sum.force.z[lane]});
    }
};

} // namespace cupel::inline CUPEL_ENGINE
