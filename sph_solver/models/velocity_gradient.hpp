#pragma once

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
    struct OfCluster
    {
        VectorLanes x, y, z;
    };
    OfCluster of_cluster(Index first) const { return {lanes(x, first), lanes(y, first), lanes(z, first)}; }
    void reset(Index i) const
    {
        for (VectorField* row : {&x, &y, &z})
            row->set(i, {});
    }

    double trace(Index i) const { return x[i].x + y[i].y + z[i].z; }
    /// Magnitude of the strain rate, γ̇ = √(2 S:S), S = ½(∇v + ∇vᵀ)      [1/s]
    double strain_rate(Index i) const { return strain_rate(x[i], y[i], z[i]); }
    Lanes strain_rates(Index first) const
    {
        const auto [u, v, w] = of_cluster(first);
        return strain_rate(u, v, w);
    }
    template <class Scalar>
    static Scalar strain_rate(const VectorOf<Scalar>& u, const VectorOf<Scalar>& v, const VectorOf<Scalar>& w)
    {
        const Scalar xy = u.y + v.x, xz = u.z + w.x, yz = v.z + w.y;
        return square_root(Scalar(2.0) * (u.x * u.x + v.y * v.y + w.z * w.z) + xy * xy + xz * xz + yz * yz);
    }
};

inline void prefetch(const VelocityGradientFields& gradient, Index first)
{
    prefetch_all(first, gradient.x, gradient.y, gradient.z);
}

/// Gradient of velocity, exact for a velocity that is linear in space:
///
///   ∇v_i = Σ_j V_j (v_j − v_i) ⊗ L_i ∇W_ij      [1/s]
struct VelocityGradient
{
    Mobility mobility;
    const VectorField& velocity;
    CorrectionMatrix correction;
    VelocityGradientFields gradient;
    /// The trace of the sum without L is that of continuity.hpp: where this is not null, its rate, kg/(m³ s).
    ScalarField* density_rate = nullptr;
    const ScalarField* density = nullptr; ///< only asked there

    using Near = Of<Lanes, quantity::Velocity>;
    using Far = Of<Real, quantity::Velocity>;
    struct Sum
    {
        VectorLanes x{}, y{}, z{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    void ahead(Index first) const { prefetch_all(first, velocity, gradient); }
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
        const unsigned liquid = mobility.moving_in(cluster);
        const Symmetric3<Lanes> l = correction.of_cluster(cluster.first);
        store_lanes(gradient.x, cluster.first, liquid, l * sum.x);
        store_lanes(gradient.y, cluster.first, liquid, l * sum.y);
        store_lanes(gradient.z, cluster.first, liquid, l * sum.z);
        if (density_rate)
            store_lanes(*density_rate, cluster.first, liquid,
                        -lanes(*density, cluster.first) * (sum.x.x + sum.y.y + sum.z.z));
    }
};

} // namespace cupel::inline CUPEL_ENGINE
