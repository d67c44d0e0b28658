#include "scene/round_walls.hpp"

#include "scene/even_out.hpp"
#include "scene/filling_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace cupel
{

namespace
{

constexpr double turn = 2.0 * std::numbers::pi;

/// Area that two discs of radius a and b have in common, their centres d apart.
double common_area(double a, double b, double d)
{
    if (d >= a + b) return 0.0;
    if (d <= std::abs(a - b)) return std::numbers::pi * std::min(a, b) * std::min(a, b);
    const auto segment = [d](double r, double other) {
        const double cosine = std::clamp((d * d + r * r - other * other) / (2.0 * d * r), -1.0, 1.0);
        const double angle = std::acos(cosine);
        return r * r * (angle - cosine * std::sin(angle));
    };
    return segment(a, b) + segment(b, a);
}

/// Rings of one scene; their number decides where each begins.
class Rings
{
public:
    Rings(const Vector3& center, double spacing) : center_(center), spacing_(spacing) {}

    std::size_t count(double radius) const
    {
        return static_cast<std::size_t>(std::max(1L, std::lround(turn * radius / spacing_)));
    }
    double angle(long ring, double radius, std::size_t number) const
    {
        constexpr double golden_angle = turn * (2.0 - std::numbers::phi);
        return turn * (static_cast<double>(number) + 0.5) / static_cast<double>(count(radius)) +
               golden_angle * static_cast<double>(ring);
    }
    Vector3 place(double radius, double angle) const
    {
        return {center_[0] + radius * std::cos(angle), 0.0, center_[2] + radius * std::sin(angle)};
    }

private:
    Vector3 center_;
    double spacing_;
};

double distance(const Vector3& a, const Vector3& b)
{
    return std::hypot(a[0] - b[0], a[2] - b[2]);
}

/// The layers of one wall; `side` is 1 where liquid lies outside its circle, −1 where inside, `ring` the number of its
/// outermost layer.
void add_wall(const Rings& rings, double radius, double spacing, int side, long ring, int layers,
              std::vector<RoundWallPlace>& walls)
{
    const std::size_t first = walls.size();
    const double outermost = radius - side * 0.5 * spacing, tops = static_cast<double>(rings.count(outermost));
    for (int layer = 0; layer < layers; ++layer) {
        const double depth = (layer + 0.5) * spacing, r = radius - side * depth;
        for (std::size_t number = 0; number < rings.count(r); ++number) {
            const double angle = rings.angle(ring - side * layer, r, number);
            const double steps = std::round((angle - rings.angle(ring, outermost, 0)) / turn * tops);
            const double nearest = steps - tops * std::floor(steps / tops);
            walls.push_back({rings.place(r, angle),
                             {side * std::cos(angle), 0.0, side * std::sin(angle)},
                             depth,
                             side / radius,
                             first + static_cast<std::size_t>(nearest)});
        }
    }
}

/// Area of a disc that lies between the walls, m².
double area_between(const Body& disc, const RoundWalls& walls)
{
    const double between = distance(disc.center, walls.center);
    const auto common_with = [&](double radius) { return common_area(disc.radius, radius, between); };
    const double within =
        walls.outer_radius ? common_with(*walls.outer_radius) : std::numbers::pi * disc.radius * disc.radius;
    return within - (walls.inner_radius ? common_with(*walls.inner_radius) : 0.0);
}

} // namespace

RoundPlaces place_between_round_walls(const Case& definition, int layers)
{
    const RoundWalls& round = *definition.domain.round_walls;
    const Body& body = definition.bodies.front();
    const bool two_phase = definition.surrounding && definition.surrounding->resolved;
    const double inner = round.inner_radius.value_or(0.0);
    const double outer = round.outer_radius.value_or(distance(body.center, round.center) + body.radius);
    const auto count = std::max(1L, std::lround((outer - inner) / definition.spacing));
    // A lone cylinder does not ask for a whole number of rings; what a vessel holds is one.
    const double spacing = round.outer_radius ? (outer - inner) / static_cast<double>(count) : definition.spacing;
    if (round.inner_radius && inner < (layers + 1) * spacing)
        throw CaseError("domain.round_walls.inner_radius: a cylinder of " + std::to_string(inner) +
                        " m has no room for " + std::to_string(layers) + " layers of particles " +
                        std::to_string(spacing) + " m apart; make it greater or choose a finer resolution");

    const Rings rings(round.center, spacing);
    RoundPlaces result;
    if (round.inner_radius) add_wall(rings, inner, spacing, 1, -1, layers, result.walls);
    if (round.outer_radius) add_wall(rings, outer, spacing, -1, count, layers, result.walls);
    std::vector<Vector> fixed, moved;
    for (const RoundWallPlace& wall : result.walls)
        fixed.push_back(to_vector(wall.position));
    // Without a vessel some rings more than the drop needs keep those that it needs in their places.
    const long last = round.outer_radius ? count : count + 1 + layers;
    for (long ring = 0; ring < last; ++ring) {
        const double radius = inner + (static_cast<double>(ring) + 0.5) * spacing;
        for (std::size_t number = 0; number < rings.count(radius); ++number)
            (ring <= count ? moved : fixed)
                .push_back(to_vector(rings.place(radius, rings.angle(ring, radius, number))));
    }
    const double mean_volume = even_out_between(moved, fixed, spacing);
    std::vector<Vector3> places;
    for (const Vector& place : moved)
        places.push_back(to_array(place));
    std::stable_sort(places.begin(), places.end(), [&](const Vector3& a, const Vector3& b) {
        return distance(a, body.center) < distance(b, body.center);
    });

    const double area = area_between(body, round);
    result.volume = two_phase ? mean_volume : spacing * spacing;
    const auto drop = std::min<std::size_t>(places.size(), static_cast<std::size_t>(std::lround(area / result.volume)));
    if (drop == 0)
        throw CaseError("resolution: no particle of the drop fits between the round walls at a spacing of " +
                        std::to_string(definition.spacing) + " m; choose a finer one");
    if (!two_phase) result.volume = area / static_cast<double>(drop);
    const auto end_of_drop = places.begin() + static_cast<std::ptrdiff_t>(drop);
    result.primary.assign(places.begin(), end_of_drop);
    if (two_phase) result.other.assign(end_of_drop, places.end());
    return result;
}

} // namespace cupel
