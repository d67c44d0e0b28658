#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "particles/particles.hpp"
#include "scene/case.hpp"

namespace cupel
{

inline std::array<double, 3> to_array(const Vector& a)
{
    return {a.x, a.y, a.z};
}

inline Vector to_vector(const std::array<double, 3>& a)
{
    return {a[0], a[1], a[2]};
}

/// Points in the middle of the cells of a case's domain, a spacing apart.
struct Lattice
{
    Vector lower;
    double spacing;
    std::array<int, 3> cells;

    Vector point(const std::array<int, 3>& cell) const
    {
        const bool flat = cells[1] == 1;
        return {lower.x + (cell[0] + 0.5) * spacing, flat ? 0.0 : lower.y + (cell[1] + 0.5) * spacing,
                lower.z + (cell[2] + 0.5) * spacing};
    }
};

/// What fills a lattice point.
struct Filling
{
    Kind kind;
    std::uint8_t material;
};

Lattice make_lattice(const Case& definition);

/// Grid of what fills each lattice point; later bodies lie over earlier ones.
class FillingGrid
{
public:
    FillingGrid(const Lattice& lattice, std::optional<Filling> background)
        : lattice_(lattice),
          cells_(static_cast<std::size_t>(lattice.cells[0]) * static_cast<std::size_t>(lattice.cells[1]) *
                     static_cast<std::size_t>(lattice.cells[2]),
                 background)
    {}

    std::optional<Filling>& at(const std::array<int, 3>& cell)
    {
        return cells_[(static_cast<std::size_t>(cell[2]) * static_cast<std::size_t>(lattice_.cells[1]) +
                       static_cast<std::size_t>(cell[1])) *
                          static_cast<std::size_t>(lattice_.cells[0]) +
                      static_cast<std::size_t>(cell[0])];
    }

    /// Fills the lattice points for which inside(point) holds, within a box that encloses them.
    template <class Inside>
    void fill(const Vector& lower, const Vector& upper, const Filling& filling, const Inside& inside)
    {
        std::array<int, 3> begin{}, end{};
        const std::array<double, 3> low{lower.x, lower.y, lower.z}, high{upper.x, upper.y, upper.z};
        const std::array<double, 3> origin{lattice_.lower.x, lattice_.lower.y, lattice_.lower.z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool flat = axis == 1 && lattice_.cells[1] == 1;
            const double first = std::floor((low[axis] - origin[axis]) / lattice_.spacing);
            const double last = std::ceil((high[axis] - origin[axis]) / lattice_.spacing);
            begin[axis] = flat ? 0 : static_cast<int>(std::clamp(first, 0.0, double(lattice_.cells[axis])));
            end[axis] = flat ? 1 : static_cast<int>(std::clamp(last, 0.0, double(lattice_.cells[axis])));
        }
        std::array<int, 3> cell{};
        for (cell[2] = begin[2]; cell[2] < end[2]; ++cell[2])
            for (cell[1] = begin[1]; cell[1] < end[1]; ++cell[1])
                for (cell[0] = begin[0]; cell[0] < end[0]; ++cell[0])
                    if (inside(lattice_.point(cell))) at(cell) = filling;
    }

private:
    Lattice lattice_;
    std::vector<std::optional<Filling>> cells_;
};

/// Fills the lattice points that a body holds as it is without a perturbation or a wave. Throws CaseError where a
/// powder bed cannot be read.
void fill_body(FillingGrid& grid, const Body& body, const Filling& filling, int dimensions);

} // namespace cupel
