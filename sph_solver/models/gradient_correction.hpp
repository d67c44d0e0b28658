#pragma once

#include "models/term.hpp"

namespace cupel::inline CUPEL_ENGINE
{

/// Matrix that makes gradients exact for linear fields, whatever the arrangement of neighbours (Randles & Libersky
/// 1996):
///
///   L_i = [Σ_j V_j (x_j − x_i) ⊗ ∇W_ij]⁻¹,    ⟨∇f⟩_i = L_i Σ_j V_j (f_j − f_i) ∇W_ij
///
/// Where neighbours are too few or lie in one plane the inverse does not exist and L is the identity: no correction.
struct CorrectionMatrix
{
    ScalarField &xx, &xy, &xz, &yy, &yz, &zz;

    static CorrectionMatrix register_in(Particles& particles)
    {
        const auto field = [&](const char* name) -> ScalarField& { return particles.add_scalar({name, "1"}); };
        return {field("correction_xx"), field("correction_xy"), field("correction_xz"),
                field("correction_yy"), field("correction_yz"), field("correction_zz")};
    }
    Symmetric3<double> operator[](Index i) const { return {xx[i], xy[i], xz[i], yy[i], yz[i], zz[i]}; }
    Symmetric3<Lanes> of_cluster(Index first) const
    {
        return {lanes(xx, first), lanes(xy, first), lanes(xz, first),
                lanes(yy, first), lanes(yz, first), lanes(zz, first)};
    }
    void store(Index first, unsigned which, const Symmetric3<Lanes>& m) const
    {
        store_lanes(xx, first, which, m.xx);
        store_lanes(xy, first, which, m.xy);
        store_lanes(xz, first, which, m.xz);
        store_lanes(yy, first, which, m.yy);
        store_lanes(yz, first, which, m.yz);
        store_lanes(zz, first, which, m.zz);
    }
};

inline void prefetch(const CorrectionMatrix& l, Index first)
{
    prefetch_all(first, l.xx, l.xy, l.xz, l.yy, l.yz, l.zz);
}

/// Inverse of a symmetric matrix; the identity where its determinant is below 10⁻³ of a full neighbourhood's. In two
/// dimensions the y row is left out.
template <class Scalar> Symmetric3<Scalar> safe_inverse(const Symmetric3<Scalar>& m, int dimensions)
{
    constexpr double smallest = 1e-3;
    const Scalar zero(0.0), one(1.0);
    const auto inverse = [&](const Scalar& determinant, const Symmetric3<Scalar>& adjugate) {
        const auto exists = determinant * determinant > Scalar(smallest * smallest);
        const Scalar scale = one / determinant;
        const auto diagonal = [&](const Scalar& a) { return select(exists, scale * a, one); };
        const auto other = [&](const Scalar& a) { return select(exists, scale * a, zero); };
        const auto& a = adjugate;
        return Symmetric3<Scalar>{diagonal(a.xx), other(a.xy), other(a.xz),
                                  diagonal(a.yy), other(a.yz), diagonal(a.zz)};
    };
    if (dimensions == 2) {
        auto flat = inverse(m.xx * m.zz - m.xz * m.xz, {m.zz, zero, zero - m.xz, zero, zero, m.xx});
        flat.yy = zero;
        return flat;
    }
    const Symmetric3<Scalar> adjugate{m.yy * m.zz - m.yz * m.yz, m.xz * m.yz - m.xy * m.zz, m.xy * m.yz - m.xz * m.yy,
                                      m.xx * m.zz - m.xz * m.xz, m.xy * m.xz - m.xx * m.yz, m.xx * m.yy - m.xy * m.xy};
    return inverse(m.xx * adjugate.xx + m.xy * adjugate.xy + m.xz * adjugate.xz, adjugate);
}

/// L − 1, and less of it where neighbours are few: all of it where det L⁻¹ is above 0.15 (an edge of three faces has
/// 0.13, a plane surface 0.3), nothing below 0.05. In two dimensions the y row is zero.
template <class Scalar> Symmetric3<Scalar> trusted_excess(const Symmetric3<Scalar>& l)
{
    const Scalar zero(0.0), one(1.0);
    const auto deep = l.yy * l.yy > zero;
    const Scalar determinant = select(deep,
                                      l.xx * (l.yy * l.zz - l.yz * l.yz) - l.xy * (l.xy * l.zz - l.yz * l.xz) +
                                          l.xz * (l.xy * l.yz - l.yy * l.xz),
                                      l.xx * l.zz - l.xz * l.xz);
    const Scalar share = select(determinant > zero, clamp(Scalar(10.0) / determinant - Scalar(0.5), 0.0, 1.0), zero);
    return {share * (l.xx - one), share * l.xy,        share * l.xz, select(deep, share * (l.yy - one), zero),
            share * l.yz,         share * (l.zz - one)};
}

struct GradientCorrection
{
    Mobility mobility;
    int dimensions;
    CorrectionMatrix matrix;

    struct Near
    {};
    struct Sum
    {
        Symmetric3<Lanes> moment{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    void ahead(Index first) const { prefetch_all(first, mobility.weight, matrix); }
    Near near(Index) const { return {}; }
    Nothing far(Index) const { return {}; }
    void add(const Near&, Nothing, const Pair& pair, Sum& sum) const
    {
        sum.moment.subtract_product(pair.volume_gradient, pair.offset);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        matrix.store(cluster.first, mobility.moving_in(cluster), safe_inverse(sum.moment, dimensions));
    }
};

/// Corrected gradient of a scalar field over liquid, walls and solids alike:
///
///   ⟨∇f⟩_i = L_i Σ_j V_j (f_j − f_i) ∇W_ij
///
/// The sum is stored raw; the caller multiplies by L_i, which the same pass may only just have summed.
struct ScalarGradient
{
    Mobility mobility;
    const ScalarField& value;
    VectorField& raw_gradient;

    struct Near
    {
        Lanes value;
    };
    struct Far
    {
        Real value;
    };
    struct Sum
    {
        VectorLanes gradient{};
    };

    bool idle(const Cluster& cluster) const { return mobility.none_in(cluster); }
    void ahead(Index first) const { prefetch_all(first, value, raw_gradient); }
    Near near(Index first) const { return {lanes(value, first)}; }
    Far far(Index j) const { return {real(value[j])}; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.gradient += (j.value - i.value) * pair.volume_gradient;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        store_lanes(raw_gradient, cluster.first, mobility.moving_in(cluster), sum.gradient);
    }
};

} // namespace cupel::inline CUPEL_ENGINE
