#pragma once

#include <algorithm>

#include "models/gradient_correction.hpp"
#include "models/surface_geometry.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// The pressure that the load L = σκ + p_r of an interface puts two phases under, with its jump on the interface
/// itself:
///
///   ∇·(∇λ/ρ) = 0 in each phase,   λ_1 − λ_2 = L and (∂λ_1/∂n)/ρ_1 = (∂λ_2/∂n)/ρ_2 on the interface,   ∂λ/∂n = 0 on
///   walls
///
/// Pressure is p = λ + p', and the equation of state has p' alone:   ρ Dv/Dt = −∇p' − ∇λ + …,   p' without a jump. It
/// is what surface_pressure.hpp is for a free surface: where the load is everywhere the same nothing is left to be
/// balanced, however particles lie, and no band of finite width bears a force of the size of L/Δx. For a pair the jump
/// is taken out where it crosses the interface,
///
///   d_ij = λ_j − λ_i + (c_i − c_j) L_ij,   L_ij = (δ_i L_i + δ_j L_j)/(δ_i + δ_j),   c = 1 in the primary phase, else
///   0
///
/// which leaves a function that bends but does not jump, as the ghost fluid method has it on a grid (Kang, Fedkiw, Liu
/// 2000). Densities in series between two particles: 1/ρ → 2/(ρ_i + ρ_j), so that what the phases have of normal
/// acceleration is the same on both sides and p' has nothing to make good:
///
///   λ_i ← λ_i + Σ_j V_j w_ij d_ij 2/(ρ_i + ρ_j) / Σ_j V_j w_ij 2/(ρ_i + ρ_j),   w = −(1/r) dW/dr
///   (∇λ/ρ)_i = C_i Σ_j V_j d_ij 2/(ρ_i + ρ_j) ∇W_ij,   C the matrix of gradient_correction.hpp      [m/s²]
///
/// The first is done once a step. A wall has for each phase the mean of what it sees of it (WallInterfacePressure).
/// Own derivation.
struct InterfacePressure
{
    Mobility mobility;
    const ScalarField& volume;
    const ScalarField& density;
    const ScalarField& colour; ///< c
    const ScalarField& delta;
    const ScalarField& load;           ///< L, Pa
    const ScalarField& value;          ///< λ; on walls that of the primary phase, Pa
    const ScalarField& value_of_other; ///< on walls: λ of the other phase, Pa
    CorrectionMatrix correction;
    ScalarField& mean;         ///< λ of the next sweep, Pa
    VectorField& acceleration; ///< −∇λ/ρ, m/s²

    struct Near
    {
        Lanes colour, density, value, delta, weighted_load;
    };
    struct Far
    {
        Real liquid, colour, density, value, value_of_other, volume, delta, weighted_load; ///< liquid: 1 or 0
    };
    struct Sum
    {
        Lanes weight{}, change{};
        VectorLanes gradient{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const
    {
        const Lanes delta_i = lanes(delta, first);
        return {lanes(colour, first), lanes(density, first), lanes(value, first), delta_i,
                delta_i * lanes(load, first)};
    }
    Far far(Index j) const
    {
        return {real(mobility.weight[j]), real(colour[j]), real(density[j]), real(value[j]),
                real(value_of_other[j]),  real(volume[j]), real(delta[j]),   real(delta[j] * load[j])};
    }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        Lanes change, lightness;
        if (j.liquid != 0) {
            const Lanes jump = (i.weighted_load + j.weighted_load) / (i.delta + j.delta + Lanes(1e-30));
            change = j.value - i.value + (i.colour - j.colour) * jump;
            lightness = 2.0 / (i.density + j.density);
        }
        else {
            change = j.value_of_other + i.colour * (j.value - j.value_of_other) - i.value;
            lightness = 1.0 / i.density;
        }
        const Lanes weight = (j.volume * pair.gradient_over_r) * lightness;
        sum.weight += weight;
        sum.change += weight * change;
        sum.gradient += (weight * change) * pair.offset;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] == 0.0) continue;
            mean[i] = value[i] + (sum.weight[lane] < 0.0 ? sum.change[lane] / sum.weight[lane] : 0.0);
            const Vector gradient{sum.gradient.x[lane], sum.gradient.y[lane], sum.gradient.z[lane]};
            acceleration.set(i, -1.0 * (correction[i] * gradient));
        }
    }
};

/// λ that a wall has for the phase on either side of an interface: the mean of what it sees of it,
///
///   λ_w = Σ λ_f W / Σ W over one phase      [Pa]
struct WallInterfacePressure
{
    Mobility mobility;
    const ScalarField& colour;
    ScalarField& value; ///< read in liquid; on walls that of the primary phase
    ScalarField& value_of_other;

    struct Near
    {};
    struct Far
    {
        Real liquid, colour, value; ///< liquid, colour: 1 or 0
    };
    struct Sum
    {
        Lanes weight{}, value{}, weight_of_other{}, value_of_other{};
    };

    bool idle(const Cluster& cluster) const { return mobility.all_in(cluster); }
    Near near(Index) const { return {}; }
    Far far(Index j) const { return {real(mobility.weight[j]), real(colour[j]), real(value[j])}; }
    bool ignores(const Far& j) const { return j.liquid == 0; }
    void add(const Near&, const Far& j, const Pair& pair, Sum& sum) const
    {
        (j.colour != 0 ? sum.weight : sum.weight_of_other) += pair.kernel;
        (j.colour != 0 ? sum.value : sum.value_of_other) += j.value * pair.kernel;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] != 0.0) continue;
            value[i] = sum.weight[lane] > 0.0 ? sum.value[lane] / sum.weight[lane] : 0.0;
            value_of_other[i] =
                sum.weight_of_other[lane] > 0.0 ? sum.value_of_other[lane] / sum.weight_of_other[lane] : 0.0;
        }
    }
};

} // namespace cupel::inline CUPEL_ENGINE
