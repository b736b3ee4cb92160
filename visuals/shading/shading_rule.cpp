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

#include "models/smooth_normals.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace octant::visuals::shading {

// How many polygons are smooth, by distance and by the device's speed: H. Kim, H. Park, "A Hybrid Rendering Model to
// support LOD (Level of Detail)", 2008, sections 3 and 4.
//
// Deviations: the printed n = (1 - d) g + d f contradicts f + g = n and has a pole at d = 1/2; the text means g = (1 -
// d) n. The paper does not say how its relative speed 0.028 leads to "8 or 9" of 415 polygons; the formula here counts
// the operations of its table 2 and is ours.

namespace {

/// Selection and flat shading of one polygon, table 2.
constexpr double flat_operations = 9.0 + 1.0;
constexpr double smooth_operations = 9.0 + 4.0; ///< Selection and Gouraud shading of one polygon.

} // namespace

int smooth_count(double distance_m, const ShadingRange& range, int polygons) {
    assert(range.far_m > range.near_m && polygons >= 0);
    assert(range.levels == 0 || range.levels >= 2);
    double d = std::clamp((distance_m - range.near_m) / (range.far_m - range.near_m), 0.0, 1.0);
    if (range.levels > 0) {
        const double steps = range.levels - 1;
        d = std::round(d * steps) / steps;
    }
    return static_cast<int>(std::lround((1.0 - d) * polygons));
}

int device_smooth_count(double device_ratio, int polygons) {
    assert(device_ratio >= 0.0 && device_ratio <= 1.0 && polygons >= 0);
    const double operations_of_polygon = flat_operations + device_ratio * (smooth_operations - flat_operations);
    const double share = device_ratio * operations_of_polygon / smooth_operations;
    return static_cast<int>(std::lround(share * polygons));
}

// Phong reflection of Kim and Park's hybrid rendering model (2008), section 3: "ambient, diffuse and specular
// reflection for R, G and B, all summed to the intensity of a vertex". Deviations: the paper's text takes the polygon's
// normal at its vertices, which makes their intensities nearly the same; here the caller brings a normal, that of the
// vertex for corners.

namespace {

/// base^exponent by repeated squaring. std::pow may differ in its last bits from library to library; this gives the
/// same bits everywhere, and so the same choices.
float whole_power(float base, int exponent) {
    float power = 1.0F;
    for (; exponent > 0; exponent /= 2) {
        power *= exponent % 2 == 1 ? base : 1.0F;
        base *= base;
    }
    return power;
}

} // namespace

float intensity(const glm::vec3& place_m, const glm::vec3& normal, float colour_sum, const ShadingLight& light,
    const glm::vec3& eye_m) {
    assert(light.shininess >= 1);
    const float cosine = glm::dot(normal, light.to_light);
    if (cosine <= 0.0F || light.specular <= 0.0F) { return diffuse_intensity(cosine, colour_sum, light); }
    const glm::vec3 mirrored = 2.0F * cosine * normal - light.to_light;
    const glm::vec3 to_eye = eye_m - place_m;
    const float towards_eye = glm::dot(mirrored, to_eye);
    float specular = 0.0F;
    if (towards_eye > 0.0F) {
        specular = light.specular * whole_power(towards_eye / glm::length(to_eye), light.shininess);
    }
    return diffuse_intensity(cosine, colour_sum, light) + 3.0F * specular;
}

// When to choose again. Intensities change little while eye and light turn by a small angle about the model, so a
// choice is kept until the tolerance is exceeded. This saves the selection (9 operations a polygon in the 2008 paper's
// count) in most frames and keeps polygons from flickering between flat and smooth.

bool needs_reselection(const ViewAndLight& before, const ViewAndLight& now, const glm::dvec3& centre_m,
    const ShadingRuleSettings& settings) {
    if (now.eye_m == before.eye_m && now.light == before.light) { return false; }
    ShadingLight turned = before.light;
    turned.to_light = now.light.to_light;
    if (turned != now.light ||
        models::angle_rad(glm::dvec3(now.light.to_light), glm::dvec3(before.light.to_light)) > settings.reselect_rad) {
        return true;
    }
    const glm::dvec3 before_m = before.eye_m - centre_m;
    const glm::dvec3 now_m = now.eye_m - centre_m;
    const double farther_m = std::abs(glm::length(now_m) - glm::length(before_m));
    return farther_m > settings.reselect_distance * glm::length(before_m) ||
           models::angle_rad(before_m, now_m) > settings.reselect_rad;
}

// Selection of the greatest keys by counting: one pass fills a histogram over the keys' top 12 bits, a scan from the
// top finds the bucket in which the count is reached, and std::nth_element orders that bucket only.

void LargestKeySelector::choose(
    std::span<const std::uint32_t> keys, std::size_t count, std::span<std::uint8_t> chosen) {
    assert(count <= keys.size() && chosen.size() == keys.size());
    if (count == 0 || count == keys.size()) {
        std::ranges::fill(chosen, count == 0 ? std::uint8_t{0} : std::uint8_t{1});
        return;
    }
    counts_.fill(0);
    for (const std::uint32_t key : keys) { ++counts_[key >> bucket_shift]; }
    std::size_t bucket = counts_.size() - 1;
    std::size_t left = count; // How many of the chosen keys lie in this bucket and below.
    while (counts_[bucket] < left) { left -= counts_[bucket--]; }
    border_.clear();
    for (std::uint32_t i = 0; i < keys.size(); ++i) {
        const std::size_t own = keys[i] >> bucket_shift;
        chosen[i] = own > bucket ? 1 : 0;
        if (own == bucket) { border_.push_back(i); }
    }
    const auto last = border_.begin() + static_cast<std::ptrdiff_t>(left);
    if (last != border_.end()) {
        std::ranges::nth_element(border_, last,
            [&](std::uint32_t a, std::uint32_t b) { return keys[a] != keys[b] ? keys[a] > keys[b] : a < b; });
    }
    std::for_each(border_.begin(), last, [&](std::uint32_t i) { chosen[i] = 1; });
}

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

/// error_score() of a polygon, less for one that faces away.
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
    return error_score(settings_, smooth_[polygon] != 0, on_screen, error);
}

/// paper_score() of a polygon.
std::uint32_t ShadingSelector::by_paper(std::size_t polygon) const {
    const ShadedPolygon& shape = polygons_->polygons[polygon];
    float lowest = intensities_[polygons_->corner_points[shape.first_corner]];
    float highest = lowest;
    for (std::uint32_t k = 1; k < shape.corner_count; ++k) {
        const float here = intensities_[polygons_->corner_points[shape.first_corner + k]];
        lowest = std::min(lowest, here);
        highest = std::max(highest, here);
    }
    return paper_score(
        settings_, smooth_[polygon] != 0, lowest, highest, shape.perimeter_m, polygons_->mean_perimeter_m);
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
    const bool moved = !has_choice_ || needs_reselection(last_view_, look, glm::dvec3(polygons_->centre_m), settings_);
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
