#pragma once

#include "visuals/shading/shaded_polygons.h"
#include "visuals/shading/shading_rule.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::shading {

/// A triangle mesh whose triangles may change from frame to frame, as a selectively refined mesh's do. Triangles sit in
/// numbered slots; a slot may be empty. Positions and normals are in the mesh's own axes.
struct DynamicMesh {
    std::span<const ShadingPoint> points;
    /// Three indices into `points` for each slot. A slot whose first two indices are equal is empty.
    std::span<const std::uint32_t> indices;
    /// One label for each slot. A triangle keeps its label as long as it exists; whatever fills its slot later has
    /// another label.
    std::span<const std::uint32_t> labels;
    std::size_t triangle_count = 0; ///< The number of slots that are not empty.
    /// A point near the middle of the mesh, the same in each frame; the eye's angle is measured about it.
    glm::vec3 centre_m{0.0F};
};

/// Chooses the smooth triangles of a mesh that changes from frame to frame. The scores are those of ShadingSelector,
/// which prepares the shapes of polygons that stay; here shapes are computed in each call, and all that is kept of a
/// triangle is whether it was smooth. Supports the rules Error and Paper. The time grows linearly with the triangles;
/// memory is reused, so that no call allocates once the arrays have reached their size.
class DynamicMeshSelector {
public:
    /// `settings.rule` must not be Random (asserted), because Random needs fixed polygon numbers.
    explicit DynamicMeshSelector(const ShadingRuleSettings& settings = {});

    /// Makes exactly `smooth_count` triangles smooth (0 to triangle_count, asserted). `eye_m` and `light` are in the
    /// mesh's axes. `changed` = false promises that the mesh has the same triangles as in the last call; then only eye,
    /// light and count are compared with those of the last choice. Returns whether the choice was made again, so that
    /// smooth() may differ from before.
    bool choose(const DynamicMesh& mesh, const glm::dvec3& eye_m, const ShadingLight& light, std::size_t smooth_count,
        bool changed);

    /// One flag for each slot: 1 = smooth (Gouraud), 0 = flat or empty.
    std::span<const std::uint8_t> smooth() const { return smooth_; }

    /// Forgets all choices, as a new selector.
    void forget_choices() {
        has_choice_ = false;
        labels_.clear();
        smooth_.clear();
    }

private:
    void light_points(const DynamicMesh& mesh);
    void keep_triangle_choices(const DynamicMesh& mesh);
    std::uint32_t by_error(const DynamicMesh& mesh, std::size_t slot, const glm::vec3& eye_m) const;
    std::uint32_t by_paper(const DynamicMesh& mesh, std::size_t slot) const;

    void measure_perimeters(const DynamicMesh& mesh);

    ShadingRuleSettings settings_;
    LargestKeySelector largest_keys_;
    ViewAndLight last_view_;
    bool has_choice_ = false;
    std::size_t smooth_count_ = 0;
    double mean_perimeter_m_ = 0.0;
    std::vector<float> intensities_;    ///< One for each of the mesh's points.
    std::vector<float> perimeters_m_;   ///< One for each slot, for the rule Paper only.
    std::vector<std::uint32_t> keys_;   ///< One sort key for each slot; see sort_key.
    std::vector<std::uint32_t> labels_; ///< The labels of the last call.
    std::vector<std::uint8_t> smooth_;
};

} // namespace octant::visuals::shading
