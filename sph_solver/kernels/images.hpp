#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "math/vector.hpp"
#include "scene/case.hpp"

namespace cupel
{

/// Where a particle is seen once more beyond a side of the domain: x' = sign ∘ x + shift. Vectors (velocities, normals)
/// turn by the sign alone; numbers stay.
struct Image
{
    Vector sign{1.0, 1.0, 1.0};
    Vector shift{}; ///< m

    Vector place(const Vector& p) const
    {
        return {sign.x * p.x + shift.x, sign.y * p.y + shift.y, sign.z * p.z + shift.z};
    }
    /// A mirror undoes itself, a period is undone by the other way.
    Image inverse() const { return {sign, {-sign.x * shift.x, -sign.y * shift.y, -sign.z * shift.z}}; }
    /// Whether vectors turn, which they do not where an image is only a period away.
    bool mirrors() const { return sign.x < 0.0 || sign.y < 0.0 || sign.z < 0.0; }
};

/// The images that periodic sides (a period up and down) and symmetry sides (a flat mirror) ask for, those beyond edges
/// and corners included. With an image its inverse is there as well, so "c sees an image of d" holds either way.
class Images
{
public:
    /// None: every side is a wall or open.
    Images() = default;

    /// reach and skin of the neighbour list, m. Throws CaseError where the domain is too short for one image a side to
    /// be enough, or not a whole number of spacings long.
    Images(const Domain& domain, int dimensions, double spacing, double reach, double skin) : skin_(skin)
    {
        std::array<std::vector<Image>, 3> along{std::vector<Image>{{}}, std::vector<Image>{{}}, std::vector<Image>{{}}};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (axis == 1 && dimensions == 2) continue;
            const double length = domain.upper[axis] - domain.lower[axis];
            const auto is = [&](std::size_t side, BoundaryKind kind) {
                const auto& boundary = domain.boundaries[2 * axis + side];
                return boundary && boundary->kind == kind;
            };
            const auto check = [&](std::size_t side) {
                const std::string where = std::string("domain.boundaries.") + side_names[2 * axis + side];
                if (!(length > reach + 2.0 * skin))
                    throw CaseError(where + ": the domain is shorter than the reach of the smoothing kernel (" +
                                    std::to_string(length / spacing) + " spacings, it takes more than " +
                                    std::to_string((reach + 2.0 * skin) / spacing) +
                                    "); make it longer or the spacing finer");
                if (std::abs(length / spacing - std::round(length / spacing)) > 1e-6)
                    throw CaseError(where + ": the domain is " + std::to_string(length / spacing) +
                                    " spacings long, so that particles would not fit onto their images; choose a "
                                    "resolution of which it is a whole multiple");
            };
            const auto component = [axis](Vector& v) -> double& { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; };
            if (is(0, BoundaryKind::periodic)) {
                check(0);
                for (const double period : {-length, length}) {
                    Image image;
                    component(image.shift) = period;
                    along[axis].push_back(image);
                }
                periodic_[axis] = true;
                lower_[axis] = domain.lower[axis];
                length_[axis] = length;
            }
            for (const std::size_t side : {std::size_t{0}, std::size_t{1}})
                if (is(side, BoundaryKind::symmetry)) {
                    check(side);
                    Image image;
                    component(image.sign) = -1.0;
                    component(image.shift) = 2.0 * (side == 0 ? domain.lower[axis] : domain.upper[axis]);
                    along[axis].push_back(image);
                }
        }
        for (const Image& x : along[0])
            for (const Image& y : along[1])
                for (const Image& z : along[2])
                    all_.push_back({{x.sign.x, y.sign.y, z.sign.z}, {x.shift.x, y.shift.y, z.shift.z}});
        all_.erase(all_.begin()); // the particles themselves
    }

    bool any() const { return !all_.empty(); }
    std::size_t count() const { return all_.size(); }
    const Image& operator[](std::size_t k) const { return all_[k]; }

    /// The same place within the domain, m.
    Vector wrapped(const Vector& p) const { return {wrapped(p.x, 0), wrapped(p.y, 1), wrapped(p.z, 2)}; }
    /// Whether a box has gone so far beyond a periodic side that it has to be wrapped before it is listed again.
    bool must_wrap(const Vector& lower, const Vector& upper) const
    {
        return strays(lower.x, upper.x, 0) || strays(lower.y, upper.y, 1) || strays(lower.z, upper.z, 2);
    }

private:
    double wrapped(double x, std::size_t axis) const
    {
        if (!periodic_[axis] || !std::isfinite(x)) return x;
        const double beyond = x - lower_[axis];
        // A place that is already inside stays the same bit for bit.
        return beyond >= 0.0 && beyond < length_[axis] ? x : x - length_[axis] * std::floor(beyond / length_[axis]);
    }
    bool strays(double lower, double upper, std::size_t axis) const
    {
        return periodic_[axis] && (lower < lower_[axis] - skin_ || upper > lower_[axis] + length_[axis] + skin_);
    }

    std::vector<Image> all_;
    std::array<bool, 3> periodic_{};
    std::array<double, 3> lower_{}, length_{};
    double skin_ = 0.0;
};

} // namespace cupel
