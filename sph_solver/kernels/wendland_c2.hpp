#pragma once

#include <cmath>
#include <numbers>

#include "kernels/kernel_value.hpp"
#include "math/vector.hpp"

namespace cupel
{

/// Wendland's C2 kernel (Wendland 1995), support 2 h:
///
///   W(q) = a (1 − q/2)₊⁴ (1 + 2q),   q = r/h,   a = 7/(4π h²) in 2-D, 21/(16π h³) in 3-D.
///
/// It never pairs particles and is the cheapest of the usual kernels; its gradients on a lattice err by 2 % at h = 1.3
/// Δx and by 0.06 % at 1.5 Δx.
class WendlandC2
{
public:
    WendlandC2(double smoothing_length, int dimensions) : support_(2.0 * smoothing_length)
    {
        const double h = smoothing_length, slope = 1.0 / support_;
        const double factor =
            dimensions == 2 ? 7.0 / (4.0 * std::numbers::pi * h * h) : 21.0 / (16.0 * std::numbers::pi * h * h * h);
        const double scale = -std::cbrt(20.0 * factor * slope * slope);
        formula_ = {scale, scale * slope, factor / (scale * scale * scale * scale), 4.0 * slope};
    }

    double smoothing_length() const { return 0.5 * support_; }
    double support() const { return support_; }

    /// Of r² in m², above zero; zero beyond the support. (1 − q/2)₊ is scaled so that its cube is (1/r) dW/dr.
    template <class Number> struct Formula
    {
        Number scale, slope, value, twice_inverse_h;

        template <class Scalar> KernelValue<Scalar> operator()(const Scalar& square) const
        {
            const Scalar r = root_of_positive(square);
            const Scalar t = minimum(scale - slope * r, Scalar{});
            const Scalar t2 = t * t;
            return {(value * t2) * (t2 * (Number(1) + twice_inverse_h * r)), t2 * t};
        }
    };
    template <class Number> Formula<Number> in() const
    {
        const auto& f = formula_;
        return {Number(f.scale), Number(f.slope), Number(f.value), Number(f.twice_inverse_h)};
    }
    KernelValue<double> operator()(double r) const { return formula_(maximum(r * r, 1e-30 * support_ * support_)); }

private:
    double support_;
    Formula<double> formula_;
};

} // namespace cupel
