#pragma once

#include "visuals/shading/shaded_polygons.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::shading {

/// The distances from the eye between which polygons turn from smooth to flat.
struct ShadingRange {
    double near_m = 0.0;   ///< Up to this distance all polygons are smooth.
    double far_m = 1000.0; ///< From this distance on all polygons are flat; above near_m.
    int levels = 0;        ///< The distance is rounded to so many steps, at least 2; 0 = not rounded.
};

/// g, how many of n polygons are smooth at a distance from the eye (section 3 of the paper): g = round((1 - d) n) with
/// d = clamp((distance - near) / (far - near), 0, 1). With levels, the nearest step is all smooth and the farthest all
/// flat.
int smooth_count(double distance_m, const ShadingRange& range, int polygons);

/// g for a device of relative speed r = `device_ratio`, 0 to 1, where 1 is the desktop that can shade everything
/// smoothly: as many smooth polygons as use up the operations that r of a frame with a share r of smooth polygons has,
/// g = round(r n (10 + 3 r) / 13). For r = 0.028 this gives the paper's 9 of 415.
int device_smooth_count(double device_ratio, int polygons);

/// One distant white light, and how surfaces reflect it. Directions are in the axes of the polygons that are lit.
struct ShadingLight {
    glm::vec3 to_light{0.0F, 0.0F, 1.0F}; ///< A unit vector towards the light.
    float ambient = 0.45F;                ///< The factor on the surface's colour everywhere.
    float diffuse = 0.65F;                ///< The factor on colour times cosine between normal and light.
    /// The factor on cosine^shininess between the mirrored light and the eye; the highlight is white.
    float specular = 0.25F;
    int shininess = 24; ///< The exponent of the highlight, at least 1.

    bool operator==(const ShadingLight&) const = default;
};

/// intensity() of a surface without a highlight (ambient + diffuse). `cosine` is that between the normal and the
/// direction to the light.
inline float diffuse_intensity(float cosine, float colour_sum, const ShadingLight& light) {
    return (light.ambient + light.diffuse * std::max(cosine, 0.0F)) * colour_sum;
}

/// Phong reflection at a point, summed over red, green and blue and not clamped to what a screen can show: ambient +
/// diffuse + specular. `normal` is a unit vector, `colour_sum` red + green + blue of the surface (each 0 to 1). A
/// surface that faces away from the light has its ambient part only.
float intensity(const glm::vec3& place_m, const glm::vec3& normal, float colour_sum, const ShadingLight& light,
    const glm::vec3& eye_m);

/// The eye and the light that a choice was made for, in the model's axes.
struct ViewAndLight {
    glm::dvec3 eye_m{0.0};
    ShadingLight light;
};

/// Packs a tier (0 to 3) and a rank (at least 0, finite) into one number, so that comparing keys compares first by tier
/// and then by rank. It uses that the bits of non-negative floats sort as integers do. The lowest bit of the rank is
/// lost: neighbouring floats may count as equal.
inline std::uint32_t sort_key(std::uint32_t tier, float rank) {
    return tier << 30U | std::bit_cast<std::uint32_t>(rank) >> 1U;
}

/// Finds the `count` greatest of many keys in linear time: a histogram over the keys' top bits finds the bucket in
/// which the boundary lies, and only that bucket is partially sorted. Its memory is reused from call to call.
class LargestKeySelector {
public:
    /// Sets `chosen`, which has as many entries as `keys`, to 1 for the `count` greatest keys and to 0 for the others.
    /// Of equal keys the one with the lower index is taken first, so that the result is always the same. `count` is at
    /// most the number of keys (asserted).
    void choose(std::span<const std::uint32_t> keys, std::size_t count, std::span<std::uint8_t> chosen);

private:
    /// A bucket has the tier, the exponent and the two top bits of the rank's fraction in common.
    static constexpr unsigned bucket_shift = 20;

    std::array<std::uint32_t, std::size_t{1} << (32U - bucket_shift)> counts_{};
    /// The indices of the keys in the one bucket that is chosen only in part.
    std::vector<std::uint32_t> border_;
};

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

/// Whether `now` differs from `before` by more than reselect_rad and reselect_distance allow, for a model with its
/// centre at `centre_m`. Any change of the light but its direction counts.
bool needs_reselection(const ViewAndLight& before, const ViewAndLight& now, const glm::dvec3& centre_m,
    const ShadingRuleSettings& settings);

/// Six times the mean square of an error over a triangle, where the error is a, b and c at the corners and linear
/// between them.
inline float error_square(float a, float b, float c) { return a * a + b * b + c * c + a * b + b * c + c * a; }

// The two rules as scores: the polygons with the greatest scores are smooth (LargestKeySelector). `was_smooth`: the
// last choice, which hysteresis favours.

/// The score by rule Error of a polygon that faces the eye. `on_screen`: its area on the screen over its own area, or
/// any number proportional to that; `error`: error_square() times area, summed over its triangles.
inline std::uint32_t error_score(const ShadingRuleSettings& settings, bool was_smooth, float on_screen, float error) {
    const float hysteresis = was_smooth ? settings.hysteresis : 1.0F;
    return sort_key(1, hysteresis * on_screen * error / 6.0F);
}

/// The score by rule Paper: the tier says whether the intensities of the corners, from `lowest` to `highest`, differ,
/// and whether the polygon is larger than the mean; the rank within the tier is the perimeter.
inline std::uint32_t paper_score(const ShadingRuleSettings& settings, bool was_smooth, float lowest, float highest,
    float perimeter_m, double mean_perimeter_m) {
    const float hysteresis = was_smooth ? settings.hysteresis : 1.0F;
    const bool differs = hysteresis * (highest - lowest) > settings.threshold;
    const bool is_large = perimeter_m > mean_perimeter_m;
    return sort_key(differs ? (is_large ? 2U : 1U) : 0U, perimeter_m);
}

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

    /// Forgets all choices, as a new selector.
    void forget_choices() {
        has_choice_ = false;
        std::ranges::fill(smooth_, std::uint8_t{0});
    }

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
