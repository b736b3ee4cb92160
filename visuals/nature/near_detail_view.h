#pragma once

#include "visuals/terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <optional>

namespace octant::visuals::nature {

/// Edges of the ground that are shorter stay whole; over the distance of samples.
inline constexpr float min_split_edge_ratio = 1.0F / 24.0F;

/// The most by which the middle of an edge is moved, over the distance of samples.
inline constexpr double max_offset_ratio = 0.06;

/// From where ground is looked at, and how finely it is sampled.
struct NearDetailView {
    glm::dvec3 eye_m{0.0}; ///< world axes
    double spacing_m = 30.0;
    terrain::PaintOrder order = terrain::PaintOrder::BackToFront;
    /// Unit normals of planes through the eye, world axes, that point inside: what lies outside one is not halved. Zero
    /// = no plane.
    std::array<glm::vec3, 4> frustum_normals{glm::vec3(0.0F), glm::vec3(0.0F), glm::vec3(0.0F), glm::vec3(0.0F)};
    std::size_t max_splits = 2000;            ///< triangles that may be added to the ground in a frame
    std::size_t max_scenery_triangles = 5000; ///< triangles of what stands on it
    float min_edge_rad = 0.08F;               ///< edges of the ground that look shorter stay whole
    float range_ratio = 1.0F;                 ///< of the distance to which things stand
};

/// What is added to the mesh near the eye.
struct NearDetailOptions {
    bool has_subdivision = true;
    bool scenery = true;

    bool operator==(const NearDetailOptions&) const = default;
};

/// For how much detail there is room, and how much there is to see.
struct DetailBudget {
    /// Of the usual number of triangles, which is 20,000. Nothing: there is no limit.
    std::optional<double> share = 1.0;
    double width_rad = 1.4;             ///< of the picture
    double focal_px = 869.0;            ///< pixels that a metre covers straight ahead, one metre off
    double height_above_ground_m = 0.0; ///< the eye over the ground
};

/// Sets how long edges look that are halved, how far things stand, and the numbers of both, so that these limits are
/// hardly ever met: what they cut off would appear in a step. Without a limit of triangles the width of the picture
/// counts for nothing: pictures from one eye through lenses of one `focal_px` show the same ground wherever they
/// overlap or meet.
void apply_detail_budget(const DetailBudget& budget, const NearDetailOptions& detail, NearDetailView& view);

} // namespace octant::visuals::nature
