/// The beam as a bundle of rays that go on after each reflection, in place of the first hit of laser_source.hpp.
///
///   power of a ray      P ∫∫ 2/(π r₀²) exp(−2 r²/r₀²) dx dy over its part of the beam's cross-section, exact by error
///   functions at a surface        A(φ) of it is absorbed (fresnel.hpp), the rest goes on along d − 2 (d·n̂) n̂
///
/// A ray goes from cell to cell (Amanatides and Woo 1987) and meets the surface in a cell that the primary material
/// fills by half or more, if it runs into the material there (n̂ = ∇α/|∇α|, d·n̂ > 0). It is followed until it leaves the
/// mesh, or a thousandth of it is left, which the last surface gets. Planes of symmetry are mirrors. Every rank follows
/// its share of the rays through the cells of all ranks, so the result does not depend on the number of ranks.
#pragma once

#include "block_grid.hpp"
#include "scene.hpp"

namespace cupel
{
class RayTracing
{
public:
    RayTracing(const Scene& scene, const fvMesh& mesh);

    /// Fills the absorbed power density [W/m³] with the beam's axis at `axis`; returns the power that surfaces took
    /// [W].
    scalar absorb(const point& axis, const volScalarField& fraction, scalarField& power_density) const;

private:
    struct Surface
    {
        std::vector<scalar> fraction;
        std::array<std::vector<scalar>, 3> gradient;
    };
    /// α and the gradient of α smoothed over its neighbours (weights 1, 2, 1 along each axis).
    Surface surface_of(const volScalarField& fraction) const;
    /// Follows one ray down from the top; adds what is absorbed to `absorbed` [W] by flat index.
    void follow(point position, BlockGrid::Index cell, scalar power, const Surface& surface,
                std::vector<scalar>& absorbed) const;
    /// Takes the ray to the next cell; false if it leaves the mesh.
    bool advance(point& position, vector& direction, BlockGrid::Index& cell) const;

    const Scene& scene_;
    const fvMesh& mesh_;
    const BlockGrid grid_;
    const scalar hagen_rubens_;
    std::array<std::array<bool, 2>, 3> mirrors_;
};
} // namespace cupel
