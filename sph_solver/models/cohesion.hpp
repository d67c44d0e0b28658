#pragma once

#include <algorithm>
#include <cmath>

#include "models/surface_forces.hpp"
#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Cohesion of liquid that particles do not resolve: threads, sheets and drops one or two particles thick. There a
/// colour gradient points nowhere, so that a continuum surface force is blind, and a drop of one spacing that melt
/// throws out at 2 m/s leaves although its Weber number ρu²Δx/σ is a quarter. A pair force (as Tartakovsky and Meakin
/// 2005 and Tartakovsky and Panchenko 2016 take for all surface tension) repels below the particle spacing and attracts
/// up to 3:
///
///   f_ij = w_ij s (1 − q)(3 − q)² (x_i − x_j)/r,   q = r/Δx < 3,   w_ij = max(w_i, w_j)      [N]
///
/// Its strength is not fitted: pulling a lattice apart along a plane takes the work 2σ an area,
///
///   s = 2σ Δx / Σ_(bonds across the plane, a site) (2u³/3 − u⁴/4),   u = 3 − q      (0.150 σ Δx in three dimensions)
///
/// w_i goes from 0, for what has the surroundings of a flat surface (23 of 33 companions) or of a right edge (16), to 1
/// for a sheet of one particle (13) and less. Solid metal attracts its melt and has the share w of its own surroundings
/// (CompanionsOfSolids): a grain, or spray that froze, is as thin as it looks. Walls do not attract.
struct Cohesion
{
    Mobility mobility;
    double spacing; ///< Δx, m
    double area;    ///< Δx, m; in two dimensions, where forces are by depth, 1
    double bonds;   ///< the sum above, 1
    SurfaceTensionLaw tension;
    const std::vector<Kind>& kind;
    const ScalarField* temperature; ///< null where it is the same everywhere
    const ScalarField& unresolved;  ///< w of all metal
    VectorField& force;             ///< N: added to

    struct Near
    {
        Lanes unresolved, strength;
    };
    struct Far
    {
        Real unresolved, strength; ///< strength ½ s/Δx, N/m; negative for walls, which take no part
    };
    struct Sum
    {
        VectorLanes force{};
    };

    double strength(Index i) const
    {
        return tension(temperature ? (*temperature)[i] : tension.reference_temperature) / bonds;
    }
    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const
    {
        std::array<Real, lane_count> s;
        for (int lane = 0; lane < lane_count; ++lane)
            s[static_cast<std::size_t>(lane)] = real(strength(first + lane));
        return {lanes(unresolved, first), Lanes(s)};
    }
    Far far(Index j) const
    {
        const bool wall = kind[static_cast<std::size_t>(j)] == Kind::wall;
        return {real(wall ? 0.0 : unresolved[j]), real(wall ? -1.0 : strength(j))};
    }
    bool ignores(const Far& j) const { return j.strength < 0; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        const Lanes inverse_distance = reciprocal_root_of_positive(pair.square);
        const Lanes q = (1.0 / spacing) * (pair.square * inverse_distance);
        const Lanes u = maximum(3.0 - q, 0.0);
        const Lanes weight = maximum(i.unresolved, Lanes(j.unresolved)) * (i.strength + j.strength);
        sum.force += (area * weight * (u - 2.0) * u * u * inverse_distance) * pair.offset;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] == 0.0) continue;
            force.set(i, force[i] + Vector{sum.force.x[lane], sum.force.y[lane], sum.force.z[lane]});
        }
    }

    /// Σ over bonds (a, b, c) of a lattice, c > 0, that cross a plane between two layers: c (2u³/3 − u⁴/4).
    static double bonds_across_a_plane(int dimensions)
    {
        double sum = 0.0;
        const int wide = dimensions == 2 ? 0 : 3;
        for (int a = -3; a <= 3; ++a)
            for (int b = -wide; b <= wide; ++b)
                for (int c = 1; c <= 3; ++c) {
                    const double u = std::max(0.0, 3.0 - std::sqrt(double(a * a + b * b + c * c)));
                    sum += c * (2.0 / 3.0 * u * u * u - 0.25 * u * u * u * u);
                }
        return sum;
    }

    static double share_unresolved(double companions, double full_companions)
    {
        const double of_33 = 33.0 * companions / full_companions;
        return std::clamp(0.25 * (17.0 - of_33), 0.0, 1.0);
    }
};

/// The share w of solids, which nothing else counts companions for.
struct CompanionsOfSolids
{
    Mobility mobility;
    double smoothing_length; ///< m
    double full_companions;
    const std::vector<Kind>& kind;
    ScalarField& unresolved; ///< w

    struct Near
    {};
    struct Sum
    {
        Lanes companions{};
    };

    bool idle(const Cluster& cluster) const { return mobility.all_in(cluster); }
    Near near(Index) const { return {}; }
    void add(const Near&, Index, const Pair& pair, Sum& sum) const
    {
        sum.companions += select(counted(pair, smoothing_length), 1.0, 0.0);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] != 0.0 || kind[static_cast<std::size_t>(i)] == Kind::wall) continue;
            unresolved[i] = Cohesion::share_unresolved(sum.companions[lane], full_companions);
        }
    }
};

} // namespace cupel::inline CUPEL_ENGINE
