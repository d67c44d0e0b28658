#pragma once

#include "models/gradient_correction.hpp"
#include "models/surface_geometry.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// The share of a stress on a free surface that each particle takes, so that viscosity answers it exactly:
///
///   δ*_i = −n̂_i · Σ_j V_j (L_i + L_j) ∇W_ij      [1/m]
///
/// Where a shear du/dz is the same everywhere up to a plane surface, viscous forces (momentum.hpp with
/// viscous_traction.hpp) add up to −μ du/dz δ*_i: a stress τ n̂ that is given to particles as τ δ*_i drives that shear
/// and nothing else, in whatever way they are arranged. Its sum over a column is one, its first moment about the
/// surface zero: on a lattice the layers from the surface inwards take 1.43, −0.36, −0.064, −0.002 and no more. With δ
/// = 2 |∇c|, whose middle is inside the liquid, that layer lags by 7 % of the surface speed in a layer of 20 spacings
/// (marangoni_layer). Walls and solids continue the liquid before them.
/// n̂ is that of the surface's first layer, further inside its mean over what is seen of that: what a colour gradient
/// two or three layers deep points to is noise, and where it points inwards a share has the wrong sign (all of them
/// together were 5 % too much in a layer that had turned over).
struct SurfaceStressShare
{
    Mobility mobility;
    CorrectionMatrix correction; ///< L
    const VectorField& own_sum;  ///< Σ_j V_j ∇W_ij, which L_i multiplies, from viscous_traction.hpp, 1/m
    SurfaceFields surface;
    double smoothing_length; ///< h, m
    ScalarField& share;      ///< δ*; comes in as `wanted` where it is asked for
    VectorField& direction;  ///< n̂ where that is not zero

    static constexpr double wanted = 1.0;
    static constexpr bool local = true;

    struct Near
    {};
    struct Far
    {
        Symmetric3<Real> other; ///< L_j; zero of what continues the liquid before it, where L_i counts twice
        VectorOf<Real> normal;  ///< n̂ times how far j belongs to the first layer
    };
    struct Sum
    {
        VectorLanes others{}, normal{};
    };

    static Symmetric3<double> trusted(const Symmetric3<double>& l)
    {
        const Symmetric3<double> e = trusted_excess(l);
        return {1.0 + e.xx, e.xy, e.xz, 1.0 + e.yy, e.yz, 1.0 + e.zz};
    }

    bool idle(const Cluster& cluster) const
    {
        return (set_lanes(lanes(share, cluster.first) > 0.0) & mobility.moving_in(cluster)) == 0;
    }
    void ahead(Index first) const
    {
        prefetch_all(first, mobility.weight, correction, surface.delta, surface.normal, share);
    }
    Near near(Index) const { return {}; }
    Far far(Index j) const
    {
        if (mobility.weight[j] == 0.0) return {};
        const Symmetric3<double> l = trusted(correction[j]);
        return {{real(l.xx), real(l.xy), real(l.xz), real(l.yy), real(l.yz), real(l.zz)},
                real(share_of_surface(surface, j, smoothing_length) * surface.normal[j])};
    }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        const VectorLanes& r = pair.offset;
        const auto& l = j.other;
        sum.normal += pair.kernel * broadcast(j.normal);
        sum.others +=
            pair.volume_gradient_over_r * VectorLanes{Lanes(l.xx) * r.x + Lanes(l.xy) * r.y + Lanes(l.xz) * r.z,
                                                      Lanes(l.xy) * r.x + Lanes(l.yy) * r.y + Lanes(l.yz) * r.z,
                                                      Lanes(l.xz) * r.x + Lanes(l.yz) * r.y + Lanes(l.zz) * r.z};
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] == 0.0) continue;
            Vector outward = surface.normal[i];
            if (share_of_surface(surface, i, smoothing_length) == 0.0) {
                outward = {sum.normal.x[lane], sum.normal.y[lane], sum.normal.z[lane]};
                const double length = norm(outward);
                share[i] = 0.0;
                if (!(length > 0.0)) continue;
                outward = (1.0 / length) * outward;
            }
            const Vector others{sum.others.x[lane], sum.others.y[lane], sum.others.z[lane]};
            share[i] = -dot(outward, trusted(correction[i]) * own_sum[i] + others);
            direction.set(i, outward);
        }
    }
};

} // namespace cupel::inline CUPEL_ENGINE
