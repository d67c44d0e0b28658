#include "scene/shape.hpp"

#include <cmath>
#include <complex>
#include <numbers>

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

Vector3 of_disc(const Perturbation& perturbation, double radius, const Vector3& offset)
{
    // grad Re(w^n)/n = (Re, -Im) of w^(n-1) along (z, x), with w = z + i x
    const std::complex<double> w(offset[2] / radius, offset[0] / radius);
    const double r = std::abs(w), scale = perturbation.amplitude * radius;
    if (r <= 1.0) {
        const std::complex<double> power = std::pow(w, perturbation.mode - 1);
        return {-scale * power.imag(), 0.0, scale * power.real()};
    }
    const std::complex<double> power = std::pow(w, -perturbation.mode - 1);
    return {-scale * power.imag(), 0.0, scale * power.real()};
}

Vector3 of_sphere(const Perturbation& perturbation, double radius, const Vector3& offset)
{
    const double side = std::hypot(offset[0], offset[1]), distance = std::hypot(side, offset[2]);
    if (distance == 0) return {};
    const int n = perturbation.mode;
    const double r = distance / radius, cosine = offset[2] / distance, sine = side / distance;
    const Legendre polynomial = legendre(n, cosine);
    const double scale = perturbation.amplitude * radius * (r <= 1.0 ? std::pow(r, n - 1) : std::pow(r, -n - 2));
    const double outward = scale * polynomial.value;
    const double along = scale * sine * polynomial.slope * (r <= 1.0 ? -1.0 / n : 1.0 / (n + 1));
    const double sideways = outward * sine + along * cosine;
    return {side > 0 ? sideways * offset[0] / side : 0.0, side > 0 ? sideways * offset[1] / side : 0.0,
            outward * cosine - along * sine};
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
    return dimensions == 2 ? of_disc(*body.perturbation, body.radius, offset)
                           : of_sphere(*body.perturbation, body.radius, offset);
}

} // namespace cupel
