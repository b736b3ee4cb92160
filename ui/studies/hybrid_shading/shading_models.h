#pragma once

#include "models/triangle_mesh.h"
#include "visuals/shading/shaded_polygons.h"

#include <filesystem>
#include <string>
#include <vector>

namespace octant::ui::studies::hybrid_shading {

/// A model as the shading study looks at it.
struct ShadedModel {
    std::string name;
    visuals::shading::ShadedPolygons polygons;
};

/// A closed dented ball of `rings` x `slices` cells, two triangles each (one at its ends), whose
/// cells are up to some hundred times as large in one place as in another.
models::TriangleMesh uneven_ball(int rings, int slices);

/// The paper's torus in its 416 triangles, that of this program in 416 quads, f15, 500md, an uneven
/// ball of 9,118 triangles; mesh files (`more`), each as it is and refined for one eye. Throws
/// Error.
std::vector<ShadedModel> shading_models(const std::vector<std::filesystem::path>& more);

} // namespace octant::ui::studies::hybrid_shading
