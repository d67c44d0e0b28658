#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cupel
{

/// What a flat surface does to a kernel-smoothed colour, tabulated for the kernel in use:
///
///   w(s) = ∫ W over the plane at distance s      [1/m]
///   c̄(s) = ∫_{−∞}^{s} w                           [1], ½ on the surface itself
///
/// Its inverse turns the smoothed colour of a particle into its distance below the surface. Particles make a sum of
/// that integral, over rows Δx apart with the surface half a spacing beyond the last: a midpoint rule, which the
/// outermost row's kernel makes too great,
///
///   Σ_k w(s_k) Δx − c̄(s) = −(Δx²/24) w′(s) + …      (Euler and Maclaurin)
///
/// so that the outermost row, at ½ Δx, would look 0.545 Δx deep, which makes curvature 0.45 % too small at R = 10 Δx,
/// and a wave of 16 spacings 0.7 % slow. Beside one liquid in nothing it is added to c̄, as great as it is for the
/// outermost row; between two phases it has the other sign on the other side, and cancels where both take part.
class ColourProfile
{
public:
    /// `row_spacing`: Δx, m, of the rows that the sum consists of; 0 for the integral.
    template <class Kernel>
    ColourProfile(const Kernel& kernel, int dimensions, double row_spacing = 0.0)
        : support_(kernel.support()), step_(kernel.support() / static_cast<double>(intervals))
    {
        constexpr int integration_points = 2000;
        for (std::size_t k = 0; k <= intervals; ++k) {
            const double s = static_cast<double>(k) * step_;
            const double reach = std::sqrt(std::max(0.0, support_ * support_ - s * s));
            double integral = 0.0;
            for (int q = 0; q < integration_points; ++q) {
                const double rho = (q + 0.5) * reach / integration_points;
                const double measure = dimensions == 2 ? 2.0 : 2.0 * std::numbers::pi * rho;
                integral += measure * kernel(std::sqrt(s * s + rho * rho)).value;
            }
            plane_[k] = integral * reach / integration_points;
        }
        colour_[0] = 0.5;
        for (std::size_t k = 1; k <= intervals; ++k)
            colour_[k] = colour_[k - 1] + 0.5 * (plane_[k] + plane_[k - 1]) * step_;
        // The trapezoidal rule misses unity by about 10⁻⁷; the table ends at one exactly.
        for (double& value : colour_)
            value = 0.5 + (value - 0.5) * 0.5 / (colour_[intervals] - 0.5);
        if (row_spacing > 0.0) add_midpoint_rule(row_spacing);
        tangential_variance_ = variance_at(kernel, dimensions, 0.5 * row_spacing);
    }

    /// ⟨x²⟩ of the kernel along one tangent, at the depth of the outermost row, m². A surface that curves away by ½ κ
    /// x² takes from the smoothed colour what a flat one does that is nearer by ½ κ ⟨x²⟩, κ the sum of both curvatures.
    double tangential_variance() const { return tangential_variance_; }

    /// w(s), 1/m.
    double plane_weight(double s) const
    {
        const double position = std::abs(s) / step_;
        if (position >= static_cast<double>(intervals)) return 0.0;
        const auto k = static_cast<std::size_t>(position);
        const double part = position - static_cast<double>(k);
        return plane_[k] * (1.0 - part) + plane_[k + 1] * part;
    }

    /// Distance below the surface, m, positive where colour > ½; within ± the support.
    double depth(double colour) const
    {
        const bool outside = colour < 0.5;
        const double inside = outside ? 1.0 - colour : colour;
        if (inside >= colour_.back()) return outside ? -support_ : support_;
        const auto above = std::upper_bound(colour_.begin(), colour_.end(), inside);
        // What is no number stays none.
        const auto k = std::min(static_cast<std::size_t>(above - colour_.begin()), intervals) - 1;
        const double s = (static_cast<double>(k) + (inside - colour_[k]) / (colour_[k + 1] - colour_[k])) * step_;
        return outside ? -s : s;
    }

private:
    /// Adds the midpoint rule's excess: in proportion to −w′, as great as it is at half a spacing.
    void add_midpoint_rule(double row_spacing)
    {
        const auto slope = [&](double s) {
            return (plane_weight(s + step_) - plane_weight(s - step_)) / (2.0 * step_);
        };
        double rows = 0.0;
        for (double s = 0.0; s < support_; s += row_spacing)
            rows += plane_weight(s) * row_spacing;
        const double half = 0.5 * row_spacing, share = half / step_;
        const auto k = static_cast<std::size_t>(share);
        const double integral = colour_[k] + (share - static_cast<double>(k)) * (colour_[k + 1] - colour_[k]);
        const double excess = (rows - integral) / slope(half);
        for (std::size_t m = 1; m < intervals; ++m)
            colour_[m] += excess * slope(static_cast<double>(m) * step_);
    }

    template <class Kernel> double variance_at(const Kernel& kernel, int dimensions, double s) const
    {
        constexpr int integration_points = 2000;
        const double reach = std::sqrt(support_ * support_ - s * s);
        double weight = 0.0, moment = 0.0;
        for (int q = 0; q < integration_points; ++q) {
            const double rho = (q + 0.5) * reach / integration_points;
            const double part = (dimensions == 2 ? 1.0 : rho) * kernel(std::sqrt(s * s + rho * rho)).value;
            weight += part;
            moment += part * rho * rho / (dimensions - 1);
        }
        return moment / weight;
    }

    static constexpr std::size_t intervals = 400;
    double support_, step_, tangential_variance_ = 0.0;
    std::array<double, intervals + 1> plane_{}, colour_{};
};

} // namespace cupel
