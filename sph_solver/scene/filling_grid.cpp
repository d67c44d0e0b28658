#include "scene/filling_grid.hpp"

#include "scene/powder_bed.hpp"
#include "scene/shape.hpp"

namespace cupel
{

namespace
{

bool inside_sphere(const Vector& center, double radius, const Vector& p)
{
    const Vector offset = p - center;
    return dot(offset, offset) < radius * radius;
}

} // namespace

Lattice make_lattice(const Case& definition)
{
    const auto& lower = definition.domain.lower;
    const auto& upper = definition.domain.upper;
    const auto cells = [&](std::size_t axis) {
        return static_cast<int>(std::lround((upper[axis] - lower[axis]) / definition.spacing));
    };
    return {{lower[0], lower[1], lower[2]},
            definition.spacing,
            {cells(0), definition.dimensions == 2 ? 1 : cells(1), cells(2)}};
}

void fill_body(FillingGrid& grid, const Body& body, const Filling& filling, int dimensions)
{
    const Vector center = to_vector(body.center);
    const auto inside = [&](const Vector& p) { return contains_undisturbed(body, to_array(p), dimensions); };
    const auto fill_within = [&](const Vector& middle, double radius, const auto& inside_ball) {
        const Vector reach{radius, radius, radius};
        grid.fill(middle - reach, middle + reach, filling, inside_ball);
    };
    switch (body.shape) {
    case BodyShape::box:
        grid.fill(to_vector(body.lower), to_vector(body.upper), filling, inside);
        break;
    case BodyShape::sphere:
        fill_within(center, body.radius, inside);
        break;
    case BodyShape::powder_bed: {
        Body box = body;
        box.shape = BodyShape::box;
        for (const auto& grain : read_powder_bed(body.file))
            if (contains_undisturbed(box, grain.center, dimensions))
                fill_within(to_vector(grain.center), grain.radius,
                            [&](const Vector& p) { return inside_sphere(to_vector(grain.center), grain.radius, p); });
        break;
    }
    }
}

} // namespace cupel
