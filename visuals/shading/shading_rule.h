#pragma once

#include "visuals/shading/intensity.h"
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

/// Which polygons of a model are smooth.
struct ShadingChoice {
    std::span<const std::uint8_t> smooth; ///< one a polygon: 1 = smooth, 0 = flat
    int smooth_count = 0;
    int changed = 0;   ///< polygons that changed by this call; 0 for the first choice
    bool anew = false; ///< this call looked at the polygons again
};

/// Chooses the smooth polygons of one drawn model and remembers the choice: one a drawn aircraft.
/// Allocates only in its constructor. Same calls, same choices.
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
    /// Polygons are wanted by (tier downwards, rank downwards, index upwards).
    struct Candidate {
        std::uint32_t tier = 0;
        float rank = 0.0F;
        std::uint32_t polygon = 0;
    };

    bool has_moved(const glm::dvec3& eye_m, const ShadingLight& light) const;
    void light_points(const glm::vec3& eye_m, const ShadingLight& light);
    Candidate
    by_error(std::uint32_t polygon, const glm::vec3& eye_m, const ShadingLight& light) const;
    Candidate by_paper(std::uint32_t polygon) const;
    void rank_all(const glm::vec3& eye_m, const ShadingLight& light);
    int take_best(int smooth_count);

    const ShadedPolygons* polygons_;
    ShadingRuleSettings settings_;
    std::vector<float> intensities_; ///< one a point
    std::vector<Candidate> candidates_;
    std::vector<std::uint8_t> smooth_;
    std::vector<std::uint8_t> next_;
    glm::dvec3 eye_m_{0.0};
    ShadingLight light_;
    int smooth_count_ = 0;
    bool chosen_ = false;
};

} // namespace octant::visuals::shading
