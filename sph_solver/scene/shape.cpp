#include "scene/shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace cupel
{

namespace
{

struct Legendre
{
    double value = 1;
    double slope = 0;
};

/// P_n(c) and its derivative, by the recurrences of Bonnet.
Legendre legendre(int n, double c)
{
    double before = 0, now = 1, slope = 0;
    for (int degree = 1; degree <= n; ++degree) {
        const double next = ((2 * degree - 1) * c * now - (degree - 1) * before) / degree;
        slope = c * slope + degree * now;
        before = now;
        now = next;
    }
    return {now, slope};
}

/// Offset from a drop's centre; in two dimensions without y.
Vector3 offset_from(const Body& body, const Vector3& position, int dimensions)
{
    return {position[0] - body.center[0], dimensions == 2 ? 0.0 : position[1] - body.center[1],
            position[2] - body.center[2]};
}

double surface_radius(const Body& body, const Vector3& offset, int dimensions)
{
    if (!body.perturbation) return body.radius;
    const double distance = std::hypot(offset[0], offset[1], offset[2]);
    const double cosine = distance > 0 ? offset[2] / distance : 1.0;
    const int n = body.perturbation->mode;
    const double shape = dimensions == 2 ? std::cos(n * std::atan2(offset[0], offset[2])) : legendre(n, cosine).value;
    return body.radius * (1.0 + body.perturbation->amplitude * shape);
}

bool inside(const Body& body, const Vector3& position, int dimensions, bool undisturbed)
{
    if (body.shape == BodyShape::powder_bed) return false;
    if (body.shape == BodyShape::sphere) {
        const Vector3 offset = offset_from(body, position, dimensions);
        const double radius = undisturbed ? body.radius : surface_radius(body, offset, dimensions);
        return offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2] < radius * radius;
    }
    double top = body.upper[2];
    if (body.surface_wave && !undisturbed)
        top += body.surface_wave->amplitude *
               std::cos(2.0 * std::numbers::pi * position[0] / body.surface_wave->wavelength);
    return position[0] >= body.lower[0] && position[0] < body.upper[0] && position[2] >= body.lower[2] &&
           position[2] < top && (dimensions == 2 || (position[1] >= body.lower[1] && position[1] < body.upper[1]));
}

/// How much of the motion inside a drop is left outside of it, and its derivative, s in radii: all of it at the
/// surface, nothing from `end` on, and no step in its first two derivatives.
struct Fading
{
    double share = 1, slope = 0;

    Fading(double s, double end)
    {
        const double t = std::clamp((s - 1.0) / (end - 1.0), 0.0, 1.0);
        share = 1.0 - t * t * t * (10.0 - t * (15.0 - 6.0 * t));
        slope = -30.0 * t * t * (1.0 - t) * (1.0 - t) / (end - 1.0);
    }
};

/// Where it ends: at twice the radius, or at the nearest side of the domain that leaves the drop whole.
double end_of_fading(const Body& body, const Domain& domain, int dimensions)
{
    double end = 2.0;
    for (const std::size_t axis : {0u, 1u, 2u}) {
        if (dimensions == 2 && axis == 1) continue;
        for (const double distance : {body.center[axis] - domain.lower[axis], domain.upper[axis] - body.center[axis]})
            if (distance > 1.01 * body.radius) end = std::min(end, distance / body.radius);
    }
    return end;
}

Vector3 of_disc(const Perturbation& perturbation, double radius, double end, const Vector3& offset)
{
    const double s = std::hypot(offset[0], offset[2]) / radius;
    if (s == 0) return {};
    const int n = perturbation.mode;
    const double angle = std::atan2(offset[0], offset[2]), sine = std::sin(angle), cosine = std::cos(angle);
    const Fading left(s, end);
    const double scale = perturbation.amplitude * radius * std::pow(s, n - 1);
    const double outward = scale * left.share * std::cos(n * angle);
    const double along = -scale * (left.share + s * left.slope / n) * std::sin(n * angle);
    return {outward * sine + along * cosine, 0.0, outward * cosine - along * sine};
}

Vector3 of_sphere(const Perturbation& perturbation, double radius, double end, const Vector3& offset)
{
    const double side = std::hypot(offset[0], offset[1]), distance = std::hypot(side, offset[2]);
    if (distance == 0) return {};
    const int n = perturbation.mode;
    const double s = distance / radius, cosine = offset[2] / distance, sine = side / distance;
    const Legendre polynomial = legendre(n, cosine);
    const Fading left(s, end);
    const double scale = perturbation.amplitude * radius * std::pow(s, n - 1);
    const double outward = scale * left.share * polynomial.value;
    const double along = -scale * (left.share / n + s * left.slope / (n * (n + 1))) * sine * polynomial.slope;
    const double sideways = outward * sine + along * cosine;
    return {side > 0 ? sideways * offset[0] / side : 0.0, side > 0 ? sideways * offset[1] / side : 0.0,
            outward * cosine - along * sine};
}

/// Where a steady motion takes an offset in the time of one, by steps of Runge and Kutta's: unlike a single
/// displacement along the motion it keeps volumes at finite amplitudes.
template <class Motion> Vector3 carried(const Vector3& offset, const Motion& motion)
{
    constexpr int steps = 4;
    constexpr double step = 1.0 / steps;
    const auto plus = [](Vector3 a, double factor, const Vector3& b) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            a[axis] += factor * b[axis];
        return a;
    };
    Vector3 place = offset;
    for (int k = 0; k < steps; ++k) {
        const Vector3 k1 = motion(place), k2 = motion(plus(place, 0.5 * step, k1)),
                      k3 = motion(plus(place, 0.5 * step, k2)), k4 = motion(plus(place, step, k3));
        for (const auto& [slope, weight] : {std::pair{k1, 1.0}, {k2, 2.0}, {k3, 2.0}, {k4, 1.0}})
            place = plus(place, weight * step / 6.0, slope);
    }
    return plus(place, -1.0, offset);
}

Vector3 of_wave(const Body& body, const Domain& domain, const Vector3& position)
{
    const double k = 2.0 * std::numbers::pi / body.surface_wave->wavelength;
    const bool below = position[2] < body.upper[2];
    const double depth = below ? body.upper[2] - body.lower[2] : domain.upper[2] - body.upper[2];
    const double height = below ? position[2] - body.lower[2] : domain.upper[2] - position[2];
    if (!(depth > 0)) return {};
    const double scale = body.surface_wave->amplitude / std::sinh(k * depth);
    const double along = scale * std::sin(k * position[0]) * std::cosh(k * height);
    return {below ? -along : along, 0.0, scale * std::cos(k * position[0]) * std::sinh(k * height)};
}

} // namespace

bool contains(const Body& body, const Vector3& position, int dimensions)
{
    return inside(body, position, dimensions, false);
}

bool contains_undisturbed(const Body& body, const Vector3& position, int dimensions)
{
    return inside(body, position, dimensions, true);
}

Vector3 displacement(const Body& body, const Domain& domain, const Vector3& position, int dimensions)
{
    if (body.surface_wave) return of_wave(body, domain, position);
    if (!body.perturbation) return {};
    const Vector3 offset = offset_from(body, position, dimensions);
    const double end = end_of_fading(body, domain, dimensions);
    return carried(offset, [&](const Vector3& place) {
        return dimensions == 2 ? of_disc(*body.perturbation, body.radius, end, place)
                               : of_sphere(*body.perturbation, body.radius, end, place);
    });
}

} // namespace cupel
