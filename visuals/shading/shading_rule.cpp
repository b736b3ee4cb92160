// Which polygons are smooth: H. Kim, H. Park, "A Hybrid Rendering Model to support LOD (Level of Detail)", 2008,
// section 3, is the rule Paper; the rule Error is ours. Both light every ShadingPoint, give each polygon a sort key,
// and make the g greatest keys smooth.
//
// Error: let d1, d2, d3 be the differences between the intensities at a triangle's corners and the intensity of its
// flat colour, with linear interpolation between. The square of the error that flat shading makes then has the mean
// (d1^2 + d2^2 + d3^2 + d1 d2 + d2 d3 + d3 d1) / 6. Times the projected area it is what this polygon adds to the
// picture's squared error against all-Gouraud shading; making the g largest smooth removes the most. Polygons with more
// corners are fans of triangles. Polygons that face away from the eye add nothing.
//
// Deviations (Paper): the text prints a loop whose two counters end it in file order, sizes that are sorted but never
// used, and polygons beyond g or f that get no shading at all. Here the order is: first polygons whose corners differ
// by more than the threshold and whose perimeter exceeds the mean, then the other ones whose corners differ, then the
// rest; within each group by perimeter, then by index. The first g are smooth.
#include "visuals/shading/shading_rule.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace octant::visuals::shading {

namespace {

/// A hash of 64 bits (the last step of SplitMix64).
std::uint64_t mixed(std::uint64_t bits) {
    bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebULL;
    return bits ^ (bits >> 31U);
}

} // namespace

ShadingRuleSettings without_hysteresis(ShadingRule rule) {
    return {.rule = rule, .hysteresis = 1.0F, .reselect_rad = 0.0, .reselect_distance = 0.0};
}

ShadingSelector::ShadingSelector(const ShadedPolygons& polygons, const ShadingRuleSettings& settings)
    : polygons_(&polygons), settings_(settings), intensities_(polygons.points.size()), keys_(polygons.size()),
      smooth_(polygons.size()), next_(polygons.size()) {
    assert(settings.hysteresis >= 1.0F);
    assert(settings.reselect_rad >= 0.0 && settings.reselect_distance >= 0.0);
}

void ShadingSelector::light_points(const glm::vec3& eye_m, const ShadingLight& light) {
    for (std::size_t i = 0; i < intensities_.size(); ++i) {
        const ShadingPoint& point = polygons_->points[i];
        intensities_[i] = intensity(point.place_m, point.normal, point.colour_sum, light, eye_m);
    }
}

/// The key by rule Error: tier 0 for polygons that face away, else tier 1 ranked by error times projected area.
std::uint32_t ShadingSelector::by_error(std::size_t polygon, const glm::vec3& eye_m, const ShadingLight& light) const {
    const ShadedPolygon& shape = polygons_->polygons[polygon];
    const glm::vec3 to_eye_m = eye_m - shape.centre_m;
    const float in_front_m = glm::dot(to_eye_m, shape.normal);
    if (in_front_m <= 0.0F) { return sort_key(0, 0.0F); }
    const float flat = intensity(shape.centre_m, shape.normal, shape.colour_sum, light, eye_m);
    const std::uint32_t* const points = &polygons_->corner_points[shape.first_corner];
    const float* const fan_m2 = &polygons_->fan_m2[shape.first_corner];
    const float first = intensities_[points[0]] - flat;
    float error = 0.0F;
    for (std::uint32_t k = 1; k + 1 < shape.corner_count; ++k) {
        const float here = intensities_[points[k]] - flat;
        const float next = intensities_[points[k + 1]] - flat;
        error += fan_m2[k] * error_square(first, here, next);
    }
    const float distance_m = glm::length(to_eye_m);
    const float on_screen = in_front_m / (distance_m * distance_m * distance_m);
    const float hysteresis = smooth_[polygon] != 0 ? settings_.hysteresis : 1.0F;
    return sort_key(1, hysteresis * on_screen * error / 6.0F);
}

/// The key by rule Paper: the tier says whether the corners differ and whether the polygon is large; its rank within
/// the tier is its perimeter.
std::uint32_t ShadingSelector::by_paper(std::size_t polygon) const {
    const ShadedPolygon& shape = polygons_->polygons[polygon];
    float least = intensities_[polygons_->corner_points[shape.first_corner]];
    float most = least;
    for (std::uint32_t k = 1; k < shape.corner_count; ++k) {
        const float here = intensities_[polygons_->corner_points[shape.first_corner + k]];
        least = std::min(least, here);
        most = std::max(most, here);
    }
    const float hysteresis = smooth_[polygon] != 0 ? settings_.hysteresis : 1.0F;
    const bool differs = hysteresis * (most - least) > settings_.threshold;
    const bool is_large = shape.perimeter_m > polygons_->mean_perimeter_m;
    return sort_key(differs ? (is_large ? 2U : 1U) : 0U, shape.perimeter_m);
}

void ShadingSelector::rank_all(const glm::vec3& eye_m, const ShadingLight& light) {
    for (std::size_t i = 0; i < keys_.size(); ++i) {
        switch (settings_.rule) {
        case ShadingRule::Error:
            keys_[i] = by_error(i, eye_m, light);
            break;
        case ShadingRule::Paper:
            keys_[i] = by_paper(i);
            break;
        case ShadingRule::Random:
            keys_[i] =
                static_cast<std::uint32_t>(mixed(mixed(settings_.seed) + 0x9e3779b97f4a7c15ULL * (i + 1)) >> 32U);
            break;
        }
    }
}

/// Makes the polygons with the greatest keys smooth. Returns how many polygons changed.
int ShadingSelector::take_best(int smooth_count) {
    largest_keys_.choose(keys_, static_cast<std::size_t>(smooth_count), next_);
    int changed = 0;
    for (std::size_t i = 0; i < next_.size(); ++i) { changed += next_[i] != smooth_[i] ? 1 : 0; }
    std::swap(smooth_, next_);
    return changed;
}

ShadingChoice ShadingSelector::choose(const glm::dvec3& eye_m, const ShadingLight& light, int smooth_count) {
    assert(smooth_count >= 0 && static_cast<std::size_t>(smooth_count) <= polygons_->size());
    const ViewAndLight look{eye_m, light};
    const ReselectionTolerance tolerance{settings_.reselect_rad, settings_.reselect_distance};
    const bool moved = !has_choice_ || needs_reselection(last_view_, look, glm::dvec3(polygons_->centre_m), tolerance);
    if (!moved && smooth_count == smooth_count_) { return {.smooth = smooth_, .smooth_count = smooth_count}; }
    if (moved) {
        last_view_ = look;
        light_points(glm::vec3(eye_m), light);
    }
    rank_all(glm::vec3(last_view_.eye_m), last_view_.light);
    const int changed = take_best(smooth_count);
    smooth_count_ = smooth_count;
    return {.smooth = smooth_,
        .smooth_count = smooth_count,
        .changed = std::exchange(has_choice_, true) ? changed : 0,
        .was_reranked = true};
}

} // namespace octant::visuals::shading
