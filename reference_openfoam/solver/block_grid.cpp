#include <algorithm>

#include "block_grid.hpp"

namespace cupel
{
BlockGrid::BlockGrid(const fvMesh& mesh, scalar spacing) : index_(mesh.nCells())
{
    const scalar resolution = 1e-3 * spacing;
    for (int axis = 0; axis < 3; ++axis) {
        // centres of the cells along this axis, over all ranks, and their widths from the recursion of mid-points
        List<scalarList> parts(Pstream::nProcs());
        parts[Pstream::myProcNo()] = mesh.C().primitiveField().component(axis)();
        Pstream::gatherList(parts);
        Pstream::scatterList(parts);
        std::vector<scalar> all;
        for (const scalarList& part : parts)
            all.insert(all.end(), part.begin(), part.end());
        std::sort(all.begin(), all.end());
        Line& line = lines_[axis];
        for (const scalar value : all)
            if (line.centres.empty() || value - line.centres.back() > resolution) line.centres.push_back(value);
        line.faces.push_back(mesh.bounds().min()[axis]);
        for (const scalar centre : line.centres) {
            line.widths.push_back(2 * (centre - line.faces.back()));
            line.faces.push_back(line.faces.back() + line.widths.back());
        }
        forAll (mesh.C(), cell) {
            const auto found =
                std::lower_bound(line.centres.begin(), line.centres.end(), mesh.C()[cell][axis] - resolution);
            index_[cell][axis] = int(found - line.centres.begin());
        }
    }
}

std::vector<scalar> BlockGrid::gathered(const scalarField& values) const
{
    std::vector<scalar> all(cell_count(), 0);
    forAll (values, cell)
        all[flat(index_[cell])] = values[cell];
    sum_over_ranks(all);
    return all;
}

void BlockGrid::sum_over_ranks(std::vector<scalar>& values)
{
    if (!Pstream::parRun()) return;
    scalarList all(label(values.size()));
    std::copy(values.begin(), values.end(), all.begin());
    Pstream::listCombineGather(all, plusEqOp<scalar>());
    Pstream::listCombineScatter(all);
    std::copy(all.begin(), all.end(), values.begin());
}
} // namespace cupel
