#pragma once

#include <algorithm>
#include <cmath>

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
    void set(Index i, const Symmetric3<double>& m) const
    {
        xx[i] = m.xx;
        xy[i] = m.xy;
        xz[i] = m.xz;
        yy[i] = m.yy;
        yz[i] = m.yz;
        zz[i] = m.zz;
    }
};

/// Inverse of a symmetric matrix; the identity where its determinant is below 10⁻³ of a full neighbourhood's. In two
/// dimensions the y row is left out.
inline Symmetric3<double> safe_inverse(const Symmetric3<double>& m, int dimensions)
{
    constexpr double smallest = 1e-3;
    constexpr Symmetric3<double> identity{1.0, 0.0, 0.0, 1.0, 0.0, 1.0};
    if (dimensions == 2) {
        const double determinant = m.xx * m.zz - m.xz * m.xz;
        if (!(std::abs(determinant) > smallest)) return identity;
        return {m.zz / determinant, 0.0, -m.xz / determinant, 0.0, 0.0, m.xx / determinant};
    }
    const double c00 = m.yy * m.zz - m.yz * m.yz, c01 = m.xz * m.yz - m.xy * m.zz, c02 = m.xy * m.yz - m.xz * m.yy;
    const double determinant = m.xx * c00 + m.xy * c01 + m.xz * c02;
    if (!(std::abs(determinant) > smallest)) return identity;
    const double inverse = 1.0 / determinant;
    return {c00 * inverse,
            c01 * inverse,
            c02 * inverse,
            (m.xx * m.zz - m.xz * m.xz) * inverse,
            (m.xy * m.xz - m.xx * m.yz) * inverse,
            (m.xx * m.yy - m.xy * m.xy) * inverse};
}

/// L − 1, and less of it where neighbours are few: all of it where det L⁻¹ is above 0.15 (an edge of three faces has
/// 0.13, a plane surface 0.3), nothing below 0.05. In two dimensions the y row is zero.
inline Symmetric3<double> trusted_excess(const Symmetric3<double>& l)
{
    const bool flat = l.yy == 0.0;
    const double determinant = flat ? l.xx * l.zz - l.xz * l.xz
                                    : l.xx * (l.yy * l.zz - l.yz * l.yz) - l.xy * (l.xy * l.zz - l.yz * l.xz) +
                                          l.xz * (l.xy * l.yz - l.yy * l.xz);
    const double share = determinant > 0.0 ? std::clamp(10.0 / determinant - 0.5, 0.0, 1.0) : 0.0;
    return {share * (l.xx - 1.0), share * l.xy,        share * l.xz, flat ? 0.0 : share * (l.yy - 1.0),
            share * l.yz,         share * (l.zz - 1.0)};
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
    Near near(Index) const { return {}; }
    void add(const Near&, Index, const Pair& pair, Sum& sum) const
    {
        sum.moment.subtract_product(pair.volume_gradient, pair.offset);
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        const auto& m = sum.moment;
        for (int lane = 0; lane < cluster.count; ++lane)
            if (mobility.weight[cluster.first + lane] != 0.0)
                matrix.set(
                    cluster.first + lane,
                    safe_inverse({m.xx[lane], m.xy[lane], m.xz[lane], m.yy[lane], m.yz[lane], m.zz[lane]}, dimensions));
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
    Near near(Index first) const { return {lanes(value, first)}; }
    Far far(Index j) const { return {real(value[j])}; }
    void add(const Near& i, const Far& j, const Pair& pair, Sum& sum) const
    {
        sum.gradient += (j.value - i.value) * pair.volume_gradient;
    }
    void store(const Cluster& cluster, const Near&, const Sum& sum) const
    {
        store_if(raw_gradient, cluster, sum.gradient, [&](Index i) { return mobility.weight[i] != 0.0; });
    }
};

} // namespace cupel::inline CUPEL_ENGINE
