#pragma once

#include "visuals/shading/greatest_keys.h"
#include "visuals/shading/remembered_look.h"
#include "visuals/shading/shaded_polygons.h"
#include "visuals/shading/shading_rule.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::shading {

/// A mesh of triangles that is another one in each frame.
struct ChangingMesh {
    std::span<const LitPoint> points;
    /// Three a place, into `points`; a place whose first two are equal has no triangle.
    std::span<const std::uint32_t> indices;
    /// One a place: a triangle that stays where it is keeps it, another one there has another.
    std::span<const std::uint32_t> labels;
    std::size_t triangle_count = 0; ///< places with a triangle
    glm::vec3 centre_m{0.0F};       ///< about the middle, the same in each frame
};

/// Chooses the smooth triangles of a mesh that changes: as ShadingSelector does, but nothing of a
/// triangle is kept from frame to frame but whether it was smooth. Rules Error and Paper. Time
/// grows with the triangles; keeps its memory.
class ChangingMeshSelector {
public:
    /// `settings.rule` is not Random (asserted).
    explicit ChangingMeshSelector(const ShadingRuleSettings& settings = {});

    /// Exactly `smooth_count` smooth ones, from 0 to triangle_count. Without `changed` the mesh has
    /// the triangles that it had in the last call, and nothing is looked at but eye, light and
    /// count. Returns whether any triangle may be chosen otherwise than before.
    bool choose(
        const ChangingMesh& mesh,
        const glm::dvec3& eye_m,
        const ShadingLight& light,
        std::size_t smooth_count,
        bool changed);

    /// One a place: 1 = smooth, 0 = flat, or there is no triangle.
    std::span<const std::uint8_t> smooth() const { return smooth_; }

private:
    void light_points(const ChangingMesh& mesh);
    void hold_places(const ChangingMesh& mesh);
    std::uint32_t
    by_error(const ChangingMesh& mesh, std::size_t place, const glm::vec3& eye_m) const;
    std::uint32_t by_paper(const ChangingMesh& mesh, std::size_t place) const;

    float hold_of(std::size_t place) const { return smooth_[place] != 0 ? settings_.hold : 1.0F; }

    void measure_perimeters(const ChangingMesh& mesh);

    ShadingRuleSettings settings_;
    GreatestKeys greatest_;
    RememberedLook look_;
    bool chosen_ = false;
    std::size_t smooth_count_ = 0;
    double mean_perimeter_m_ = 0.0;
    std::vector<float> intensities_;  ///< one a point
    std::vector<float> perimeters_m_; ///< one a place, rule Paper
    std::vector<std::uint32_t> keys_; ///< one a place
    std::vector<std::uint32_t> labels_;
    std::vector<std::uint8_t> smooth_;
};

} // namespace octant::visuals::shading
