/// Curvature of the paraboloid nearest to points of a surface (Popinet 2009, section 5.2: where heights along one axis
/// do not suffice).
///
///   z = c₀ + c₁ x + c₂ y + c₃ x² + c₄ xy + c₅ y²      by weighted least squares, z along the outward normal
///   κ = −2 [c₃ (1 + c₂²) + c₅ (1 + c₁²) − c₄ c₁ c₂]/(1 + c₁² + c₂²)^{3/2}
///
/// In a plane (no extent along y) c₂ = c₄ = c₅ = 0. Lengths in units of the caller's choice; κ > 0 for a drop.
#pragma once

#include <vector>

#include "foam.hpp"

namespace cupel
{
class ParaboloidFit
{
public:
    /// `outward`: unit normal that z is along; `origin`: where x = y = z = 0; `flat_axis`: 0, 1, 2, or −1 in space.
    ParaboloidFit(const vector& origin, const vector& outward, int flat_axis);

    /// The paraboloid through `points` with `weights`; false if they do not determine one.
    bool fit(const std::vector<vector>& points, const std::vector<scalar>& weights);

    scalar curvature() const;
    /// How far the surface bends beyond the paraboloid at a point: term of fourth order of a sphere or cylinder with
    /// the paraboloid's square terms q, ¼ q |∇q|²; |∇q|² is taken as at most 1, beyond which the series says nothing.
    scalar bend_beyond(const vector& point) const;
    /// Unit normal of the paraboloid, outward, above or below a point.
    vector normal(const vector& point) const;

private:
    int terms() const { return planar_ ? 3 : 6; }

    const vector origin_, z_;
    const bool planar_;
    vector x_, y_;
    scalar c_[6] = {};
};
} // namespace cupel
