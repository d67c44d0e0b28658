/// When the mesh must be made anew: its fine cells are a box around beam and melt (moving_mesh.py), and the run may go
/// on in it as long as the melt and the beam's axis stay in the inner box that the case names.
#pragma once

#include "fields.hpp"

namespace cupel
{
class MeshWindow
{
public:
    /// Without the sub-dictionary `mesh_window` the mesh stays as it is.
    MeshWindow(const Scene& scene, const dictionary& entries);

    /// Whether a cell that the primary material fills by half holds melt outside the inner box, or the beam's axis has
    /// left it. The same on all ranks.
    bool is_left(const Fields& fields, scalar time) const;

private:
    const Scene& scene_;
    bool moves_;
    boundBox inner_, axis_range_;
};
} // namespace cupel
