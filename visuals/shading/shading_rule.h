#pragma once

#include "visuals/shading/greatest_keys.h"
#include "visuals/shading/intensity.h"
#include "visuals/shading/remembered_look.h"
#include "visuals/shading/shaded_polygons.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::shading {

enum class ShadingRule {
    Error, ///< where flat shading would be wrong by most in the picture
    Paper, ///< differing corners first, large ones before small ones
    Random ///< any: what the others must beat
};

struct ShadingRuleSettings {
    ShadingRule rule = ShadingRule::Error;
    /// Paper: intensities that differ by no more than this (red + green + blue) count as equal.
    float threshold = 0.05F;
    std::uint64_t seed = 1; ///< Random
    /// A polygon that is smooth counts as so many times as wrong (Error), its corners as so many
    /// times as different (Paper), so that it gives way only to a clearly better one; at least 1.
    float hold = 1.5F;
    /// The choice is looked at again when the eye has moved about the model's middle, or the light
    /// has turned, by more than this.
    double reselect_rad = 0.03;
    /// Or the eye is farther or nearer by more than this share of its distance.
    double reselect_distance = 0.05;
};

/// Every call with new eye and light is looked at, and nothing of the last choice is held.
ShadingRuleSettings without_memory(ShadingRule rule);

/// Six times the mean square of a triangle's error where its corners are off by a, b and c and
/// points between by straight lines.
inline float error_square(float a, float b, float c) {
    return a * a + b * b + c * c + a * b + b * c + c * a;
}

/// Which polygons of a model are smooth.
struct ShadingChoice {
    std::span<const std::uint8_t> smooth; ///< one a polygon: 1 = smooth, 0 = flat
    int smooth_count = 0;
    int changed = 0;   ///< polygons that changed by this call; 0 for the first choice
    bool anew = false; ///< this call looked at the polygons again
};

/// Chooses the smooth polygons of one drawn model and remembers the choice: one a drawn aircraft.
/// No allocation once it has chosen a few times. Same calls, same choices.
class ShadingSelector {
public:
    /// `polygons` stay where they are as long as the selector.
    explicit ShadingSelector(
        const ShadedPolygons& polygons, const ShadingRuleSettings& settings = {});

    /// Exactly `smooth_count` smooth ones (from 0 to the number of polygons). Eye and light are in
    /// the polygons' axes. The choice is valid until the next call.
    ShadingChoice choose(const glm::dvec3& eye_m, const ShadingLight& light, int smooth_count);

    /// The last choice; all flat before the first.
    std::span<const std::uint8_t> smooth() const { return smooth_; }

private:
    void light_points(const glm::vec3& eye_m, const ShadingLight& light);
    std::uint32_t
    by_error(std::size_t polygon, const glm::vec3& eye_m, const ShadingLight& light) const;
    std::uint32_t by_paper(std::size_t polygon) const;
    void rank_all(const glm::vec3& eye_m, const ShadingLight& light);
    int take_best(int smooth_count);

    const ShadedPolygons* polygons_;
    ShadingRuleSettings settings_;
    std::vector<float> intensities_;  ///< one a point
    std::vector<std::uint32_t> keys_; ///< one a polygon, key_of
    GreatestKeys greatest_;
    std::vector<std::uint8_t> smooth_;
    std::vector<std::uint8_t> next_;
    RememberedLook look_;
    int smooth_count_ = 0;
    bool chosen_ = false;
};

} // namespace octant::visuals::shading
