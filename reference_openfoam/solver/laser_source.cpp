#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "gaussian_beam.hpp"
#include "laser_source.hpp"

namespace cupel
{
LaserSource::LaserSource(const Scene& scene, const fvMesh& mesh)
    : scene_(scene), mesh_(mesh), power_density_(IOobject("laser_power_density", mesh.time().timeName(), mesh,
                                                          IOobject::NO_READ, IOobject::NO_WRITE),
                                                 mesh, dimensionedScalar(dimPower / dimVolume, Zero))
{
    if (scene.numerics.getOrDefault<bool>("ray_tracing", false)) {
        rays_.reset(new RayTracing(scene, mesh));
        return;
    }
    // cells of one column share their footprint; a thousandth of the spacing tells columns apart
    const scalar resolution = 1e-3 * scene.spacing;
    std::map<std::pair<long, long>, std::size_t> index;
    forAll (mesh.C(), cell) {
        const point& centre = mesh.C()[cell];
        const std::pair<long, long> key(std::lround(centre.x() / resolution), std::lround(centre.y() / resolution));
        const auto found = index.insert(std::make_pair(key, columns_.size()));
        if (found.second) {
            const boundBox box(mesh.points(), mesh.cellPoints()[cell], false);
            columns_.push_back({box.min().x(), box.max().x(), box.min().y(), box.max().y(), {}});
        }
        columns_[found.first->second].cells.push_back(cell);
    }
    const vectorField& centres = mesh.C().primitiveField();
    for (Column& column : columns_)
        std::sort(column.cells.begin(), column.cells.end(),
                  [&centres](label one, label two) { return centres[one].z() > centres[two].z(); });
}

LaserPower LaserSource::update(scalar time, const volScalarField& fraction)
{
    scalarField& density = power_density_.primitiveFieldRef();
    density = 0;
    LaserPower power;
    const LaserPath& laser = *scene_.laser;
    if (!laser.is_on(time)) return power;
    power.emitted = laser.power;
    const point axis = laser.axis(time);
    if (rays_.valid()) {
        power.expected = rays_->absorb(axis, fraction, density);
        power.absorbed = volume_integral(density, mesh_);
        return power;
    }
    std::vector<scalar> shares;
    for (const Column& column : columns_) {
        const scalar footprint =
            gaussian_share(column.x_lower - axis.x(), column.x_upper - axis.x(), laser.spot_radius) *
            gaussian_share(column.y_lower - axis.y(), column.y_upper - axis.y(), laser.spot_radius);
        if (footprint < 1e-12) continue;
        shares.clear();
        scalar spent = 0, above = 0;
        for (std::size_t row = 0; row < column.cells.size() && spent < 1; ++row) {
            // 2α times the central difference of α over a cell: its part of the drop of 1 of α² across the surface
            const scalar here = min(max(fraction[column.cells[row]], scalar(0)), scalar(1));
            const scalar below = row + 1 < column.cells.size() ? max(fraction[column.cells[row + 1]], scalar(0)) : here;
            const scalar share = min(here * max(below - above, scalar(0)), 1 - spent);
            shares.push_back(share);
            spent += share;
            above = here;
        }
        if (spent < 0.5) continue;
        const scalar column_power = laser.absorptivity * laser.power * footprint;
        power.expected += column_power;
        for (std::size_t row = 0; row < shares.size(); ++row)
            density[column.cells[row]] = column_power * shares[row] / spent / mesh_.V()[column.cells[row]];
    }
    reduce(power.expected, sumOp<scalar>());
    power.absorbed = volume_integral(density, mesh_);
    return power;
}
} // namespace cupel
