#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "kernels/kernel_value.hpp"
#include "math/vector.hpp"

namespace cupel
{

/// Quintic spline (Morris, Fox, Zhu 1997), support 3 h:
///
///   W(q) = a [(3−q)₊⁵ − 6 (2−q)₊⁵ + 15 (1−q)₊⁵],   q = r/h,   a = 7/(478 π h²) in 2-D, 1/(120 π h³) in 3-D.
///
/// With h equal to the particle spacing its gradients on a lattice err by 0.1 %.
class QuinticSpline
{
public:
    QuinticSpline(double smoothing_length, int dimensions)
        : inverse_h_(1.0 / smoothing_length), support_(3.0 * smoothing_length)
    {
        const double h = smoothing_length;
        const double factor =
            dimensions == 2 ? 7.0 / (478.0 * std::numbers::pi * h * h) : 1.0 / (120.0 * std::numbers::pi * h * h * h);
        for (std::size_t n = 0; n < 3; ++n) {
            const double scale = std::pow(5.0 * factor / h * weights[n], 0.25);
            pieces_[n] = {scale * static_cast<double>(3 - n), scale / h, factor * weights[n] / std::pow(scale, 5.0)};
        }
    }

    double smoothing_length() const { return 1.0 / inverse_h_; }
    double support() const { return support_; }

    /// Of r² in m², above zero; zero beyond the support. Each piece is scaled so that its fourth power is its part of
    /// dW/dr and needs no factor.
    template <class Scalar> KernelValue<Scalar> of_square(const Scalar& square) const
    {
        const Scalar inverse_r = reciprocal_root_of_positive(square);
        const Scalar r = square * inverse_r;
        const auto piece = [&](const Piece& p) { return maximum(p.height - p.slope * r, Scalar{}); };
        const Scalar a = piece(pieces_[0]), b = piece(pieces_[1]), c = piece(pieces_[2]);
        const Scalar a4 = a * a * (a * a), b4 = b * b * (b * b), c4 = c * c * (c * c);
        return {a4 * (pieces_[0].value * a) - b4 * (pieces_[1].value * b) + c4 * (pieces_[2].value * c),
                (b4 - a4 - c4) * inverse_r};
    }
    KernelValue<double> operator()(double r) const { return of_square(maximum(r * r, 1e-30 * support_ * support_)); }

private:
    /// (height − slope r)₊, and what its fifth power is multiplied by for W.
    struct Piece
    {
        double height, slope, value;
    };
    static constexpr std::array<double, 3> weights{1.0, 6.0, 15.0};

    double inverse_h_, support_;
    std::array<Piece, 3> pieces_{};
};

} // namespace cupel
