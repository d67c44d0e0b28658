#include "scene/free_drop.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cupel
{

std::optional<double> volume_in_domain(const Body& ball, const Domain& domain, int dimensions)
{
    const double radius = ball.radius;
    for (std::size_t axis = 0; axis < 2; ++axis)
        if ((axis == 0 || dimensions == 3) &&
            (ball.center[axis] - radius < domain.lower[axis] || ball.center[axis] + radius > domain.upper[axis]))
            return std::nullopt;
    const auto below = [&](double z) {
        z = std::clamp(z - ball.center[2], -radius, radius);
        return dimensions == 2 ? z * std::sqrt(radius * radius - z * z) + radius * radius * std::asin(z / radius)
                               : std::numbers::pi * z * (radius * radius - z * z / 3.0);
    };
    return below(domain.upper[2]) - below(domain.lower[2]);
}

bool whole_in_domain(const Body& ball, const Domain& domain)
{
    return ball.center[2] - ball.radius >= domain.lower[2] && ball.center[2] + ball.radius <= domain.upper[2];
}

std::vector<std::array<double, 3>> disc_on_rings(const Body& disc, double spacing)
{
    constexpr double turn = 2.0 * std::numbers::pi, golden_angle = turn * (2.0 - std::numbers::phi);
    const auto rings = std::max(1L, std::lround(disc.radius / spacing));
    std::vector<std::array<double, 3>> places;
    for (long k = 0; k < rings; ++k) {
        const double order = static_cast<double>(k) + 0.5;
        const double radius = order * disc.radius / static_cast<double>(rings);
        const auto count = std::lround(turn * order);
        for (long m = 0; m < count; ++m) {
            const double angle = turn * (static_cast<double>(m) + 0.5) / static_cast<double>(count) +
                                 golden_angle * static_cast<double>(k);
            places.push_back(
                {disc.center[0] + radius * std::cos(angle), 0.0, disc.center[2] + radius * std::sin(angle)});
        }
    }
    return places;
}

} // namespace cupel
