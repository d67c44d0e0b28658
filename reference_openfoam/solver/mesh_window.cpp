#include "mesh_window.hpp"

namespace cupel
{
MeshWindow::MeshWindow(const Scene& scene, const dictionary& entries)
    : scene_(scene), moves_(scene.physics.laser && entries.found("mesh_window"))
{
    if (!moves_) return;
    const dictionary& window = entries.subDict("mesh_window");
    inner_ = boundBox(window.get<point>("melt_lower"), window.get<point>("melt_upper"));
    axis_range_ = boundBox(window.get<point>("axis_lower"), window.get<point>("axis_upper"));
}

bool MeshWindow::is_left(const Fields& fields, scalar time) const
{
    if (!moves_) return false;
    if (scene_.laser->is_on(time) && !axis_range_.contains(scene_.laser->axis(time))) return true;
    bool left = false;
    const vectorField& centres = fields.mesh.C();
    forAll (centres, cell)
        left = left || (fields.fraction[cell] >= 0.5 && fields.heat->temperature[cell] >= scene_.primary.solidus &&
                        !inner_.contains(centres[cell]));
    return returnReduce(left, orOp<bool>());
}
} // namespace cupel
