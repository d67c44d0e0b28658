#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace cupel
{

/// What the layers of a lattice behind a flat wall add to kernel sums of a particle at distance d before it:
///
///   c(d) = Σ_j V W_ij           [1],       S(d) = −dc/dd = |Σ_j V ∇W_ij|      [1/m]
///   B(d) = −Σ_j V (1/r dW/dr) s_j²         [1],    s the part of r across the wall; along it the moment is c(d)
///
/// with the layers at depths (k + ½)Δx and each of them integrated over its plane, which for a smooth kernel equals the
/// sum over its lattice. Heat sees its walls this way: no wall particle is needed, and where there are some the sums
/// are theirs.
class WallLayers
{
public:
    template <class Kernel>
    WallLayers(const Kernel& kernel, double spacing, int dimensions) : step_(kernel.support() / intervals)
    {
        for (std::size_t k = 0; k <= intervals; ++k)
            for (double s = step_ * static_cast<double>(k) + 0.5 * spacing; s < kernel.support(); s += spacing)
                add_plane(kernel, spacing, dimensions, s, share_[k], slope_[k], moment_[k]);
    }

    /// c(d), 1.
    double share(double distance) const { return interpolate(share_, distance); }
    /// S(d), 1/m.
    double slope(double distance) const { return interpolate(slope_, distance); }
    /// B(d), 1.
    double moment(double distance) const { return interpolate(moment_, distance); }

private:
    static constexpr std::size_t intervals = 300;

    template <class Kernel>
    static void add_plane(const Kernel& kernel, double spacing, int dimensions, double s, double& share, double& slope,
                          double& moment)
    {
        constexpr int points = 400;
        const double reach = std::sqrt(kernel.support() * kernel.support() - s * s), width = reach / points;
        for (int q = 0; q < points; ++q) {
            const double rho = (q + 0.5) * width;
            const double measure = (dimensions == 2 ? 2.0 : 2.0 * std::numbers::pi * rho) * width * spacing;
            const auto w = kernel(std::sqrt(s * s + rho * rho));
            share += measure * w.value;
            slope -= measure * s * w.gradient_over_r;
            moment -= measure * s * s * w.gradient_over_r;
        }
    }

    double interpolate(const std::array<double, intervals + 1>& table, double distance) const
    {
        const double place = std::max(distance, 0.0) / step_;
        if (!(place < static_cast<double>(intervals))) return 0.0;
        const auto k = static_cast<std::size_t>(place);
        const double part = place - static_cast<double>(k);
        return table[k] * (1.0 - part) + table[k + 1] * part;
    }

    double step_;
    std::array<double, intervals + 1> share_{}, slope_{}, moment_{};
};

} // namespace cupel
