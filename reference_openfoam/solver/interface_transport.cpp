#include "interface_transport.hpp"

#include "plane_in_cell.hpp"

namespace cupel
{
namespace
{
const scalar pure = 1e-12; // a cell as full or as empty as this has no plane
}

InterfaceTransport::InterfaceTransport(const Fields& fields, const HeightFunction& heights)
    : heights_(heights), grid_(heights.grid())
{
    const fvMesh& mesh = fields.mesh;
    volume_ = grid_.gathered(mesh.V().field());
    for (int axis = 0; axis < 3; ++axis)
        for (auto& side : faces_[axis])
            side.assign(mesh.nCells(), Face());
    const auto note = [this](label cell, scalar outward, const vector& area, label patch, label place) {
        for (int axis = 0; axis < 3; ++axis)
            if (mag(area[axis]) > 0.9 * mag(area))
                faces_[axis][outward * area[axis] > 0 ? 1 : 0][cell] = {patch, place,
                                                                        area[axis] > 0 ? scalar(1) : scalar(-1)};
    };
    forAll (mesh.neighbour(), face) {
        note(mesh.owner()[face], 1, mesh.Sf()[face], -1, face);
        note(mesh.neighbour()[face], -1, mesh.Sf()[face], -1, face);
    }
    forAll (mesh.boundary(), patch) {
        const labelUList& cells = mesh.boundary()[patch].faceCells();
        if (mesh.boundary()[patch].size() == 0) continue; // of two dimensions, the third's
        forAll (cells, place)
            note(cells[place], 1, mesh.boundary()[patch].Sf()[place], patch, place);
    }
}

std::vector<scalar> InterfaceTransport::gathered_flux(const surfaceScalarField& flux, int axis, int side) const
{
    const std::vector<Face>& faces = faces_[axis][side];
    scalarField values(label(faces.size()), Zero);
    forAll (values, cell) {
        const Face& face = faces[cell];
        if (face.place < 0) continue;
        values[cell] = face.sign * (face.patch < 0 ? flux[face.place] : flux.boundaryField()[face.patch][face.place]);
    }
    return grid_.gathered(values);
}

void InterfaceTransport::advance(Fields& fields, label first)
{
    FlowFields& flow = fields.flow();
    volScalarField& fraction = fields.fraction;
    const scalar step = fields.mesh.time().deltaTValue();
    fraction.oldTime(); // kept before it moves
    std::vector<scalar> share = grid_.gathered(fraction.primitiveField());
    std::vector<bool> mostly_full(share.size());
    for (std::size_t cell = 0; cell < share.size(); ++cell)
        mostly_full[cell] = share[cell] > 0.5;
    for (int turn = 0; turn < 3; ++turn) {
        const int axis = int((first + turn) % 3);
        for (int side = 0; side < 2; ++side)
            volume_flux_[axis][side] = gathered_flux(flow.flux, axis, side);
        if (grid_.line(axis).count() > 1) sweep(share, mostly_full, axis, step);
    }
    flow.fraction_flux == dimensionedScalar(flow.fraction_flux.dimensions(), Zero);
    scalarField& moved = fraction.primitiveFieldRef();
    for (int axis = 0; axis < 3; ++axis) {
        if (grid_.line(axis).count() == 1) continue;
        forAll (moved, cell) {
            const std::size_t here = grid_.flat(grid_.index(cell));
            for (int side = 0; side < 2; ++side) {
                const scalar flux = primary_flux_[axis][side][here];
                const Face& face = faces_[axis][side][cell];
                if (face.place < 0) continue;
                (face.patch < 0 ? flow.fraction_flux[face.place]
                                : flow.fraction_flux.boundaryFieldRef()[face.patch][face.place]) = face.sign * flux;
                moved[cell] += (side == 0 ? 1 : -1) * flux * step / volume_[here];
            }
        }
    }
    fraction.correctBoundaryConditions();
}

void InterfaceTransport::sweep(std::vector<scalar>& share, const std::vector<bool>& mostly_full, int axis, scalar step)
{
    const std::vector<scalar>&lower = volume_flux_[axis][0], &upper = volume_flux_[axis][1];
    std::vector<scalar>&primary_lower = primary_flux_[axis][0], &primary_upper = primary_flux_[axis][1];
    primary_lower.assign(share.size(), 0);
    primary_upper.assign(share.size(), 0);
    const std::array<int, 3> counts = {{grid_.line(0).count(), grid_.line(1).count(), grid_.line(2).count()}};
    const int last = counts[axis] - 1;
    Index cell;
    for (cell[2] = 0; cell[2] < counts[2]; ++cell[2])
        for (cell[1] = 0; cell[1] < counts[1]; ++cell[1])
            for (cell[0] = 0; cell[0] < counts[0]; ++cell[0]) {
                const std::size_t here = grid_.flat(cell);
                // its upper face, where it is itself the donor or the next cell is
                const scalar flux = upper[here];
                const bool at_end = cell[axis] == last;
                if (!at_end || heights_.is_periodic(axis)) {
                    Index next = cell;
                    next[axis] = at_end ? 0 : cell[axis] + 1;
                    const std::size_t there = grid_.flat(next);
                    primary_upper[here] =
                        flux > 0 ? flux * donated_share(share, cell, axis, true, flux * step / volume_[here])
                                 : flux * donated_share(share, next, axis, false, -flux * step / volume_[there]);
                    primary_lower[there] = primary_upper[here];
                }
                else if (flux > 0) // out of the scene; what comes in is the surrounding material
                    primary_upper[here] = flux * donated_share(share, cell, axis, true, flux * step / volume_[here]);
                if (cell[axis] == 0 && !heights_.is_periodic(axis) && lower[here] < 0)
                    primary_lower[here] =
                        lower[here] * donated_share(share, cell, axis, false, -lower[here] * step / volume_[here]);
            }
    for (std::size_t here = 0; here < share.size(); ++here)
        share[here] +=
            (primary_lower[here] - primary_upper[here] + (mostly_full[here] ? upper[here] - lower[here] : 0)) * step /
            volume_[here];
}

scalar InterfaceTransport::donated_share(const std::vector<scalar>& share, const Index& donor, int axis, bool upper,
                                         scalar thickness) const
{
    const scalar filled = share[grid_.flat(donor)];
    if (filled < pure || filled > 1 - pure || thickness < VSMALL) return filled;
    vector outward = heights_.outward_normal(share, donor);
    for (int along = 0; along < 3; ++along)
        outward[along] *= grid_.line(along).widths[donor[along]];
    if (grid_.line(1).count() == 1) outward[1] = 0;
    return volume_in_slab(outward, filled, axis, upper, min(thickness, scalar(1))) / min(thickness, scalar(1));
}
} // namespace cupel
