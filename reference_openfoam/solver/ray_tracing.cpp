#include <cmath>
#include <functional>

#include "fresnel.hpp"
#include "gaussian_beam.hpp"
#include "processorFvPatch.H"
#include "ray_tracing.hpp"

namespace cupel
{
namespace
{
const int rays_across_cell = 3;  // in x and y, through a cell as wide as the spacing
const int most_reflections = 50; // of a ray caught in a hole; a tenth of the light is absorbed at each
const scalar negligible = 1e-3;  // share of a ray that is not worth following
const int smoothing_passes = 2;  // of α before its gradient: that of a sharp α turns by ten degrees from cell to cell
const scalar grazing_cosine = 0.02; // least cosine of incidence: normals of cells are not better known
} // namespace

RayTracing::RayTracing(const Scene& scene, const fvMesh& mesh)
    : scene_(scene), mesh_(mesh), grid_(mesh, scene.spacing),
      hagen_rubens_(hagen_rubens_number(scene.laser->absorptivity)), mirrors_()
{
    forAll (mesh.boundary(), patch) {
        if (isA<processorFvPatch>(mesh.boundary()[patch])) continue;
        const vector outward = gSum(mesh.boundary()[patch].Sf());
        for (int axis = 0; axis < 3; ++axis)
            if (mag(outward[axis]) > 0.9 * mag(outward) && mesh.boundary()[patch].type() == "symmetryPlane")
                mirrors_[axis][outward[axis] > 0 ? 1 : 0] = true;
    }
}

scalar RayTracing::absorb(const point& axis, const volScalarField& fraction, scalarField& power_density) const
{
    const Surface surface = surface_of(fraction);
    std::vector<scalar> absorbed(grid_.cell_count(), 0);
    const LaserPath& laser = *scene_.laser;
    const BlockGrid::Line &x = grid_.line(0), &y = grid_.line(1), &z = grid_.line(2);
    label number = 0;
    for (int i = 0; i < x.count(); ++i)
        for (int j = 0; j < y.count(); ++j) {
            const auto rays_in = [this](scalar width) {
                return max(1, int(std::lround(rays_across_cell * width / scene_.spacing)));
            };
            const int across = rays_in(x.widths[i]), along = rays_in(y.widths[j]);
            const scalar step_x = x.widths[i] / across, step_y = y.widths[j] / along;
            if (gaussian_share(x.faces[i] - axis.x(), x.faces[i + 1] - axis.x(), laser.spot_radius) *
                    gaussian_share(y.faces[j] - axis.y(), y.faces[j + 1] - axis.y(), laser.spot_radius) <
                1e-12)
                continue;
            for (int a = 0; a < across; ++a)
                for (int b = 0; b < along; ++b) {
                    if (number++ % Pstream::nProcs() != Pstream::myProcNo()) continue;
                    const scalar left = x.faces[i] + a * step_x, front = y.faces[j] + b * step_y;
                    const scalar power = laser.power *
                                         gaussian_share(left - axis.x(), left + step_x - axis.x(), laser.spot_radius) *
                                         gaussian_share(front - axis.y(), front + step_y - axis.y(), laser.spot_radius);
                    follow(point(left + 0.5 * step_x, front + 0.5 * step_y, z.faces.back()), {{i, j, z.count() - 1}},
                           power, surface, absorbed);
                }
        }
    BlockGrid::sum_over_ranks(absorbed);
    scalar sum = 0;
    for (const scalar power : absorbed)
        sum += power;
    forAll (power_density, cell)
        power_density[cell] = absorbed[grid_.flat(grid_.index(cell))] / mesh_.V()[cell];
    return sum;
}

RayTracing::Surface RayTracing::surface_of(const volScalarField& fraction) const
{
    Surface surface;
    surface.fraction = grid_.gathered(fraction.primitiveField());
    const std::array<std::size_t, 3> stride = {
        {1, std::size_t(grid_.line(0).count()), std::size_t(grid_.line(0).count()) * grid_.line(1).count()}};
    // at(cell, value below, value here, value above, place along the axis), with the mesh's last value repeated behind
    // it
    const auto along = [this, &stride](int axis, const std::vector<scalar>& values, std::vector<scalar>& result,
                                       const std::function<scalar(scalar, scalar, scalar, int)>& at) {
        const int count = grid_.line(axis).count();
        result.resize(values.size());
        for (std::size_t cell = 0; cell < values.size(); ++cell) {
            const int place = int(cell / stride[axis] % count);
            result[cell] = at(values[place > 0 ? cell - stride[axis] : cell], values[cell],
                              values[place + 1 < count ? cell + stride[axis] : cell], place);
        }
    };
    std::vector<scalar> smooth = surface.fraction, next;
    for (int pass = 0; pass < smoothing_passes; ++pass)
        for (int axis = 0; axis < 3; ++axis) {
            along(axis, smooth, next,
                  [](scalar below, scalar here, scalar above, int) { return 0.25 * (below + 2 * here + above); });
            smooth.swap(next);
        }
    for (int axis = 0; axis < 3; ++axis) {
        const BlockGrid::Line& line = grid_.line(axis);
        along(axis, smooth, surface.gradient[axis], [&line](scalar below, scalar, scalar above, int place) {
            const int last = line.count() - 1;
            const scalar distance = line.centres[min(place + 1, last)] - line.centres[max(place - 1, 0)];
            return distance > 0 ? (above - below) / distance : scalar(0);
        });
    }
    return surface;
}

void RayTracing::follow(point position, BlockGrid::Index cell, scalar power, const Surface& surface,
                        std::vector<scalar>& absorbed) const
{
    vector direction(0, 0, -1);
    const scalar whole = power;
    for (int reflections = 0; reflections <= most_reflections;) {
        const std::size_t here = grid_.flat(cell);
        const vector slope(surface.gradient[0][here], surface.gradient[1][here], surface.gradient[2][here]);
        const scalar into = (direction & slope) / max(mag(slope), VSMALL);
        if (surface.fraction[here] >= 0.5 && into > 0) {
            const scalar share = fresnel_absorptivity(max(into, grazing_cosine), hagen_rubens_);
            const bool is_last = power * (1 - share) < negligible * whole || reflections == most_reflections;
            absorbed[here] += is_last ? power : share * power;
            if (is_last) return;
            power *= 1 - share;
            direction -= 2 * into * slope / mag(slope);
            direction /= mag(direction);
            ++reflections;
        }
        else if (surface.fraction[here] >= 0.99 && mag(slope) * scene_.spacing < 0.05) {
            absorbed[here] += power; // slipped past a surface cell at an edge, and is inside
            return;
        }
        if (!advance(position, direction, cell)) return;
    }
}

bool RayTracing::advance(point& position, vector& direction, BlockGrid::Index& cell) const
{
    int nearest = 0;
    scalar distance = GREAT;
    for (int axis = 0; axis < 3; ++axis) {
        if (mag(direction[axis]) < 1e-12) continue;
        const scalar face = grid_.line(axis).faces[cell[axis] + (direction[axis] > 0 ? 1 : 0)];
        const scalar to_face = max((face - position[axis]) / direction[axis], scalar(0));
        if (to_face < distance) {
            distance = to_face;
            nearest = axis;
        }
    }
    position += distance * direction;
    const int next = cell[nearest] + (direction[nearest] > 0 ? 1 : -1);
    if (next >= 0 && next < grid_.line(nearest).count()) {
        cell[nearest] = next;
        return true;
    }
    if (!mirrors_[nearest][direction[nearest] > 0 ? 1 : 0]) return false;
    direction[nearest] = -direction[nearest];
    return true;
}
} // namespace cupel
