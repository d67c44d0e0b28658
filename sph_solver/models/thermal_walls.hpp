#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "math/vector.hpp"
#include "models/wall_layers.hpp"
#include "scene/case.hpp"

namespace cupel
{

/// The domain's walls as heat sees them: flat, of prescribed temperature or adiabatic. Sides that are not walls are
/// open.
class ThermalWalls
{
public:
    template <class Kernel>
    ThermalWalls(const Domain& domain, const Kernel& kernel, double spacing, int dimensions)
        : layers_(kernel, spacing, dimensions), support_(kernel.support()), nearest_(0.2 * spacing)
    {
        for (std::size_t side = 0; side < 6; ++side) {
            const std::size_t axis = side / 2;
            const auto& boundary = domain.boundaries[side];
            if (!boundary || boundary->kind != BoundaryKind::wall || (axis == 1 && dimensions == 2)) continue;
            const bool upper = side % 2 == 1;
            planes_.push_back(
                {axis, upper ? domain.upper[axis] : domain.lower[axis], upper ? -1.0 : 1.0, boundary->temperature});
        }
    }

    const WallLayers& layers() const { return layers_; }

    bool any_temperature() const
    {
        return std::any_of(planes_.begin(), planes_.end(), [](const Plane& p) { return p.temperature.has_value(); });
    }

    /// What walls fill of a particle's kernel: all of them for the surface (their gradient ∇c, 1/m), those with a
    /// temperature for conduction as well (their share of it, its gradient, and the share of the kernel's moment along
    /// each axis). Where walls meet, no part is counted twice.
    struct Filling
    {
        Vector gradient{};
        double share = 0;
        double conducting_share = 0;
        Vector conducting_gradient{};
        Vector conducting_moment{};
    };
    Filling filling(const Vector& position) const
    {
        Filling result;
        double open = 1.0, open_to_conduction = 1.0, before_adiabatic = 1.0;
        Vector moment_missing{1.0, 1.0, 1.0}, open_gradient{}, adiabatic_gradient{};
        for (const Plane& plane : planes_) {
            const double d = plane.distance(position);
            if (d >= support_) continue;
            const double share = layers_.share(d), slope = layers_.slope(d);
            // ∇[1 − Π(1 − c)] built up factor by factor; c falls away from the wall.
            const auto multiply = [&](Vector& gradient_of_product, double product) {
                gradient_of_product = (1.0 - share) * gradient_of_product;
                plane.component(gradient_of_product) += plane.inward * slope * product;
            };
            result.gradient = -1.0 * result.gradient;
            multiply(result.gradient, open);
            result.gradient = -1.0 * result.gradient;
            open *= 1.0 - share;
            if (!plane.temperature) {
                multiply(adiabatic_gradient, before_adiabatic);
                before_adiabatic *= 1.0 - share;
                continue;
            }
            multiply(open_gradient, open_to_conduction);
            open_to_conduction *= 1.0 - share;
            Vector left{1.0 - share, 1.0 - share, 1.0 - share};
            plane.component(left) = 1.0 - layers_.moment(d);
            moment_missing = {moment_missing.x * left.x, moment_missing.y * left.y, moment_missing.z * left.z};
        }
        result.share = 1.0 - open;
        result.conducting_share = before_adiabatic * (1.0 - open_to_conduction);
        result.conducting_gradient = (1.0 - open_to_conduction) * adiabatic_gradient - before_adiabatic * open_gradient;
        result.conducting_moment = before_adiabatic * (Vector{1.0, 1.0, 1.0} - moment_missing);
        return result;
    }

    /// Power per volume and conductivity that walls of prescribed temperature give to a particle:
    ///
    ///   P/(V k) = Σ_walls 2 S(d) (T_wall − T)/d      [K/m²]
    ///
    /// which is the sum over wall particles whose temperature is extrapolated linearly through the wall, pair by pair:
    /// T_w = T_wall + (T_wall − T) d_w/d. No particle counts as nearer than 0.2 Δx.
    double conduction(const Vector& position, double temperature) const
    {
        double sum = 0.0;
        for (const Plane& plane : planes_)
            if (plane.temperature) {
                const double d = plane.distance(position);
                if (d < support_)
                    sum += 2.0 * layers_.slope(d) * (*plane.temperature - temperature) / std::max(d, nearest_);
            }
        return sum;
    }

    /// Temperature of the wall nearest to a place, empty where that one is adiabatic or there is none.
    std::optional<double> nearest_temperature(const Vector& position) const
    {
        const Plane* nearest = nullptr;
        for (const Plane& plane : planes_)
            if (!nearest || plane.distance(position) < nearest->distance(position)) nearest = &plane;
        return nearest ? nearest->temperature : std::nullopt;
    }

private:
    struct Plane
    {
        std::size_t axis;
        double place, inward;
        std::optional<double> temperature;

        template <class V> static auto& component_of(V& v, std::size_t axis)
        {
            return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
        }
        double& component(Vector& v) const { return component_of(v, axis); }
        double distance(const Vector& position) const { return inward * (component_of(position, axis) - place); }
    };

    WallLayers layers_;
    double support_, nearest_;
    std::vector<Plane> planes_;
};

} // namespace cupel
