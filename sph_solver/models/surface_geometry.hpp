#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Where the liquid's surface is, which way it faces and how it curves, per particle. `colour` is 1 in the primary
/// liquid and 0 in the surrounding; wall particles may carry any share in between.
struct SurfaceFields
{
    ScalarField& colour;
    VectorField& colour_gradient; ///< −∇c, 1/m: points out of the liquid
    ScalarField& smoothed_colour; ///< Σ V W c (free surface), Σ V W c / Σ V W (two phases)
    ScalarField& companions;      ///< neighbours of any kind within counting_reach, itself included
    VectorField& normal;          ///< n̂, out of the liquid
    VectorField& smoothed_normal;
    ScalarField& delta;              ///< δ, 1/m: its integral across the surface is one
    ScalarField& in_band;            ///< 1 where |∇c| h marks the surface itself
    ScalarField& depth;              ///< distance below the surface, positive in the liquid, m
    ScalarField& raw_curvature;      ///< ∇·n̂, 1/m
    ScalarField& curvature_share;    ///< how much raw_curvature counts where it is smoothed; 0 where there is none
    ScalarField& curvature;          ///< raw_curvature smoothed over the band
    ScalarField* exposure = nullptr; ///< e of metal_surface.hpp; null where nothing melts

    static SurfaceFields register_in(Particles& particles)
    {
        const auto scalar = [&](const char* name, const char* unit) -> ScalarField& {
            return particles.add_scalar({name, unit});
        };
        const auto vector = [&](const char* name, const char* unit) -> VectorField& {
            return particles.add_vector({name, unit});
        };
        return {scalar("colour", "1"),          vector("colour_gradient", "1/m"), scalar("smoothed_colour", "1"),
                scalar("companions", "1"),      vector("surface_normal", "1"),    vector("smoothed_normal", "1"),
                scalar("surface_delta", "1/m"), scalar("surface_band", "1"),      scalar("surface_depth", "m"),
                scalar("raw_curvature", "1/m"), scalar("curvature_share", "1"),   scalar("curvature", "1/m")};
    }
};

/// How far a particle belongs to the surface's first layer, by |∇c| h and by its depth: on a lattice they are 0.46 and
/// 0.5 h there, 0.04 and 1.5 h in the second layer. Depth decides where the first layer is loose: what lies below it
/// has a |∇c| h of up to 0.25 there, but normals of noise, and a curvature of the limit's size. As a load on the
/// surface that drove what was loose apart (static_drop_free_la120_jitter). Where metal melts, whether anything lies
/// above a particle decides instead: in a concave edge what is at the surface looks deep (metal_surface.hpp).      [1]
inline double share_of_surface(const SurfaceFields& surface, Index i, double smoothing_length)
{
    if (!(surface.delta[i] > 0.0)) return 0.0;
    const double slope = norm(surface.colour_gradient[i]) * smoothing_length;
    const double exposure = surface.exposure ? (*surface.exposure)[i]
                                             : std::clamp((1.25 - surface.depth[i] / smoothing_length) / 0.5, 0.0, 1.0);
    return std::clamp((slope - 0.15) / 0.15, 0.0, 1.0) * exposure;
}

/// Thresholds of the surface band, all relative to the smoothing length h.
struct SurfaceThresholds
{
    double band = 0.25;               ///< |∇c| h above which a particle is at the surface
    double curvature_two_phase = 0.1; ///< δ h above which curvature is fitted
    double curvature_free_surface = 0.2;
    double fewest_companions = 10.0 / 32.0; ///< share of a full neighbourhood below which there is only spray
};

/// Colour gradient (Morris 2000, eq. 9):
///
///   two phases:    −∇c_i = −Σ_j V_j (c_j − c_i) ∇W_ij       free surface:    −∇c_i = −Σ_j V_j c_j ∇W_ij      [1/m]
///
/// With a free surface the sum over nothing outside counts as c = 0 there; without walls all else has c = 1.
template <bool two_phase, bool with_walls = true> struct ColourGradient
{
    static constexpr bool has_colour = two_phase || with_walls;

    Mobility mobility;
    double smoothing_length;
    SurfaceFields surface;

    struct Near
    {
        [[no_unique_address]] std::conditional_t<two_phase, Lanes, Nothing> colour;
    };
    struct Far
    {
        [[no_unique_address]] std::conditional_t<has_colour, Real, Nothing> colour;
    };
    struct Sum
    {
        VectorLanes gradient{};
        Lanes colour{}, companions{};
        [[no_unique_address]] std::conditional_t<two_phase, Lanes, Nothing> weight{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    void ahead(Index first) const
    {
        prefetch_all(first, surface.colour_gradient, surface.smoothed_colour, surface.companions);
    }
    Near near([[maybe_unused]] Index first) const
    {
        if constexpr (two_phase)
            return {lanes(surface.colour, first)};
        else
            return {};
    }
    Far far([[maybe_unused]] Index j) const
    {
        if constexpr (has_colour)
            return {real(surface.colour[j])};
        else
            return {};
    }
    void add([[maybe_unused]] const Near& i, [[maybe_unused]] const Far& j, const Pair& pair, Sum& sum) const
    {
        if constexpr (two_phase)
            sum.gradient -= (j.colour - i.colour) * pair.volume_gradient;
        else if constexpr (with_walls)
            sum.gradient -= Lanes(j.colour) * pair.volume_gradient;
        else
            sum.gradient -= pair.volume_gradient;
        if constexpr (has_colour)
            sum.colour += j.colour * pair.volume_kernel;
        else
            sum.colour += pair.volume_kernel;
        if constexpr (two_phase) sum.weight += pair.volume_kernel;
        sum.companions += select(counted(pair, smoothing_length), 1.0, 0.0);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        const unsigned liquid = mobility.moving_in(cluster);
        store_lanes(surface.colour_gradient, cluster.first, liquid, sum.gradient);
        if constexpr (two_phase)
            store_lanes(surface.smoothed_colour, cluster.first, liquid, sum.colour / sum.weight);
        else
            store_lanes(surface.smoothed_colour, cluster.first, liquid, sum.colour);
        store_lanes(surface.companions, cluster.first, liquid, sum.companions);
    }
};

/// Smoothed normals of a free surface, with the weight δ W over the band: those of single particles are too noisy to be
/// differentiated. (Between two phases: normal_of_depth.hpp.)
///
///   n̂_i ← Σ_j δ_j W_ij n̂_j / |…|      [1]
struct NormalSmoothing
{
    Mobility mobility;
    SurfaceFields surface;

    struct Near
    {};
    struct Far
    {
        Real weight; ///< δ_j, 0 where there is no surface
        VectorOf<Real> weighted_normal;
    };
    struct Sum
    {
        VectorLanes normal{};
    };

    bool idle(const Cluster& cluster) const
    {
        return (set_lanes(lanes(surface.delta, cluster.first) > 0.0) & mobility.moving_in(cluster)) == 0;
    }
    Near near(Index) const { return {}; }
    Far far(Index j) const
    {
        const double weight = std::max(0.0, surface.delta[j]);
        return {real(weight), real(weight * surface.normal[j])};
    }
    bool ignores(const Far& j) const { return j.weight == 0; }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.normal += pair.kernel * broadcast(j.weighted_normal);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] == 0.0 || !(surface.delta[i] > 0.0)) continue;
            const Vector normal{sum.normal.x[lane], sum.normal.y[lane], sum.normal.z[lane]};
            const double length = norm(normal);
            surface.smoothed_normal.set(i, length > 0.0 ? (1.0 / length) * normal : surface.normal[i]);
        }
    }
};

/// Marks particles that have a neighbour at the surface itself: only they bear surface forces, so that the noise of
/// ∇c in the bulk does not.
struct SurfaceNeighbourhood
{
    Mobility mobility;
    double reach; ///< how far a neighbour may be, m; among solids, which keep their lattice, not as far as one of its
                  ///< distances, or round-off would decide
    SurfaceFields surface;

    struct Near
    {};
    struct Far
    {
        Real at_surface; ///< 1 or 0
    };
    struct Sum
    {
        Lanes found{};
    };

    bool idle(const Cluster& cluster) const
    {
        const LaneMask beside = lanes(surface.delta, cluster.first) > 0.0,
                       at = lanes(surface.in_band, cluster.first) > 0.0;
        return (set_lanes(beside) & ~set_lanes(at) & mobility.moving_in(cluster)) == 0;
    }
    Near near(Index) const { return {}; }
    Far far(Index j) const { return {real(mobility.weight[j] * surface.in_band[j])}; }
    bool ignores(const Far& j) const { return j.at_surface == 0; }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.found += select(pair.square < reach * reach, j.at_surface * pair.kernel, 0.0);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        // raw_curvature is free at this stage and keeps the mark until the curvature itself is fitted.
        store_lanes(
            surface.raw_curvature, cluster.first,
            lanes_where(cluster, [&](Index i) { return mobility.weight[i] != 0.0 && surface.in_band[i] == 0.0; }),
            sum.found);
    }
};

/// Curvature by least squares in the tangent plane: the matrix ∂n̂_a/∂x_b over the two tangents is fitted to the
/// differences of normals with the weights w_j = −(1/r dW/dr) V_j δ_j, and its trace is taken:
///
///   κ_i = tr { [Σ w Δn̂ ⊗ Δx] [Σ w Δx ⊗ Δx]⁻¹ },   Δx, Δn̂ projected on the tangents      [1/m]
///
/// and from it that of the surface itself, which lies s outside (of_parallel_surface). The depth s was taken from the
/// smoothed colour as if the surface were flat; where it is not, ½ κ ⟨x²⟩ is added
/// (ColourProfile::tangential_variance). Unlike −∇·n̂ summed with kernel gradients it needs no full neighbourhood on
/// both sides of the band.
struct TangentPlaneCurvature
{
    Mobility mobility;
    int dimensions;
    double smallest_delta;     ///< below it a particle takes no part, 1/m
    double greatest_curvature; ///< limit, 1/m
    double flatness;           ///< ½ ⟨x²⟩ of the kernel along the surface, m²; 0 leaves depths as they are
    const ScalarField& volume;
    SurfaceFields surface;

    /// Sum of the principal curvatures k/(1 + k s) of the surface that lies at the distance s outside one whose
    /// curvatures have the sum and the product given; no nearer to its centres than half the radius.
    static double of_parallel_surface(double sum, double product, double distance)
    {
        return (sum + 2.0 * product * distance) / std::max(0.5, 1.0 + sum * distance + product * distance * distance);
    }

    struct Near
    {
        VectorLanes normal, tangent_1, tangent_2;
    };
    struct Far
    {
        Real weight; ///< −V_j δ_j; 0 where j takes no part
        VectorOf<Real> normal;
    };
    struct Sum
    {
        Lanes xx{}, xy{}, yy{};               // Σ w Δx ⊗ Δx
        Lanes n1_x{}, n1_y{}, n2_x{}, n2_y{}; // Σ w Δn̂ ⊗ Δx
    };

    bool idle(const Cluster& cluster) const
    {
        return none_in(cluster,
                       [&](Index i) { return mobility.weight[i] != 0.0 && surface.delta[i] >= smallest_delta; });
    }
    Near near(Index first) const
    {
        const VectorLanes normal = lanes(surface.normal, first);
        if (dimensions == 2) return {normal, {-normal.z, Lanes{}, normal.x}, {Lanes{}, Lanes(1.0), Lanes{}}};
        // Any vector that is not along the normal starts the pair of tangents.
        const LaneMask along_x = normal.x * normal.x > 0.49;
        const VectorLanes start{select(along_x, 0.0, 1.0), select(along_x, 1.0, 0.0), 0.0};
        VectorLanes tangent = cross(normal, start);
        tangent = reciprocal_root_of_positive(dot(tangent, tangent)) * tangent;
        return {normal, tangent, cross(normal, tangent)};
    }
    Far far(Index j) const
    {
        const double delta = surface.delta[j];
        return {real(delta >= smallest_delta ? -volume[j] * delta : 0.0), real(surface.normal[j])};
    }
    bool ignores(const Far& j) const { return j.weight == 0; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        const Lanes weight = j.weight * pair.gradient_over_r;
        const VectorLanes change = broadcast(j.normal) - i.normal;
        const Lanes x1 = -dot(pair.offset, i.tangent_1), x2 = -dot(pair.offset, i.tangent_2);
        const Lanes n1 = dot(change, i.tangent_1), n2 = dot(change, i.tangent_2);
        sum.xx += weight * x1 * x1;
        sum.xy += weight * x1 * x2;
        sum.yy += weight * x2 * x2;
        sum.n1_x += weight * n1 * x1;
        sum.n1_y += weight * n1 * x2;
        sum.n2_x += weight * n2 * x1;
        sum.n2_y += weight * n2 * x2;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] == 0.0) continue;
            surface.raw_curvature[i] = 0.0;
            surface.curvature_share[i] = 0.0;
            if (!(surface.delta[i] >= smallest_delta)) continue;
            const double xx = sum.xx[lane], xy = sum.xy[lane], yy = sum.yy[lane];
            double trace = 0.0, product = 0.0;
            if (dimensions == 2) {
                if (!(xx > 0.0)) continue;
                trace = sum.n1_x[lane] / xx;
            }
            else {
                const double determinant = xx * yy - xy * xy;
                if (!(determinant > 1e-3 * (xx + yy) * (xx + yy))) continue;
                trace = (sum.n1_x[lane] * yy - sum.n1_y[lane] * xy + sum.n2_y[lane] * xx - sum.n2_x[lane] * xy) /
                        determinant;
                product = (sum.n1_x[lane] * sum.n2_y[lane] - sum.n1_y[lane] * sum.n2_x[lane]) / determinant;
            }
            surface.depth[i] += flatness * std::clamp(trace, -greatest_curvature, greatest_curvature);
            const double curvature = of_parallel_surface(trace, product, surface.depth[i]);
            surface.raw_curvature[i] = std::clamp(curvature, -greatest_curvature, greatest_curvature);
            surface.curvature_share[i] = 1.0;
        }
    }
};

/// κ̄_i = Σ_j κ_j q_j δ_j W_ij / Σ_j q_j δ_j W_ij over the particles that have a curvature      [1/m]
/// q: beside one liquid in nothing what of a particle is the surface's first layer (share_of_surface), between two one
struct CurvatureSmoothing
{
    Mobility mobility;
    SurfaceFields surface;
    const ScalarField& share; ///< q; zero where there is no curvature
    const ScalarField& value; ///< κ
    ScalarField& smoothed;    ///< κ̄; zero where the surface bears no force

    struct Near
    {};
    struct Far
    {
        Real weight, weighted_curvature;
    };
    struct Sum
    {
        Lanes curvature{}, weight{};
    };

    bool idle(const Cluster& cluster) const
    {
        return (set_lanes(lanes(surface.delta, cluster.first) > 0.0) & mobility.moving_in(cluster)) == 0;
    }
    Near near(Index) const { return {}; }
    Far far(Index j) const
    {
        const double weight = share[j] > 0.0 ? share[j] * surface.delta[j] : 0.0;
        return {real(weight), real(weight * value[j])};
    }
    bool ignores(const Far& j) const { return j.weight == 0; }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.curvature += j.weighted_curvature * pair.kernel;
        sum.weight += j.weight * pair.kernel;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] == 0.0) continue;
            const bool bears_force = surface.delta[i] > 0.0 && sum.weight[lane] > 0.0;
            smoothed[i] = bears_force ? sum.curvature[lane] / sum.weight[lane] : 0.0;
        }
    }
};

} // namespace cupel::inline CUPEL_ENGINE
