#pragma once

#include <algorithm>
#include <cmath>

#include "models/term.hpp"
#include "models/velocity_gradient.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// b = max(0, 1 − 5 |m/m₀ − 1|): a particle that has lost or gained a fifth of its mass exchanges no more of it.
inline double exchange_balance(double mass, double lattice_mass)
{
    return std::clamp(1.0 - 5.0 * std::abs(mass / lattice_mass - 1.0), 0.0, 1.0);
}

/// Shifting velocity (Lind et al. 2012, with the pairing correction of Sun et al. 2017), scaled by the local strain:
///
///   δu_i = −U_i 2h Σ_j [1 + 0.2 (W_ij/W(Δx))⁴] V_j ∇W_ij,   U_i = min(20 s h γ̇_i, 0.1 c₀),   |δu_i| ≤ ½ U_i   [m/s]
///
/// The limit ½ U is the published one (Sun et al. 2019, eq. 10). The factor 20 is fitted: with it (s = 1) a closed
/// layer that turns over keeps its particles evenly spaced; a fifth of it leaves rows that are half again as dense
/// along the flow as across it. Particles are moved where the flow distorts their arrangement and in proportion to it,
/// nowhere else: a drop at rest is left alone, and one fast particle moves no other. In the surface band only the
/// tangential part is kept.
struct ShiftingVelocity
{
    Mobility mobility;
    double strength;          ///< s
    double smoothing_length;  ///< h, m
    double greatest_speed;    ///< 0.1 c₀, m/s
    double kernel_at_spacing; ///< W(Δx)
    double tangential_above;  ///< |∇c| above which only the tangential part is kept, 1/m
    const ScalarField& volume;
    VelocityGradientFields velocity_gradient; ///< whose strain scales the shift
    const ScalarField& mass;
    double lattice_mass; ///< of a particle at the start, kg
    const ScalarField& companions;
    double fewest_companions;           ///< with fewer, a particle is spray and is left alone
    const VectorField* colour_gradient; ///< out of the liquid, 1/m
    VectorField& shift;

    struct Near
    {};
    struct Far
    {
        Real volume;
    };
    struct Sum
    {
        VectorLanes concentration{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index) const { return {}; }
    Far far(Index j) const { return {real(volume[j])}; }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        const Lanes closeness = (1.0 / kernel_at_spacing) * pair.kernel;
        const Lanes square = closeness * closeness;
        sum.concentration += (j.volume * (1.0 + 0.2 * square * square) * pair.gradient_over_r) * pair.offset;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] == 0.0) continue;
            const double balance = companions[i] < fewest_companions ? 0.0 : exchange_balance(mass[i], lattice_mass);
            const double speed =
                balance *
                std::min(20.0 * strength * smoothing_length * velocity_gradient.strain_rate(i), greatest_speed);
            Vector u = (-2.0 * smoothing_length * speed) *
                       Vector{sum.concentration.x[lane], sum.concentration.y[lane], sum.concentration.z[lane]};
            const double limit = 0.5 * speed;
            const double magnitude = norm(u);
            if (magnitude > limit) u = (limit / magnitude) * u;
            const Vector gradient = (*colour_gradient)[i];
            const double slope = norm(gradient);
            if (slope > tangential_above) u -= (dot(u, gradient) / (slope * slope)) * gradient;
            shift.set(i, u);
        }
    }
};

/// The shifting velocity of walls and solids, such that nothing flows through them: δu_w = −Σ δu_f W / Σ W.
struct WallShift
{
    Mobility mobility;
    VectorField& shift;

    struct Near
    {};
    struct Far
    {
        Real liquid; ///< 1 or 0
        VectorOf<Real> shift;
    };
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

/// What a particle that moves with v + δu exchanges with its neighbours (arbitrary Lagrangian-Eulerian form, after
/// Sun, Colagrossi, Marrone, Zhang 2019 and Antuono et al. 2021; derived in models/README.md):
///
///   dm_i/dt   = Σ_j Φ_ij,                  Φ_ij = V_i V_j (ρ_j δu_j + ρ_i δu_i)·∇W_ij      [kg/s]
///   dρ_i/dt   = Σ_j Φ_ij/V_i − ρ_i Σ_j V_j (δu_j − δu_i)·∇W_ij                              [kg/(m³ s)]
///   m_i dv_i/dt += Σ_j V_i V_j ρ_j (δu_j·∇W_ij)(v_j − v_i)                                  [N]
///
/// Each pair's exchange is multiplied by min(b_i, b_j) (exchange_balance): no particle gains or loses more than a fifth
/// of its mass. Φ is antisymmetric, so mass is conserved to round-off between liquid particles; walls
/// exchange none.
struct ShiftingExchange
{
    Mobility mobility;
    const ScalarField& volume;
    const ScalarField& density;
    const VectorField& velocity;
    const VectorField& shift;
    const ScalarField& balance; ///< b, 1: falls to 0 as a particle's mass leaves its bounds
    ScalarField& density_rate;  ///< kg/(m³ s)
    ScalarField& mass_rate;     ///< kg/s
    VectorField& momentum_rate; ///< N

    struct Near
    {
        Lanes volume, density;
        VectorLanes velocity, shift;
        Lanes balance;
    };
    struct Far
    {
        Real volume, density, liquid, balance;
        VectorOf<Real> velocity, shift;
    };
    struct Sum
    {
        Lanes density{}, mass{};
        VectorLanes momentum{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const
    {
        return {lanes(volume, first), lanes(density, first), lanes(velocity, first), lanes(shift, first),
                lanes(balance, first)};
    }
    Far far(Index j) const
    {
        return {real(volume[j]),  real(density[j]),  real(mobility.weight[j]),
                real(balance[j]), real(velocity[j]), real(shift[j])};
    }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        const Lanes weight = j.volume * minimum(i.balance, Lanes(j.balance)) * pair.gradient_over_r;
        const Lanes own = weight * dot(i.shift, pair.offset);
        const Lanes other = weight * dot(broadcast(j.shift), pair.offset);
        const Lanes flux = j.density * other + i.density * own;
        sum.density += flux - i.density * (other - own);
        sum.mass += j.liquid * i.volume * flux;
        sum.momentum += (i.volume * j.density * other) * (broadcast(j.velocity) - i.velocity);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] == 0.0) continue;
            density_rate[i] = sum.density[lane];
            mass_rate[i] = sum.mass[lane];
            momentum_rate.set(i, {sum.momentum.x[lane], sum.momentum.y[lane], sum.momentum.z[lane]});
        }
    }
};

} // namespace cupel::inline CUPEL_ENGINE
