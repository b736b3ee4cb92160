#pragma once

#include "models/colour_vertex.h"
#include "visuals/nature/daylight.h"
#include "visuals/nature/few_polygons.h"
#include "visuals/nature/fine_view.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace octant::visuals::nature {

/// What may stand at a place: shares of places, 0..1, and the sunlight there.
struct Growth {
    float broadleaves = 0.0F;
    float conifers = 0.0F;
    float shrubs = 0.0F;
    float houses = 0.0F;
    float sun = 1.0F; ///< 0 in the shadow of the relief
};

/// Trees, shrubs and houses of few polygons near the eye. Where they stand follows from the ground
/// alone: at places of the sample grid that lie well within one triangle in every mesh of it, so
/// that each can be painted right after its triangle.
class Scenery {
public:
    /// At a sample of the ground.
    using GrowthAt = std::function<Growth(int column, int row)>;

    /// Samples lie `spacing_m` apart, the first at `first_m` in world axes.
    Scenery(glm::dvec2 first_m, glm::ivec2 samples, double spacing_m, GrowthAt growth_at);

    void light_by(const Daylight& day);

    /// Forgets what grows where.
    void forget();

    /// Begins a frame seen from there: what add() appends is chosen for it.
    void begin(const FineView& view);

    /// Whether anything stands in a quarter of a cell that holds a place or ends there.
    bool bears_by(const glm::dvec2& place_m);

    /// Appends what stands on a triangle (world axes with the eye subtracted, as drawn), none of it
    /// below the triangle's plane, from near to far: to `vertices`, and as triangles,
    /// counter-clockwise seen from outside, to `indices`.
    void
    add(const std::array<glm::vec3, 3>& triangle_m,
        std::vector<models::ColourVertex>& vertices,
        std::vector<std::uint32_t>& indices);

    /// Triangles appended since begin().
    std::size_t added() const { return added_; }

    static constexpr double highest_m = 16.0; ///< of all that stands here, above its ground

    /// Farther off nothing stands.
    double reach_m() const { return reach_m_ * static_cast<double>(view_.reach_share); }

private:
    enum class Kind : std::uint8_t { Nothing, Broadleaf, Conifer, Shrub, House };

    struct Thing {
        Kind kind = Kind::Nothing;
        std::uint8_t sun = 255;
        std::uint32_t dice = 0;
    };

    struct Known {
        std::uint64_t place = ~std::uint64_t{0};
        Thing thing;
    };

    struct Standing {
        glm::vec3 at_m;
        glm::vec2 rise; ///< of its ground, metres up a metre east and north
        Thing thing;
        /// The power of the eye in plan with respect to the circle around it: of two that stand
        /// apart, the one with the greater power hides no part of the other.
        float power_m2 = 0.0F;
    };

    Thing thing_at(int column, int row, int spot);
    void collect(const std::array<glm::vec3, 3>& triangle_m);
    float radius_m(const Thing& thing) const;
    float house_half_m() const;
    glm::vec3 lit(const Standing& one, const glm::vec3& own, std::size_t side) const;
    void build_house(
        const Standing& one,
        float grown,
        std::vector<models::ColourVertex>& vertices,
        std::vector<std::uint32_t>& indices) const;
    void build_tree(
        const Standing& one,
        float grown,
        TreeDetail detail,
        std::vector<models::ColourVertex>& vertices,
        std::vector<std::uint32_t>& indices) const;

    glm::dvec2 first_m_;
    glm::ivec2 samples_;
    double spacing_m_;
    int stride_;          ///< cells from one that bears something to the next
    float max_radius_m_; ///< of what fits into its triangle; too small: nothing stands anywhere
    double reach_m_;
    GrowthAt growth_at_;
    std::array<glm::vec3, 9>
        light_from_{}; ///< on the eight sides, then on what faces up; the shade
    glm::vec3 shade_{0.4F};
    FineView view_;
    std::size_t added_ = 0;
    std::vector<Known> known_;
    std::vector<Standing> standing_; ///< on one triangle
};

} // namespace octant::visuals::nature
