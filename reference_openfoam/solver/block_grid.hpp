/// The mesh as what it is, a block of hexahedra on three sets of grid lines, with the cells of all ranks in one
/// numbering.
#pragma once

#include <array>
#include <vector>

#include "foam.hpp"

namespace cupel
{
class BlockGrid
{
public:
    typedef std::array<int, 3> Index;

    /// Along one axis: n centres and widths of cells, n + 1 faces [m].
    struct Line
    {
        std::vector<scalar> centres, widths, faces;
        int count() const { return int(centres.size()); }
    };

    /// `spacing`: lines are at least a thousandth of it apart.
    BlockGrid(const fvMesh& mesh, scalar spacing);

    const Line& line(int axis) const { return lines_[axis]; }
    std::size_t cell_count() const
    {
        return lines_[0].centres.size() * lines_[1].centres.size() * lines_[2].centres.size();
    }
    std::size_t flat(const Index& index) const
    {
        return index[0] + lines_[0].centres.size() * (index[1] + lines_[1].centres.size() * index[2]);
    }
    /// Where cell `cell` of this rank is.
    const Index& index(label cell) const { return index_[cell]; }

    /// Values of this rank's cells, put together with those of all others: by flat index, the same on all ranks.
    std::vector<scalar> gathered(const scalarField& values) const;
    /// Sum over all ranks of values by flat index.
    static void sum_over_ranks(std::vector<scalar>& values);

private:
    std::array<Line, 3> lines_;
    std::vector<Index> index_;
};
} // namespace cupel
