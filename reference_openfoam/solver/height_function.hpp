/// Curvature from height functions (Cummins, Francois and Kothe 2005; Popinet 2009), on the block of grid lines of this
/// solver.
///
///   H = position of the interface in a column of cells along the axis nearest to its normal: Σ α Δ from full to empty
///   κ = −[H_xx (1 + H_y²) + H_yy (1 + H_x²) − 2 H_xy H_x H_y]/(1 + H_x² + H_y²)^{3/2}
///
/// from three columns each way; where five are there and no edge between them is steeper than 45° across and 27° along
/// itself, as the mean over the middle one of −∇·[∇H/(1 + |∇H|²)^½] with slopes of fourth order on its edges:
/// (15 (H₁ − H₀) − (H₂ − H₋₁))/12Δ.
///
/// At a wall the row of heights behind it follows from the contact angle θ (Afkhami and Bussmann 2009 continue with the
/// slope cotθ √(1 + H_y²) alone), here as an arc that meets the wall at θ; cotθ = 0 at symmetry planes and where
/// nothing wets.
///
/// H is taken toward the surrounding, so a drop has κ > 0. A cell has this curvature if all columns of its 3 × 3
/// stencil go from full to empty within reach and the stencil does not leave the mesh through an open side (through a
/// periodic one it comes in at the other end). Where five columns do not give it, more than two cells from the sides, a
/// cell has that of a paraboloid fitted to the heights along all axes around it (paraboloid_fit.hpp), less its
/// fourth-order term: on a sphere of five cells a radius, around its space diagonals, smoothed normals are 7 % off,
/// three columns 0.9 %, a bare paraboloid 2.7 %, each enough to shake the drop where cells with one lie beside cells
/// with another. Second order on smooth interfaces, where the divergence of a smoothed normal is several per cent off
/// at every resolution.
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

    /// Normal of the interface in a cell toward the surrounding, of any length: from heights along the axis nearest to
    /// it, or else along the second nearest; where there are none, from ∇α over 3 × 3 × 3 cells (Youngs 1982), at a
    /// wall turned to its contact angle.
    vector outward_normal(const std::vector<scalar>& fraction, const BlockGrid::Index& cell) const;

    /// Value at the interface of a field `values` that may have a kink there, and its gradient along the interface
    /// (surface_temperature.hpp); false, and nothing changed, without clean columns around the cell.
    bool surface_value(const std::vector<scalar>& fraction, const std::vector<scalar>& values, scalar weight_inside,
                       const BlockGrid::Index& cell, scalar& value, vector& gradient) const;

    const BlockGrid& grid() const { return grid_; }
    bool is_periodic(int axis) const { return periodic_[axis]; }

private:
    typedef BlockGrid::Index Index;

    /// Position of the interface in the column along `axis` through `start`, toward `outward` (±1); false if it has
    /// none in reach.
    bool height(const std::vector<scalar>& fraction, Index start, int axis, int outward, scalar& position) const;
    /// The heights along `axis` around a cell, those behind sides continued; false if a column has none.
    bool stencil(const std::vector<scalar>& fraction, const Index& cell, int axis, int outward,
                 scalar (&heights)[3][3]) const;
    struct Stencil
    {
        int axis = 0, outward = 1;
        scalar heights[3][3] = {}, slope_x = 0, slope_y = 0;
    };
    /// ∇α times 16 over 3 × 3 × 3 cells (Youngs 1982), those behind a side mirrored.
    vector slope_of_share(const std::vector<scalar>& fraction, const Index& cell) const;
    /// The stencil along the axis nearest to `slope`, or else along the second nearest; false if there is none.
    bool best_stencil(const std::vector<scalar>& fraction, const Index& cell, const vector& slope, Stencil& best) const;
    /// κ at a cell from heights along `axis`, by five columns each way (by_edges) or three; false if there is none.
    bool curvature_along(const std::vector<scalar>& fraction, const Index& cell, int axis, int outward, bool by_edges,
                         scalar& curvature) const;

    /// Height two columns away from `column` along `along`, behind sides without contact angle the mirror image's;
    /// false if there is none, or that column has another width.
    bool height_farther(const std::vector<scalar>& fraction, Index column, int along, int way, int axis, int outward,
                        scalar& position) const;
    /// Mean κ over the footprint of the middle column as the divergence of the tangent on its edges, whose slopes are
    /// of fourth order over five columns; false where a surface is too steep for that, or columns are missing.
    bool curvature_of_edges(const std::vector<scalar>& fraction, const Index& cell, int axis, int outward,
                            const scalar (&heights)[3][3], scalar& curvature) const;

    /// κ at a cell from a paraboloid fitted to the heights along all axes around it; false if they are too few.
    bool curvature_of_fit(const std::vector<scalar>& fraction, const Index& cell, const vector& outward,
                          scalar& curvature) const;

    /// α of the cell that lies `ahead` along `axis`, i and j along the other two; behind a side, of the one before it.
    scalar share_near(const std::vector<scalar>& fraction, Index cell, int axis, int ahead, int i, int j) const;

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
        bool continues = false, wets = false;
        scalar cotangent = 0;
    };

    const BlockGrid grid_;
    std::array<std::array<Side, 2>, 3> sides_;
    std::array<bool, 3> periodic_ = {{false, false, false}};
    scalar spacing_;
};
} // namespace cupel
