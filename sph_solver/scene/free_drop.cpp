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
            places.push_back({radius * std::cos(angle), 0.0, radius * std::sin(angle)});
        }
    }
    return places;
}

namespace
{

/// A point of the unit sphere for one of a cube's upper face, x and y from −1 to 1: areas keep their share. The face
/// goes to a plane whose Lambert projection is its part of the sphere.
std::array<double, 3> on_upper_cap(double x, double y)
{
    if (std::abs(y) > std::abs(x)) {
        const auto [a, b, c] = on_upper_cap(y, x);
        return {b, a, c};
    }
    if (x == 0.0) return {0.0, 0.0, 1.0};
    const double angle = y * std::numbers::pi / (12.0 * x), root = std::sqrt(2.0);
    const double scale = std::sqrt(root) * x / std::sqrt(root - std::cos(angle));
    const double across = scale * (root * std::cos(angle) - 1.0), along = scale * root * std::sin(angle);
    const double square = across * across + along * along, to_sphere = std::sqrt(1.0 - square / 4.0);
    return {to_sphere * across, to_sphere * along, 1.0 - square / 2.0};
}

} // namespace

std::vector<std::array<double, 3>> ball_on_shells(const Body& ball, double spacing)
{
    const auto shells = static_cast<std::size_t>(std::max(1L, std::lround(ball.radius / spacing)));
    std::vector<long> across(shells); // a face of the shell's cube
    std::vector<double> inside(shells + 1, 0.0);
    for (std::size_t k = 0; k < shells; ++k) {
        const double edge = std::sqrt(4.0 * std::numbers::pi / 6.0) * (static_cast<double>(k) + 0.5);
        across[k] = std::max(1L, std::lround(edge));
        inside[k + 1] = inside[k] + static_cast<double>(across[k] * across[k]);
    }
    std::vector<std::array<double, 3>> places;
    for (std::size_t k = 0; k < shells; ++k) {
        const auto surface_of = [&](double part) { return ball.radius * std::cbrt(part / inside.back()); };
        const double radius = 0.5 * (surface_of(inside[k]) + surface_of(inside[k + 1]));
        const auto along = [&](long index) {
            return (2.0 * static_cast<double>(index) + 1.0) / static_cast<double>(across[k]) - 1.0;
        };
        for (std::size_t face = 0; face < 3; ++face)
            for (const double side : {-radius, radius})
                for (long i = 0; i < across[k]; ++i)
                    for (long j = 0; j < across[k]; ++j) {
                        const auto cap = on_upper_cap(along(i), along(j));
                        std::array<double, 3> place{};
                        place[face] = side * cap[2];
                        place[(face + 1) % 3] = radius * cap[0];
                        place[(face + 2) % 3] = radius * cap[1];
                        places.push_back(place);
                    }
    }
    return places;
}

} // namespace cupel
