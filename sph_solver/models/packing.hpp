#pragma once

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// What keeps a particle's density that of the arrangement it lies in:
///
///   dρ_i/dt += (U_i/h) ρ_i (C_i − C₀),   C_i = Σ_j V_j W_ij      [kg/(m³ s)]
///
/// Continuity (continuity.hpp) follows C exactly as long as volumes stay as they are. They do not: each particle's
/// V = m/ρ wanders as it passes others, and with it how many volumes lie on top of each other, where no pressure tells:
/// a closed layer at a Reynolds number of 100 that turned over ten times lost a tenth of its depth, and Poiseuille flow
/// at Re 10 and a sound speed 100 times the flow's became 11 % too fast (2 and 0.4 % with this). Where C exceeds one,
/// volumes overlap: the liquid is denser than ρ says, and pressure then drives it apart. The rate is that of shifting,
/// so that what is at rest is left alone, and no other number enters. Only inside the liquid, where kernels are full;
/// |C − C₀| counts up to 0.1. C₀ is that of a lattice: one but for what the kernel's sum misses (−6·10⁻⁵ in two
/// dimensions), by which liquid in perfect order would lose density as it moves. Own derivation; compare the
/// volume-conserving shifting of Lyu and others 2022, which moves particles to the same end.
///
/// At a surface kernels are not full, and C < C₀ says nothing. But C > C₀ does: where metal melts it counts in the
/// surface's band as well. The front of melt that spreads on its solid would thin as a film does that has no particles,
/// by continuity alone, and its last particles sink into the solid's rows.
struct Packing
{
    Mobility mobility;
    double smoothing_length;       ///< h, m
    double lattice_packing;        ///< C₀
    const ScalarField& speed;      ///< U of shifting; zero outside, m/s
    const ScalarField* band_speed; ///< U in the surface's band; null where nothing melts
    const ScalarField& density;
    ScalarField& density_rate; ///< kg/(m³ s)

    struct Near
    {};
    struct Sum
    {
        Lanes packing{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    void ahead(Index first) const { prefetch_all(first, density, density_rate); }
    Near near(Index) const { return {}; }
    Nothing far(Index) const { return {}; }
    void add(const Near&, Nothing, const Pair& pair, Sum& sum) const { sum.packing += pair.volume_kernel; }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        const Lanes rate = Lanes(1.0 / smoothing_length) * lanes(speed, cluster.first) * lanes(density, cluster.first);
        const Lanes excess = clamp(sum.packing - lattice_packing, -0.1, 0.1);
        Lanes sum_of_rates = rate * excess;
        if (band_speed)
            sum_of_rates += Lanes(1.0 / smoothing_length) * lanes(*band_speed, cluster.first) *
                            lanes(density, cluster.first) * maximum(excess, 0.0);
        store_lanes(density_rate, cluster.first, mobility.moving_in(cluster), sum_of_rates);
    }
};

} // namespace cupel::inline CUPEL_ENGINE
