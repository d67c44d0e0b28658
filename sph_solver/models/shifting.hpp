#pragma once

#include <cmath>

#include "models/shifting_exchange.hpp"
#include "models/term.hpp"
#include "models/velocity_gradient.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// U = min(20 s h γ̇, U_greatest), of which shifting velocities are a share      [m/s]
template <class Scalar>
Scalar shifting_speed(double strength, double smoothing_length, const Scalar& strain_rate, double greatest)
{
    const Scalar speed = Scalar(20.0 * strength * smoothing_length) * strain_rate;
    return select(speed < Scalar(greatest), speed, Scalar(greatest));
}

/// Shifting velocity (Lind et al. 2012, with the pairing correction of Sun et al. 2017), scaled by the local strain:
///
///   δu_i = −U_i 2h Σ_j [1 + 0.2 (W_ij/W(Δx))⁴] V_j ∇W_ij,   U_i = min(20 s h γ̇_i, 0.1 c₀),   |δu_i| ≤ ½ U_i   [m/s]
///
/// The limit ½ U is the published one (Sun et al. 2019, eq. 10). The factor 20 is fitted: with it (s = 1) a closed
/// layer that turns over keeps its particles evenly spaced; a fifth of it leaves rows that are half again as dense
/// along the flow as across it. Particles are moved where the flow distorts their arrangement and in proportion to it,
/// nowhere else: a drop at rest is left alone, and one fast particle moves no other. In the surface's band only the
/// tangential part is kept where |∇c| is large, which is the outermost row's on a lattice (the second row has 0.037/h);
/// further inside |∇c| is noise, and as parallel to δu as can be.
struct ShiftingVelocity
{
    Mobility mobility;
    double strength;          ///< s
    double smoothing_length;  ///< h, m
    double greatest_speed;    ///< 0.1 c₀, m/s
    double kernel_at_spacing; ///< W(Δx)
    double tangential_above;  ///< |∇c| above which only the tangential part is kept in the surface's band, 1/m
    VelocityGradientFields velocity_gradient; ///< whose strain scales the shift
    const ScalarField& mass;
    double lattice_mass; ///< of a particle at the start, kg
    const ScalarField& companions;
    double fewest_companions;           ///< with fewer, a particle is spray and is left alone
    const VectorField* colour_gradient; ///< out of the liquid, 1/m
    const ScalarField& surface_delta;   ///< above zero in the surface's band
    VectorField& shift;
    ScalarField& inner_speed; ///< U where liquid is neither spray nor in the surface's band, elsewhere zero, m/s
    ScalarField* band_speed;  ///< U in that band; null where nothing melts

    struct Near
    {
        Lanes closeness; ///< over the kernel: 0.2^¼/W(Δx)
    };
    struct Sum
    {
        VectorLanes concentration{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    void ahead(Index first) const
    {
        prefetch_all(first, mass, companions, *colour_gradient, surface_delta, shift, inner_speed);
    }
    Near near(Index) const { return {std::pow(0.2, 0.25) / kernel_at_spacing}; }
    Nothing far(Index) const { return {}; }
    void add(const Near& i, Nothing, const Pair& pair, Sum& sum) const
    {
        const Lanes closeness = i.closeness * pair.kernel;
        const Lanes square = closeness * closeness;
        sum.concentration += (1.0 + square * square) * pair.volume_gradient;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        const Index first = cluster.first;
        const unsigned liquid = mobility.moving_in(cluster);
        const Lanes zero(0.0), one(1.0);
        const LaneMask spray = lanes(companions, first) < fewest_companions;
        const Lanes greatest =
            shifting_speed(strength, smoothing_length, velocity_gradient.strain_rates(first), greatest_speed);
        const Lanes speed = select(spray, zero, exchange_balance(lanes(mass, first), lattice_mass) * greatest);
        const LaneMask in_band = lanes(surface_delta, first) > zero;
        store_lanes(inner_speed, first, liquid, select(spray | in_band, zero, greatest));
        if (band_speed) store_lanes(*band_speed, first, liquid, select(in_band, select(spray, zero, greatest), zero));
        VectorLanes u = (Lanes(-2.0 * smoothing_length) * speed) * sum.concentration;
        const Lanes limit = 0.5 * speed, magnitude = square_root(dot(u, u));
        u = select(magnitude > limit, limit / magnitude, one) * u;
        const VectorLanes gradient = lanes(*colour_gradient, first);
        const Lanes slope = dot(gradient, gradient);
        const LaneMask tangential = in_band & (slope > tangential_above * tangential_above);
        u -= select(tangential, dot(u, gradient) / slope, zero) * gradient;
        store_lanes(shift, first, liquid, u);
    }
};

/// The shifting velocity of walls and solids, such that nothing flows through them: δu_w = −Σ δu_f W / Σ W.
struct WallShift
{
    Mobility mobility;
    VectorField& shift;

    struct Near
    {};
    using Far = Of<Real, quantity::Liquid, quantity::Shift>;
    struct Sum
    {
        Lanes weight{};
        VectorLanes shift{};
    };

    bool idle(const Cluster& cluster) const { return mobility.all_in(cluster); }
    Near near(Index) const { return {}; }
    Far far(Index j) const { return {real(mobility.weight[j]), real(shift[j])}; }
    bool ignores(const Far& j) const { return j.liquid == 0; }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.weight += pair.kernel;
        sum.shift += pair.kernel * broadcast(j.shift);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] != 0.0) continue;
            const double weight = sum.weight[lane];
            const Vector total{sum.shift.x[lane], sum.shift.y[lane], sum.shift.z[lane]};
            shift.set(i, weight > 0.0 ? (-1.0 / weight) * total : Vector{});
        }
    }
};

} // namespace cupel::inline CUPEL_ENGINE
