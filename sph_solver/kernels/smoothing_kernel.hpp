#pragma once

#include <numbers>

#include "math/vector.hpp"

namespace cupel
{

/// Value and radial derivative of a smoothing kernel at one distance.
template <class Scalar> struct KernelValue
{
    Scalar value;           ///< W(r), 1/m³ (1/m² in two dimensions)
    Scalar gradient_over_r; ///< (1/r) dW/dr: ∇W = gradient_over_r · (x_i − x_j)
};

/// Quintic spline (Morris, Fox, Zhu 1997), support 3 h:
///
///   W(q) = a [(3−q)₊⁵ − 6 (2−q)₊⁵ + 15 (1−q)₊⁵],   q = r/h,   a = 7/(478 π h²) in 2-D, 1/(120 π h³) in 3-D.
///
/// With h equal to the particle spacing its gradients on a lattice err by 0.1 %.
class QuinticSpline
{
public:
    QuinticSpline(double smoothing_length, int dimensions)
        : inverse_h_(1.0 / smoothing_length), support_(3.0 * smoothing_length),
          factor_(dimensions == 2
                      ? 7.0 / (478.0 * std::numbers::pi * smoothing_length * smoothing_length)
                      : 1.0 / (120.0 * std::numbers::pi * smoothing_length * smoothing_length * smoothing_length))
    {}

    double smoothing_length() const { return 1.0 / inverse_h_; }
    double support() const { return support_; }

    /// Distance r in m and its reciprocal; zero beyond the support.
    template <class Scalar> KernelValue<Scalar> operator()(const Scalar& r, const Scalar& inverse_r) const
    {
        const Scalar zero{};
        const Scalar q = r * inverse_h_;
        const Scalar a = maximum(3.0 - q, zero), b = maximum(2.0 - q, zero), c = maximum(1.0 - q, zero);
        const Scalar a4 = a * a * (a * a), b4 = b * b * (b * b), c4 = c * c * (c * c);
        const Scalar slope = -5.0 * (a4 - 6.0 * b4 + 15.0 * c4);
        return {factor_ * (a4 * a - 6.0 * (b4 * b) + 15.0 * (c4 * c)), factor_ * inverse_h_ * slope * inverse_r};
    }
    KernelValue<double> operator()(double r) const { return (*this)(r, 1.0 / r); }

private:
    double inverse_h_, support_, factor_;
};

} // namespace cupel
