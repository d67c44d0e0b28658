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
    WendlandC2(double smoothing_length, int dimensions)
        : half_inverse_h_(0.5 / smoothing_length), support_(2.0 * smoothing_length),
          factor_(dimensions == 2
                      ? 7.0 / (4.0 * std::numbers::pi * smoothing_length * smoothing_length)
                      : 21.0 / (16.0 * std::numbers::pi * smoothing_length * smoothing_length * smoothing_length)),
          scale_(-std::cbrt(20.0 * factor_ * half_inverse_h_ * half_inverse_h_)),
          value_factor_(factor_ / (scale_ * scale_ * scale_ * scale_))
    {}

    double smoothing_length() const { return 0.5 * support_; }
    double support() const { return support_; }

    /// Of r² in m², above zero; zero beyond the support. (1 − q/2)₊ is scaled so that its cube is (1/r) dW/dr.
    template <class Scalar> KernelValue<Scalar> of_square(const Scalar& square) const
    {
        const Scalar r = root_of_positive(square);
        const Scalar t = minimum(scale_ - (scale_ * half_inverse_h_) * r, Scalar{});
        const Scalar t2 = t * t;
        return {(value_factor_ * t2) * (t2 * (1.0 + (4.0 * half_inverse_h_) * r)), t2 * t};
    }
    KernelValue<double> operator()(double r) const { return of_square(maximum(r * r, 1e-30 * support_ * support_)); }

private:
    double half_inverse_h_, support_, factor_, scale_, value_factor_;
};

} // namespace cupel
