#pragma once

#include <algorithm>
#include <cmath>

#include "models/shifting.hpp"
#include "models/velocity_gradient.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Transport velocity between two phases, which moves positions and not momentum, to where particles lie more evenly
/// (Adami, Hu, Adams 2013), scaled by the strain rate around as shifting at a free surface is by the local one
/// (shifting.hpp):
///
///   δu_i = −U_i h/V_i Σ_j (V_i² + V_j²) ∇W_ij,   U_i = min(20 s h γ̇, U_greatest),   |δu_i| ≤ ½ U_i      [m/s]
///   γ̇ = √(2 S̄:S̄),   S̄_i = Σ_j V_j W_ij S_j / Σ_j V_j W_ij over liquid,   S = ½(∇v + ∇vᵀ)      [1/s]
///
/// As published it comes from a background pressure of the size of ρ c₀², which moves what is at rest as well: the
/// arrangement that has no unevenness is none of equal volumes, which the equation of state asks for, and at rest
/// velocities v = −δu remain for ever (a static drop of La 120: spurious capillary number 4.8e-4, falling with that
/// pressure). With the local strain rate such velocities, which differ from one particle to the next, have a strain of
/// their own and keep themselves alive (5.3e-4 at s = 15; the mean, in which they cancel, 1.1e-4).
///
/// Of it, what would change volumes is taken away again: the equation of state would answer it with pressure, and the
/// liquid with velocities v = −δu, which nothing but viscosity brakes,
///
///   δu_i −= h²/V_i Σ_j (V_i² q_i + V_j² q_j) ∇W_ij,   q_i ← q_i − (dV_i/dt by δu)/V_i once a step      [1/s]
///
/// a projection whose two operators are adjoint to each other (density_summation.hpp has the other one); its relaxation
/// converges with less than 2.5 of it (of k²Ŵ² the greatest is 0.8/h²). Walls have q = 0. Own derivation.
///
/// Beside a wall the part of it along the wall's normal is left out, with w_i = Σ_j V_j ∇W_ij over the wall's
/// particles,
///
///   δu_i −= min(1, 5/2 h |w_i|) (δu_i·w_i) w_i/|w_i|²
///
/// Places cannot follow it there: the wall stands, and its particles, which no transport velocity has arranged, push
/// the first row off or pull it in for as long as anything strains. Where an interface meets the wall that kept two
/// phases at 120° stirring (2 cm/s at 10 s, base +3.8 %; now 1 mm/s, +0.7 %). The 5/2 is chosen: all of it in the first
/// row, some in the second. With 1, half of it in the first row, a drop of 60° goes on stirring (1 to 3 cm/s).
struct TransportVelocity
{
    Mobility mobility;
    double strength;         ///< s
    double smoothing_length; ///< h, m
    double greatest_speed;   ///< U_greatest, m/s
    const ScalarField& volume;
    VelocityGradientFields gradient;     ///< ∇v
    const ScalarField& volume_potential; ///< q, 1/s
    VectorField& transport_velocity;

    struct Near
    {
        Lanes volume, potential; ///< V, V² q
    };
    struct Far
    {
        Real liquid, volume, potential; ///< liquid: 1 or 0; V² q
        Real xx, xy, xz, yy, yz, zz;    ///< 2S_j where there is liquid

        Far mirrored(const Vector& sign) const
        {
            return {liquid,
                    volume,
                    potential,
                    xx,
                    real(sign.x * sign.y) * xy,
                    real(sign.x * sign.z) * xz,
                    yy,
                    real(sign.y * sign.z) * yz,
                    zz};
        }
    };
    struct Sum
    {
        VectorLanes unevenness{}, expansion{}, wall{};
        Lanes weight{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const
    {
        const Lanes v = lanes(volume, first);
        return {v, v * v * lanes(volume_potential, first)};
    }
    Far far(Index j) const
    {
        if (mobility.weight[j] == 0.0) return {0, real(volume[j]), 0, 0, 0, 0, 0, 0, 0};
        const Vector u = gradient.x[j], v = gradient.y[j], w = gradient.z[j];
        return {1,
                real(volume[j]),
                real(volume[j] * volume[j] * volume_potential[j]),
                real(2.0 * u.x),
                real(u.y + v.x),
                real(u.z + w.x),
                real(2.0 * v.y),
                real(v.z + w.y),
                real(2.0 * w.z)};
    }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.unevenness += ((i.volume * i.volume + j.volume * j.volume) * pair.gradient_over_r) * pair.offset;
        sum.expansion += ((i.potential + j.potential) * pair.gradient_over_r) * pair.offset;
        if (j.liquid == 0) {
            sum.wall += (j.volume * pair.gradient_over_r) * pair.offset;
            return;
        }
        const Lanes weight = pair.volume_kernel;
        sum.weight += weight;
        sum.xx += j.xx * weight;
        sum.xy += j.xy * weight;
        sum.xz += j.xz * weight;
        sum.yy += j.yy * weight;
        sum.yz += j.yz * weight;
        sum.zz += j.zz * weight;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        const Lanes squares = 0.5 * (sum.xx * sum.xx + sum.yy * sum.yy + sum.zz * sum.zz) + sum.xy * sum.xy +
                              sum.xz * sum.xz + sum.yz * sum.yz;
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index k = cluster.first + lane;
            if (mobility.weight[k] == 0.0) continue;
            const double strain_rate = std::sqrt(static_cast<double>(squares[lane])) / sum.weight[lane];
            const double speed = shifting_speed(strength, smoothing_length, strain_rate, greatest_speed);
            const auto of_lane = [&](const VectorLanes& v) { return Vector{v.x[lane], v.y[lane], v.z[lane]}; };
            Vector u = (-smoothing_length * speed / volume[k]) * of_lane(sum.unevenness);
            u -= (smoothing_length * smoothing_length / volume[k]) * of_lane(sum.expansion);
            u -= along_wall_normal(u, of_lane(sum.wall));
            if (const double size = norm(u), limit = 0.5 * speed; size > limit) u = (limit / size) * u;
            transport_velocity.set(k, u);
        }
    }

private:
    static constexpr double share_of_first_row = 2.5;

    /// What a wall's particles take from a transport velocity [m/s], given their Σ_j V_j ∇W_ij [1/m].
    Vector along_wall_normal(const Vector& u, const Vector& wall) const
    {
        const double size = norm(wall);
        if (size == 0.0) return {};
        const double share = std::min(1.0, share_of_first_row * smoothing_length * size);
        return (share * dot(u, wall) / (size * size)) * wall;
    }
};

} // namespace cupel::inline CUPEL_ENGINE
