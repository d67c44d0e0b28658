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
    QuinticSpline(double smoothing_length, int dimensions) : support_(3.0 * smoothing_length)
    {
        const double h = smoothing_length;
        const double factor =
            dimensions == 2 ? 7.0 / (478.0 * std::numbers::pi * h * h) : 1.0 / (120.0 * std::numbers::pi * h * h * h);
        for (std::size_t n = 0; n < 3; ++n) {
            const double scale = std::pow(5.0 * factor / h * weights[n], 0.25);
            formula_.pieces[n] = {scale * static_cast<double>(3 - n), scale / h,
                                  factor * weights[n] / std::pow(scale, 5.0)};
        }
    }

    double smoothing_length() const { return support_ / 3.0; }
    double support() const { return support_; }

    /// Of r² in m², above zero; zero beyond the support. Each piece is scaled so that its fourth power is its part of
    /// dW/dr and needs no factor.
    template <class Number> struct Formula
    {
        /// (height − slope r)₊, and what its fifth power is multiplied by for W.
        struct Piece
        {
            Number height, slope, value;
        };
        std::array<Piece, 3> pieces{};

        template <class Scalar> KernelValue<Scalar> operator()(const Scalar& square) const
        {
            const Scalar inverse_r = reciprocal_root_of_positive(square);
            const Scalar r = square * inverse_r;
            const auto piece = [&](const Piece& p) { return maximum(p.height - p.slope * r, Scalar{}); };
            const Scalar a = piece(pieces[0]), b = piece(pieces[1]), c = piece(pieces[2]);
            const Scalar a4 = a * a * (a * a), b4 = b * b * (b * b), c4 = c * c * (c * c);
            return {a4 * (pieces[0].value * a) - b4 * (pieces[1].value * b) + c4 * (pieces[2].value * c),
                    (b4 - a4 - c4) * inverse_r};
        }
    };
    template <class Number> Formula<Number> in() const
    {
        Formula<Number> formula;
        for (std::size_t n = 0; n < 3; ++n) {
            const auto& piece = formula_.pieces[n];
            formula.pieces[n] = {Number(piece.height), Number(piece.slope), Number(piece.value)};
        }
        return formula;
    }
    KernelValue<double> operator()(double r) const { return formula_(maximum(r * r, 1e-30 * support_ * support_)); }

private:
    static constexpr std::array<double, 3> weights{1.0, 6.0, 15.0};

    double support_;
    Formula<double> formula_;
};

} // namespace cupel
