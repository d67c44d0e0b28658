#pragma once

#include <cmath>

#include "models/gradient_correction.hpp"
#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Gradients of the three components of velocity, ∇v_x, ∇v_y and ∇v_z      [1/s]
struct VelocityGradientFields
{
    VectorField &x, &y, &z;

    static VelocityGradientFields register_in(Particles& particles)
    {
        const auto field = [&](const char* name) -> VectorField& { return particles.add_vector({name, "1/s"}); };
        return {field("velocity_gradient_x"), field("velocity_gradient_y"), field("velocity_gradient_z")};
    }
    void reset(Index i) const
    {
        for (VectorField* row : {&x, &y, &z})
            row->set(i, {});
    }

    /// Magnitude of the strain rate, γ̇ = √(2 S:S), S = ½(∇v + ∇vᵀ)      [1/s]
    double strain_rate(Index i) const
    {
        const Vector u = x[i], v = y[i], w = z[i];
        const double xy = u.y + v.x, xz = u.z + w.x, yz = v.z + w.y;
        return std::sqrt(2.0 * (u.x * u.x + v.y * v.y + w.z * w.z) + xy * xy + xz * xz + yz * yz);
    }
};

/// Gradient of velocity, exact for a velocity that is linear in space:
///
///   ∇v_i = Σ_j V_j (v_j − v_i) ⊗ L_i ∇W_ij      [1/s]
struct VelocityGradient
{
    Mobility mobility;
    const VectorField& velocity;
    CorrectionMatrix correction;
    VelocityGradientFields gradient;

    using Near = Of<Lanes, quantity::Velocity>;
    using Far = Of<Real, quantity::Velocity>;
    struct Sum
    {
        VectorLanes x{}, y{}, z{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    Near near(Index first) const { return {lanes(velocity, first)}; }
    Far far(Index j) const { return {real(velocity[j])}; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        const VectorLanes change = i.velocity - broadcast(j.velocity);
        sum.x -= change.x * pair.volume_gradient;
        sum.y -= change.y * pair.volume_gradient;
        sum.z -= change.z * pair.volume_gradient;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        for (int lane = 0; lane < cluster.count; ++lane) {
            const Index i = cluster.first + lane;
            if (mobility.weight[i] == 0.0) continue;
            const auto row = [&](const VectorLanes& g) {
                return correction[i] * Vector{g.x[lane], g.y[lane], g.z[lane]};
            };
            gradient.x.set(i, row(sum.x));
            gradient.y.set(i, row(sum.y));
            gradient.z.set(i, row(sum.z));
        }
    }
};

} // namespace cupel::inline CUPEL_ENGINE
