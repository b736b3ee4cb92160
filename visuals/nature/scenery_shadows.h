#pragma once

#include "models/colour_vertex.h"
#include "visuals/nature/daylight.h"
#include "visuals/nature/ground_decoration.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace octant::visuals::nature {

/// What casts a shadow: an upright ellipsoid on the ground.
struct ShadowCaster {
    glm::vec3 foot_m{0.0F}; ///< world axes with the eye subtracted
    glm::vec2 slope{0.0F};  ///< of the ground on which it stands, metres up a metre east and north
    float radius_m = 1.0F;
    float height_m = 1.0F;
    float strength = 1.0F;         ///< 1: all sunlight is taken away; 0: none
    float taper = 0.0F;            ///< how much narrower the shadow is at its end than in its middle, 0..1
    float nearness = 0.0F;         ///< 0: the outline is sharp and has 8 corners; 1: it has 16 and a whole soft rim
    std::uint32_t random_bits = 0; ///< of the outline's unevenness
};

/// Cuts the shadows of what stands on the ground to a triangle of the ground. On the plan a shadow is the same on all
/// triangles: that on a plane of the slope at the caster's foot. It lies in the triangle's plane and shows its
/// colours and its detail pattern, darker; where two overlap the one painted later is seen, so that overlapping shadows
/// of one strength change nothing.
class SceneryShadows {
public:
    explicit SceneryShadows(const Daylight& day);

    /// False if the sun is so low that nothing casts a shadow.
    bool are_cast() const { return to_sun_.z > min_sun_height; }

    /// How far sunwards of a shadow its caster may stand, for casters of a height, east and north.
    glm::vec2 reach_m(float height_m) const {
        return glm::vec2(to_sun_) * (std::min(max_length, 1.3F * level_ / to_sun_.z) * height_m / level_);
    }

    /// Begins a triangle of the ground. False if it faces away.
    bool begin(const std::array<models::ColourVertex, 3>& triangle);

    /// False only if no part of the shadow falls on the triangle.
    bool may_fall_on_triangle(const ShadowCaster& caster) const { return shadow_of(caster).has_value(); }

    /// Appends the part of a shadow within its rim that falls on the triangle, if there is any. `scale`: towards the
    /// eye.
    void add(const ShadowCaster& caster, float scale, const StandingTriangles& to) const;

    /// Appends the part of a shadow's rim that falls on the triangle.
    void add_rim(const ShadowCaster& caster, float scale, const StandingTriangles& to) const;

private:
    static constexpr float min_sun_height = 0.05F; ///< sine of its elevation
    static constexpr float max_length = 2.5F;      ///< of a shadow, over its caster's height
    static constexpr std::size_t corners = 16;

    /// A convex polygon on the plan, and the shadow's strength at its corners; each of three cuts adds a corner.
    struct Outline {
        std::array<glm::vec3, corners + 3> at_m{};
        std::size_t count = 0;
    };

    /// An ellipse on the plan.
    struct Ellipse {
        glm::vec2 middle_m;
        glm::vec2 along_m; ///< half its length
        glm::vec2 aside_m; ///< half its width
        float taper;
        std::array<bool, 3> crosses; ///< which sides of the triangle the shadow may cross

        /// A place of the unit circle.
        glm::vec2 place_m(const glm::vec2& at) const {
            return middle_m + at.x * along_m + at.y * (1.0F - taper * at.x) * aside_m;
        }
    };

    std::optional<Ellipse> shadow_of(const ShadowCaster& caster) const;
    static void cut(Outline& outline, const glm::vec2& from_m, const glm::vec2& inwards);
    static Outline outline_of(const ShadowCaster& caster, const Ellipse& ellipse, float size, float strength);
    void add_part(Outline outline, const std::array<bool, 3>& crosses, float scale, const StandingTriangles& to) const;

    glm::vec3 to_sun_;
    float level_;       ///< cosine of the sun's elevation
    float left_ = 0.5F; ///< the share of light that the sky gives
    // The triangle.
    std::array<models::ColourVertex, 3> triangle_{};
    std::array<glm::vec2, 3> inwards_{}; ///< unit vectors across the sides from each corner to the next
    glm::vec2 slope_{0.0F};
    float area_m2_ = 1.0F; ///< twice
};

} // namespace octant::visuals::nature
