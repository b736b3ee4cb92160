// Which triangles of a selectively refined mesh are smooth. The rules are those of shading_rule.cpp (H. Kim, H. Park,
// "A Hybrid Rendering Model to support LOD (Level of Detail)", 2008, section 3; the rule Error is ours), for meshes
// whose triangles change from frame to frame, so that nothing can be prepared when a model is loaded.
//
// Everything is computed from the corners in each call: a triangle costs a cross product and, where it faces the eye,
// two square roots. Each vertex is lit once, and the greatest keys are found by counting.
//
// Deviations: those of shading_rule.cpp. The flat colour is the mean of the corners' colours, as the renderer draws it.
#include "visuals/shading/dynamic_mesh_shading.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>

namespace octant::visuals::shading {

namespace {

/// The key of an empty slot; it is never chosen, because there are at least as many triangles as smooth ones.
constexpr std::uint32_t no_triangle = 0;
constexpr std::uint32_t min_key = 1; ///< The least key of a slot that has a triangle.

} // namespace

DynamicMeshSelector::DynamicMeshSelector(const ShadingRuleSettings& settings) : settings_(settings) {
    assert(settings.rule != ShadingRule::Random && settings.hysteresis >= 1.0F);
}

void DynamicMeshSelector::light_points(const DynamicMesh& mesh) {
    const glm::vec3 eye_m(last_view_.eye_m);
    const bool glossy = last_view_.light.specular > 0.0F;
    intensities_.resize(mesh.points.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const ShadingPoint& point = mesh.points[i];
        intensities_[i] = glossy ? intensity(point.place_m, point.normal, point.colour_sum, last_view_.light, eye_m)
                                 : diffuse_intensity(glm::dot(point.normal, last_view_.light.to_light),
                                       point.colour_sum, last_view_.light);
    }
}

/// Carries the smooth flags over from the last mesh: a flag stays where the slot still has the same label, and is
/// cleared elsewhere.
void DynamicMeshSelector::keep_triangle_choices(const DynamicMesh& mesh) {
    const std::size_t before = std::min(labels_.size(), mesh.labels.size());
    for (std::size_t slot = 0; slot < before; ++slot) {
        smooth_[slot] = labels_[slot] == mesh.labels[slot] ? smooth_[slot] : std::uint8_t{0};
    }
    labels_.assign(mesh.labels.begin(), mesh.labels.end());
    smooth_.resize(mesh.labels.size(), 0);
}

std::uint32_t DynamicMeshSelector::by_error(const DynamicMesh& mesh, std::size_t slot, const glm::vec3& eye_m) const {
    const std::uint32_t* const corners = &mesh.indices[3 * slot];
    const ShadingPoint& a = mesh.points[corners[0]];
    const ShadingPoint& b = mesh.points[corners[1]];
    const ShadingPoint& c = mesh.points[corners[2]];
    const glm::vec3 doubled_m2 = glm::cross(b.place_m - a.place_m, c.place_m - a.place_m);
    const glm::vec3 centre_m = (a.place_m + b.place_m + c.place_m) / 3.0F;
    const glm::vec3 to_eye_m = eye_m - centre_m;
    // Twice the area times the eye's height above the plane; negative behind the triangle.
    const float in_front_m3 = glm::dot(doubled_m2, to_eye_m);
    const float size_m2 = glm::length(doubled_m2);
    if (!(in_front_m3 > 0.0F) || !(size_m2 > 0.0F)) { return min_key; }
    const float colour_sum = (a.colour_sum + b.colour_sum + c.colour_sum) / 3.0F;
    const ShadingLight& light = last_view_.light;
    const float flat = light.specular > 0.0F
                           ? intensity(centre_m, doubled_m2 / size_m2, colour_sum, light, eye_m)
                           : diffuse_intensity(glm::dot(doubled_m2, light.to_light) / size_m2, colour_sum, light);
    const float error =
        error_square(intensities_[corners[0]] - flat, intensities_[corners[1]] - flat, intensities_[corners[2]] - flat);
    const float distance_m = glm::length(to_eye_m);
    const float on_screen = 0.5F * in_front_m3 / (distance_m * distance_m * distance_m);
    return error_score(settings_, smooth_[slot] != 0, on_screen, error);
}

std::uint32_t DynamicMeshSelector::by_paper(const DynamicMesh& mesh, std::size_t slot) const {
    const std::uint32_t* const corners = &mesh.indices[3 * slot];
    const auto [lowest, highest] =
        std::minmax({intensities_[corners[0]], intensities_[corners[1]], intensities_[corners[2]]});
    return std::max(
        paper_score(settings_, smooth_[slot] != 0, lowest, highest, perimeters_m_[slot], mean_perimeter_m_), min_key);
}

void DynamicMeshSelector::measure_perimeters(const DynamicMesh& mesh) {
    perimeters_m_.resize(mesh.labels.size());
    double sum_m = 0.0;
    for (std::size_t slot = 0; slot < perimeters_m_.size(); ++slot) {
        const glm::vec3& a_m = mesh.points[mesh.indices[3 * slot]].place_m;
        const glm::vec3& b_m = mesh.points[mesh.indices[3 * slot + 1]].place_m;
        const glm::vec3& c_m = mesh.points[mesh.indices[3 * slot + 2]].place_m;
        perimeters_m_[slot] = glm::distance(a_m, b_m) + glm::distance(b_m, c_m) + glm::distance(c_m, a_m);
        sum_m += perimeters_m_[slot];
    }
    mean_perimeter_m_ = sum_m / static_cast<double>(std::max(mesh.triangle_count, std::size_t{1}));
}

bool DynamicMeshSelector::choose(const DynamicMesh& mesh, const glm::dvec3& eye_m, const ShadingLight& light,
    std::size_t smooth_count, bool changed) {
    assert(mesh.indices.size() == 3 * mesh.labels.size());
    assert(smooth_count <= mesh.triangle_count && mesh.triangle_count <= mesh.labels.size());
    const ViewAndLight look{eye_m, light};
    const bool moved = !has_choice_ || needs_reselection(last_view_, look, glm::dvec3(mesh.centre_m), settings_);
    if (!moved && !changed && smooth_count == smooth_count_) { return false; }
    last_view_ = moved ? look : last_view_;
    smooth_count_ = smooth_count;
    has_choice_ = true;
    keep_triangle_choices(mesh);
    light_points(mesh);
    if (settings_.rule == ShadingRule::Paper) { measure_perimeters(mesh); }
    keys_.resize(mesh.labels.size());
    const glm::vec3 from_m(last_view_.eye_m);
    for (std::size_t slot = 0; slot < keys_.size(); ++slot) {
        const bool is_triangle = mesh.indices[3 * slot] != mesh.indices[3 * slot + 1];
        keys_[slot] = !is_triangle                           ? no_triangle
                      : settings_.rule == ShadingRule::Paper ? by_paper(mesh, slot)
                                                             : by_error(mesh, slot, from_m);
    }
    largest_keys_.choose(keys_, smooth_count, smooth_);
    return true;
}

} // namespace octant::visuals::shading
