#pragma once

#include "ui/terrain/mesh_maker.h"
#include "visuals/terrain/projected_error.h"

namespace octant::ui::terrain {

/// A mesh and how far it misses the ground.
struct MeasuredMesh {
    int triangles = 0;
    int triangles_in_view = 0; ///< not wholly outside the frustum
    double coarseness = 0.0;   ///< as MeshMaker::mesh takes it
    visuals::terrain::ProjectedError error;
};

/// The coarsest mesh found by bisection whose 99.9th percentile of the error is at most
/// `target_px`; the finest there is where none is.
MeasuredMesh coarsest_mesh_within(
    MeshMaker& maker,
    visuals::terrain::ProjectedErrorMeter& meter,
    const visuals::terrain::MeshView& view,
    const visuals::terrain::PerspectiveView& picture,
    double target_px);

} // namespace octant::ui::terrain
