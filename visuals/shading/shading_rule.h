#pragma once

#include "visuals/shading/intensity.h"
#include "visuals/shading/largest_keys.h"
#include "visuals/shading/reselection.h"
#include "visuals/shading/shaded_polygons.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::shading {

/// How polygons are ranked; the first g of the ranking are smooth.
enum class ShadingRule {
    Error, ///< Largest visible error of flat shading first.
    /// As the 2008 paper: corners that differ in intensity first, of these the large polygons first.
    Paper,
    Random ///< At random: the baseline that the other rules must beat.
};

/// The rule, and how strongly a choice is held on to while the eye moves.
struct ShadingRuleSettings {
    ShadingRule rule = ShadingRule::Error;
    /// Rule Paper: corner intensities (red + green + blue) that differ by no more than this count as equal.
    float threshold = 0.05F;
    std::uint64_t seed = 1; ///< Rule Random: which of the random rankings.
    /// Hysteresis, at least 1. The error of a polygon that is smooth already (Error), or the difference between its
    /// corners (Paper), is multiplied by this, so that it gives way only to a clearly better polygon.
    float hysteresis = 1.5F;
    /// The choice is made again when the eye has moved about the model's centre, or the light has turned, by more than
    /// this angle ...
    double reselect_rad = 0.03;
    /// ... or when the eye's distance has changed by more than this share of it.
    double reselect_distance = 0.05;
};

/// Settings with which every choice depends on eye and light of that call only: no hysteresis and no tolerance. For
/// measurements.
ShadingRuleSettings without_hysteresis(ShadingRule rule);

/// Six times the mean square of an error over a triangle, where the error is a, b and c at the corners and linear
/// between them.
inline float error_square(float a, float b, float c) { return a * a + b * b + c * c + a * b + b * c + c * a; }

/// Which polygons of a model are smooth, and how the choice came about.
struct ShadingChoice {
    std::span<const std::uint8_t> smooth; ///< One flag for each polygon: 1 = smooth, 0 = flat.
    int smooth_count = 0;
    int changed = 0;           ///< How many polygons this call changed; 0 for the first choice.
    bool was_reranked = false; ///< This call ranked the polygons again.
};

/// Chooses the smooth polygons of one drawn model and remembers the choice, so each drawn aircraft has its own
/// selector. It allocates nothing after its first few choices. The same sequence of calls gives the same choices.
class ShadingSelector {
public:
    /// `polygons` must outlive the selector.
    explicit ShadingSelector(const ShadedPolygons& polygons, const ShadingRuleSettings& settings = {});

    /// Makes exactly `smooth_count` polygons smooth (0 to the number of polygons, asserted). Eye and light are in the
    /// polygons' axes. The returned span is valid until the next call.
    ShadingChoice choose(const glm::dvec3& eye_m, const ShadingLight& light, int smooth_count);

    /// The last choice, one flag for each polygon; all are flat before the first choice.
    std::span<const std::uint8_t> smooth() const { return smooth_; }

private:
    void light_points(const glm::vec3& eye_m, const ShadingLight& light);
    std::uint32_t by_error(std::size_t polygon, const glm::vec3& eye_m, const ShadingLight& light) const;
    std::uint32_t by_paper(std::size_t polygon) const;
    void rank_all(const glm::vec3& eye_m, const ShadingLight& light);
    int take_best(int smooth_count);

    const ShadedPolygons* polygons_;
    ShadingRuleSettings settings_;
    std::vector<float> intensities_;  ///< One for each ShadingPoint.
    std::vector<std::uint32_t> keys_; ///< One sort key for each polygon, made by sort_key.
    LargestKeySelector largest_keys_;
    std::vector<std::uint8_t> smooth_;
    std::vector<std::uint8_t> next_; ///< The choice that is being made; swapped with smooth_.
    ViewAndLight last_view_;
    int smooth_count_ = 0;
    bool has_choice_ = false;
};

} // namespace octant::visuals::shading
