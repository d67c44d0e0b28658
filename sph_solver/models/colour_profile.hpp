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
/// Its inverse turns the smoothed colour of a particle into its distance below the surface.
class ColourProfile
{
public:
    template <class Kernel>
    ColourProfile(const Kernel& kernel, int dimensions)
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
    }

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
    static constexpr std::size_t intervals = 400;
    double support_, step_;
    std::array<double, intervals + 1> plane_{}, colour_{};
};

} // namespace cupel
