#pragma once

#include "ui/terrain/ground_view.h"
#include "ui/terrain/mesh_maker.h"
#include "visuals/scene/camera.h"
#include "visuals/terrain/ground_samples.h"

#include <cstdint>
#include <optional>

namespace octant::ui::terrain {

/// A look at a ground and how fine its mesh is to be.
struct RandomView {
    visuals::scene::Camera camera;
    std::optional<int> triangles; ///< else coarseness decides
    double coarseness = 0.0;      ///< as MeshMaker::mesh takes it
};

/// View `number` of a seed: over the map or, three in ten, beside it, 2 m to 20 km above the
/// ground, in any direction between straight down and 30 degrees up, fields of view of 5 to 100
/// degrees; meshes of 100 to 60,000 triangles, of C from 2 to 64 or of errors from 0.25 to 32
/// pixels. Depends on nothing else.
RandomView random_view(
    const visuals::terrain::GroundSamples& ground,
    bool by_error,
    std::uint64_t seed,
    std::uint64_t number);

} // namespace octant::ui::terrain
