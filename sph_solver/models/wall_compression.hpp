#pragma once

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// How much liquid a wall particle feels, in number:
///
///   n_w = Σ_j W_wj over liquid      [1/m³],       dn_w/dt = −Σ_j δu_j·∇W_wj by the transport velocity alone [1/(m³ s)]
///
/// Where two phases fill the space, a wall is compressed as they are: its volume is V_w = 1/(N + n_w − n_w⁰), N the Σ W
/// of a lattice, n_w⁰ what the lattice of the start has there, and its pressure that of this volume. Pressure between a
/// wall and what is before it is then the gradient of an elastic energy as well, and a wall takes and gives back, but
/// never feeds. A pressure extrapolated from the liquid (Adami, Hu, Adams 2012) has no such energy: air of a thousandth
/// of a drop's density before such walls swung itself up until it was faster than sound.
struct WallCompression
{
    Mobility mobility;
    const VectorField& transport;  ///< δu, m/s
    ScalarField& liquid_number;    ///< n_w
    ScalarField& transport_number; ///< its rate

    struct Near
    {};
    struct Far
    {
        Real liquid; ///< 1 or 0
        VectorOf<Real> transport;
    };
    struct Sum
    {
        Lanes number{}, rate{};
    };

    bool idle(const Cluster& cluster) const { return mobility.all_in(cluster); }
    Near near(Index) const { return {}; }
    Far far(Index j) const { return {real(mobility.weight[j]), real(transport[j])}; }
    bool ignores(const Far& j) const { return j.liquid == 0; }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.number += pair.kernel;
        sum.rate -= pair.gradient_over_r * dot(broadcast(j.transport), pair.offset);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        const unsigned wall = cluster.lanes() & ~mobility.moving_in(cluster);
        store_lanes(liquid_number, cluster.first, wall, sum.number);
        store_lanes(transport_number, cluster.first, wall, sum.rate);
    }
};

} // namespace cupel::inline CUPEL_ENGINE
