#pragma once

#include "models/triangle_mesh.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/index_range.h"
#include "visuals/shading/shaded_polygons.h"

#include <span>
#include <vector>

namespace octant::visuals::planning {

/// A level of detail before it is made ready to be drawn.
struct MeshSource {
    /// Triangles to be drawn, in body axes.
    const models::TriangleMesh* mesh = nullptr;
    /// No point of it is farther than this from the original surface, nor the other way round.
    double error_m = 0.0;
};

/// A level of detail as drawn: a range of its model's index buffer.
struct MeshLevel {
    scene::IndexRange range;
    double error_m = 0.0;
    /// How its triangles are shaded.
    shading::ShadedPolygons shaded;
};

/// Appends a mesh to a model's buffers: corners that look the same share a vertex, but each triangle has a first corner
/// of its own. Normals are the mesh's own where it has any, else by crease angle. Loading work.
MeshLevel append_level(scene::ModelBuffers& buffers, const MeshSource& source);

/// Which of several representations, finest first, is drawn: the coarsest whose error is at most `max_m`, the finest
/// where none is. `before`, the one drawn last (negative: none), is kept while it is good enough and no coarser one is
/// by a margin, so that none changes to and fro. Errors rise, or stay.
int select_level(std::span<const double> errors_m, double max_m, int before);

} // namespace octant::visuals::planning
