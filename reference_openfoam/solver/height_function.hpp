/// Curvature from height functions (Cummins, Francois and Kothe 2005; Popinet 2009), on the block of grid lines of this
/// solver.
///
///   H = position of the interface in a column of cells along the axis nearest to its normal: Σ α Δ from full to empty
///   κ = −[H_xx (1 + H_y²) + H_yy (1 + H_x²) − 2 H_xy H_x H_y]/(1 + H_x² + H_y²)^{3/2}
///
/// At a wall the row of heights behind it follows from the contact angle θ (Afkhami and Bussmann 2009 continue with the
/// slope cotθ √(1 + H_y²) alone), here as an arc that meets the wall at θ; cotθ = 0 at symmetry planes and where
/// nothing wets.
///
/// H is taken toward the surrounding, so a drop has κ > 0. A cell has this curvature if all columns of its 3 × 3
/// stencil go from full to empty within reach and the stencil does not leave the mesh through an open side (through a
/// periodic one it comes in at the other end). Another one, more than two cells from the sides, has that of a
/// paraboloid fitted to the heights along all axes around it (paraboloid_fit.hpp): on a sphere of five cells a radius
/// those around its space diagonals, where the smoothed normals of the remaining cells are 7 % off, enough to shake the
/// drop at 0.3 m/s and more. Second order on smooth interfaces, where the divergence of a smoothed normal is several
/// per cent off at every resolution.
#pragma once

#include "block_grid.hpp"

namespace cupel
{
class HeightFunction
{
public:
    /// `contact_angle` [rad] holds on sides where `fraction` has a fixedGradient patch.
    HeightFunction(const volScalarField& fraction, scalar spacing, scalar contact_angle);

    /// Puts κ into the cells of `curvature` near the interface wherever heights give it.
    void apply(volScalarField& curvature, const volScalarField& fraction, const volVectorField& gradient) const;

private:
    typedef BlockGrid::Index Index;

    /// Position of the interface in the column along `axis` through `start`, toward `outward` (±1); false if it has
    /// none in reach.
    bool height(const std::vector<scalar>& fraction, Index start, int axis, int outward, scalar& position) const;
    /// κ at a cell from heights along `axis`; false if there is none.
    bool curvature_along(const std::vector<scalar>& fraction, const Index& cell, int axis, int outward,
                         scalar& curvature) const;

    /// κ at a cell from a paraboloid fitted to the heights along all axes around it; false if they are too few.
    bool curvature_of_fit(const std::vector<scalar>& fraction, const Index& cell, const vector& outward,
                          scalar& curvature) const;

    /// `index` along `axis`, brought back into the mesh by whole periods where the axis is periodic.
    int inside_period(int axis, int index) const;

    /// Distance from the centre of cell `index` to the next along `axis` [m]; beyond an end, to the mirrored cell or
    /// the one at the other end.
    scalar spacing_between(int axis, int index) const;
    /// Slope of three heights in a row along `axis`, of those that are inside the mesh.
    scalar slope(const scalar (&row)[3], int axis, int index) const;

    /// One end of an axis: whether heights can be continued behind it, and with which slope.
    struct Side
    {
        bool continues = false;
        scalar cotangent = 0;
    };

    const BlockGrid grid_;
    std::array<std::array<Side, 2>, 3> sides_;
    std::array<bool, 3> periodic_ = {{false, false, false}};
    scalar spacing_;
};
} // namespace cupel
