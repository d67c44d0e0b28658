#pragma once

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Artificial heat against the over-heating of compressed material (Noh 1987, Monaghan 1992; the paper, section 2.3.3):
///
///   P_i = 2 Σ_j V_i V_j q̄_ij (e_i − e_j) (1/r) dW/dr      [W]
///   q_i = ρ_i h² |∇·v|_i (α + β h |∇·v|_i / c₀)            [kg/(m·s)],   e_i − e_j = c̄_ij (T_i − T_j)   [J/kg]
///
/// The paper prints q = α h ρ c₀ |∇·v| + β h² ρ |∇·v|², whose products with e/r² are W/(m³·s): a time is missing. The
/// one that belongs to h and c₀, h/c₀, gives the q above. Taken from temperatures, so that it vanishes where they
/// are equal, melting or not; antisymmetric in pairs, so that it moves heat and makes none.
struct ArtificialHeat
{
    const ScalarField& volume;
    const ScalarField& temperature;
    const ScalarField& diffusivity; ///< q c, W/(m·K), from artificial_conductivity
    ScalarField& power;             ///< P, W: added to

    struct Near
    {
        Lanes volume, temperature, diffusivity;
    };
    struct Sum
    {
        Lanes power{};
    };

    bool idle(const Cluster& cluster) const
    {
        return none_in(cluster, [&](Index i) { return diffusivity[i] >= 0.0; });
    }
    Near near(Index first) const
    {
        return {lanes(volume, first), lanes(temperature, first), lanes(diffusivity, first)};
    }
    void add(const Near& i, Index j, const Pair& pair, Sum& sum) const
    {
        const double diffusivity_j = diffusivity[j];
        if (diffusivity_j < 0.0) return;
        sum.power +=
            volume[j] * (i.diffusivity + diffusivity_j) * (i.temperature - temperature[j]) * pair.gradient_over_r;
    }
    void store(const Cluster& cluster, const Near& i, const Sum& sum) const
    {
        const Lanes power_added = i.volume * sum.power;
        for (int lane = 0; lane < cluster.count; ++lane)
            if (diffusivity[cluster.first + lane] >= 0.0) power[cluster.first + lane] += power_added[lane];
    }
};

/// q c of one particle, W/(m·K): divergence in 1/s, smoothing length h in m, specific heat c in J/(kg·K).
struct ArtificialConductivity
{
    double alpha, beta;
    double smoothing_length;
    double sound_speed; ///< c₀, m/s; used where beta > 0

    double operator()(double divergence, double density, double specific_heat) const
    {
        const double rate = divergence < 0.0 ? -divergence : divergence;
        const double second = beta > 0.0 ? beta * smoothing_length * rate / sound_speed : 0.0;
        return density * smoothing_length * smoothing_length * rate * (alpha + second) * specific_heat;
    }
};

/// ∇·v_i = −Σ_j V_j (v_i − v_j)·∇W_ij over particles that carry heat      [1/s]
struct VelocityDivergence
{
    const ScalarField& volume;
    const ScalarField& conductivity;
    const VectorField& velocity;
    ScalarField& divergence;

    struct Near
    {
        VectorLanes velocity;
    };
    struct Far
    {
        Real volume; ///< 0 for what carries no heat
        VectorOf<Real> velocity;
    };
    struct Sum
    {
        Lanes divergence{};
    };

    bool idle(const Cluster&) const { return false; }
    Near near(Index first) const { return {lanes(velocity, first)}; }
    Far far(Index j) const { return {real(conductivity[j] > 0.0 ? volume[j] : 0.0), real(velocity[j])}; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.divergence -= (j.volume * pair.gradient_over_r) * dot(i.velocity - broadcast(j.velocity), pair.offset);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        store_lanes(divergence, cluster.first, cluster.lanes(), sum.divergence);
    }
};

} // namespace cupel::inline CUPEL_ENGINE
