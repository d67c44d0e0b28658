#pragma once

#include <type_traits>

#include "models/gradient_correction.hpp"
#include "models/velocity_gradient.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// The part of the viscous stress that a free surface feels and the bulk does not:
///
///   m_i dv_i/dt += Σ_j V_i V_j μ (A_i + A_j) ∇W_ij,   A = ∇vᵀ + (∇v + ∇vᵀ)(L − 1),   (∇vᵀ n)_a = Σ_b ∂_a v_b n_b [N]
///
/// Viscous stress is μ(∇v + ∇vᵀ). Morris's sum (momentum.hpp) is the divergence of the first half, μ∇²v; that of the
/// second is μ∇(∇·v), zero in a liquid that keeps its volume, and this sum is then zero as well. But where the kernel
/// is cut off by a free surface it gives the second half's traction, without which the surface is not free of stress:
/// a drop then dissipates ∫μ ∇v:∇v instead of ∫2μ S:S and its potential oscillation decays half as fast as it should
/// (Colagrossi, Antuono, Souto-Iglesias, Le Touzé 2011). Monaghan and Gingold's sum has both halves in one, but on a
/// lattice with h = Δx its shear viscosity is a tenth off. Antisymmetric: momentum is conserved to round-off. Walls and
/// solids continue the gradient of the liquid before them.
///
/// L is the matrix that makes gradients exact (gradient_correction.hpp), 1 inside. Of what a strain dissipates a kernel
/// that is cut off sees the share L⁻¹: Morris's sum gives ∇v L⁻¹:∇v, and a sum with ∇vᵀ alone ∇vᵀ:∇v L⁻¹, which
/// together leave out a layer of 0.4 spacings along a free surface (on a lattice; a deep wave of 16, 32, 64 spacings
/// dissipates 0.70, 0.85, 0.92 of what it should). With A the forces have the power −Σ V μ (∇v:∇v + ∇vᵀ:∇v) for any
/// strain that is linear in space, exactly (0.86, 0.96, 0.99 of the wave's). Where few neighbours are left L goes over
/// to 1 (trusted_excess).
template <bool with_walls = true> struct ViscousTraction
{
    Mobility mobility;
    const ScalarField& volume;
    VelocityGradientFields gradient;
    double viscosity;               ///< μ of the liquid, Pa·s
    CorrectionMatrix correction;    ///< L
    VectorField& force;             ///< added to
    VectorField* own_sum = nullptr; ///< keeps Σ_j V_j ∇W_ij, what continues i counted twice, where this is asked, 1/m

    template <class Scalar> struct Columns
    {
        VectorOf<Scalar> x, y, z;
    };
    template <class Scalar>
    static Columns<Scalar> corrected(const Columns<Scalar>& gradient, const Symmetric3<Scalar>& l)
    {
        const auto& [u, v, w] = gradient;
        // ∇v + ∇vᵀ
        const VectorOf<Scalar> x{u.x + u.x, u.y + v.x, u.z + w.x}, y{x.y, v.y + v.y, v.z + w.y}, z{x.z, y.z, w.z + w.z};
        const Symmetric3<Scalar> e = trusted_excess(l);
        return {u + (e.xx * x + e.xy * y + e.xz * z), v + (e.xy * x + e.yy * y + e.yz * z),
                w + (e.xz * x + e.yz * y + e.zz * z)};
    }
    struct Near
    {};
    struct Far
    {
        /// How often A_i counts: 1, beside what continues it 2
        [[no_unique_address]] std::conditional_t<with_walls, Real, Nothing> own;
        VectorOf<Real> x, y, z; ///< columns of A_j; zero of what continues that at i

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
        VectorLanes own{}, others{}; ///< Σ V_j ∇W, which A_i multiplies, and Σ V_j A_j ∇W
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    void ahead(Index first) const
    {
        prefetch(gradient, first);
        prefetch(correction, first);
    }
    Near near(Index) const { return {}; }
    Far far(Index j) const
    {
        if constexpr (with_walls)
            if (mobility.weight[j] == 0.0) return {2, {}, {}, {}};
        const Columns<double> a = corrected<double>({gradient.x[j], gradient.y[j], gradient.z[j]}, correction[j]);
        if constexpr (with_walls)
            return {1, real(a.x), real(a.y), real(a.z)};
        else
            return {{}, real(a.x), real(a.y), real(a.z)};
    }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        const VectorLanes& n = pair.volume_gradient;
        if constexpr (with_walls)
            sum.own += Lanes(j.own) * n;
        else
            sum.own += n;
        sum.others += n.x * broadcast(j.x); // one by one: each goes into the sum as it is multiplied
        sum.others += n.y * broadcast(j.y);
        sum.others += n.z * broadcast(j.z);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        const VectorLanes& n = sum.own;
        if (own_sum) store_lanes(*own_sum, cluster.first, mobility.moving_in(cluster), n);
        const auto [u, v, w] = gradient.of_cluster(cluster.first);
        const Columns<Lanes> a = corrected<Lanes>({u, v, w}, correction.of_cluster(cluster.first));
        const Lanes weight = Lanes(viscosity) * lanes(volume, cluster.first);
        store_lanes(force, cluster.first, mobility.moving_in(cluster),
                    lanes(force, cluster.first) + weight * (n.x * a.x + n.y * a.y + n.z * a.z + sum.others));
    }
};

} // namespace cupel::inline CUPEL_ENGINE
