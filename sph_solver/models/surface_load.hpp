#pragma once

#include "models/surface_geometry.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// The load on the surface, the pressure L = σκ + p_r, smoothed over the band, and how it changes along it:
///
///   L̄_i = Σ_j δ_j L_j W_ij / Σ_j δ_j W_ij      [Pa]
///   ∇L_i = Σ_j δ_j (L_j − L_i) ∇W_ij / Σ_j δ_j W_ij, of which the tangential part is kept      [Pa/m]
///
/// The force takes both. With the gradient beside a load that is not smoothed as it is, a drop of Laplace number 12 000
/// at 40 spacings a diameter gains energy and flies apart after two capillary times.
struct SurfaceLoad
{
    Mobility mobility;
    const ScalarField& delta;
    const VectorField& normal;
    const ScalarField& load; ///< L, Pa; taken as zero where δ is
    ScalarField& mean;       ///< L̄
    VectorField& gradient;   ///< ∇L along the surface

    struct Near
    {
        Lanes load;
    };
    struct Far
    {
        Real weight, load;
    };
    struct Sum
    {
        Lanes weight{}, load{};
        VectorLanes gradient{};
    };

    bool idle(const Cluster& cluster) const
    {
        return none_in(cluster, [&](Index i) { return mobility.weight[i] != 0.0 && delta[i] > 0.0; });
    }
    Near near(Index first) const { return {lanes(load, first)}; }
    /// What stands bears no load: it says nothing of how that of the liquid changes.
    Far far(Index j) const
    {
        return {real(mobility.weight[j] != 0.0 && delta[j] > 0.0 ? delta[j] : 0.0), real(load[j])};
    }
    bool ignores(const Far& j) const { return j.weight == 0; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.weight += j.weight * pair.kernel;
        sum.load += (j.weight * j.load) * pair.kernel;
        sum.gradient += (j.weight * (j.load - i.load) * pair.gradient_over_r) * pair.offset;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] == 0.0) continue;
            if (!(delta[i] > 0.0) || !(sum.weight[lane] > 0.0)) {
                mean[i] = load[i];
                gradient.set(i, {});
                continue;
            }
            mean[i] = sum.load[lane] / sum.weight[lane];
            const Vector total{sum.gradient.x[lane], sum.gradient.y[lane], sum.gradient.z[lane]};
            gradient.set(i, (1.0 / sum.weight[lane]) * (total - dot(total, normal[i]) * normal[i]));
        }
    }
};

} // namespace cupel::inline CUPEL_ENGINE
