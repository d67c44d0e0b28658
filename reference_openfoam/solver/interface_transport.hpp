/// Transport of the volume fraction by planes in cells, one axis after the other (Weymouth and Yue 2010, Journal of
/// Computational Physics 229, 2853).
///
///   α* = α − Δt [F_upper − F_lower]/V + c Δt [φ_upper − φ_lower]/V     along each axis in turn,
///   c = 1 where α > ½ before the step, else 0
///
/// F is the primary material's volume in the part of the donor cell that leaves it through a face, below the plane that
/// stands for the interface there (plane_in_cell.hpp, HeightFunction::outward_normal). Within 0 … 1 for Courant numbers
/// up to ½, and conservative: over all axes the c terms add up to ∇·φ = 0, and the fluxes F alone are what α finally
/// moves by. The interface stays one cell thick and smooth, where compression of a spread one wrinkles it.
#pragma once

#include "height_function.hpp"

namespace cupel
{
class InterfaceTransport
{
public:
    InterfaceTransport(const Fields& fields, const HeightFunction& heights);

    /// Moves α over one step of the clock and gives the primary material's fluxes; `first`: the axis to begin with.
    void advance(Fields& fields, label first);

private:
    typedef BlockGrid::Index Index;

    /// One face of a cell: where OpenFOAM has it (patch −1: inside; place −1: nowhere), and the sign of its flux along
    /// the rising coordinate.
    struct Face
    {
        label patch, place;
        scalar sign;
        Face(label on = -1, label at = -1, scalar positive = 0) : patch(on), place(at), sign(positive) {}
    };

    std::vector<scalar> gathered_flux(const surfaceScalarField& flux, int axis, int side) const;
    /// The sweep along one axis: changes `share`, gives the primary material's flux through every cell's lower and
    /// upper face.
    void sweep(std::vector<scalar>& share, const std::vector<bool>& mostly_full, int axis, scalar step);
    /// Share of the primary material in what leaves cell `donor` through its upper or lower face, the part `thickness`
    /// of it.
    scalar donated_share(const std::vector<scalar>& share, const Index& donor, int axis, bool upper,
                         scalar thickness) const;

    const HeightFunction& heights_;
    const BlockGrid& grid_;
    std::array<std::array<std::vector<Face>, 2>, 3> faces_; // by axis and side, for each cell of this rank
    std::array<std::array<std::vector<scalar>, 2>, 3> volume_flux_,
        primary_flux_; // the same for all ranks, by flat index
    std::vector<scalar> volume_;
};
} // namespace cupel
