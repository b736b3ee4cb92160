#pragma once

#include "models/colour_vertex.h"
#include "visuals/nature/daylight.h"
#include "visuals/terrain/ground_mesh.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

// Things of few polygons that are convex, or nearly: seen from outside, none of their front faces hides another.
// Triangles are counter-clockwise seen from outside.

namespace octant::visuals::nature {

/// Edges of the ground that are shorter stay whole; over the distance of samples.
inline constexpr float min_split_edge_ratio = 1.0F / 24.0F;

/// The most by which the middle of an edge is moved, over the distance of samples.
inline constexpr double max_offset_ratio = 0.06;

/// From where ground is looked at, and how finely it is sampled.
struct NearDetailView {
    glm::dvec3 eye_m{0.0}; ///< world axes
    double spacing_m = 30.0;
    terrain::PaintOrder order = terrain::PaintOrder::BackToFront;
    /// Unit normals of planes through the eye, world axes, that point inside: what lies outside one is not halved. Zero
    /// = no plane.
    std::array<glm::vec3, 4> frustum_normals{glm::vec3(0.0F), glm::vec3(0.0F), glm::vec3(0.0F), glm::vec3(0.0F)};
    std::size_t max_splits = 2000;            ///< triangles that may be added to the ground in a frame
    std::size_t max_scenery_triangles = 5000; ///< triangles of what stands on it
    float min_edge_rad = 0.08F;               ///< edges of the ground that look shorter stay whole
    float range_ratio = 1.0F;                 ///< of the distance to which things stand
};

/// What is added to the mesh near the eye.
struct NearDetailOptions {
    bool has_subdivision = true;
    bool scenery = true;

    bool operator==(const NearDetailOptions&) const = default;
};

/// For how much detail there is room, and how much there is to see.
struct DetailBudget {
    /// Of the usual number of triangles, which is 20,000. Nothing: there is no limit.
    std::optional<double> share = 1.0;
    double width_rad = 1.4;             ///< of the picture
    double focal_px = 869.0;            ///< pixels that a metre covers straight ahead, one metre off
    double height_above_ground_m = 0.0; ///< the eye over the ground
};

/// Sets how long edges look that are halved, how far things stand, and the numbers of both, so that these limits are
/// hardly ever met: what they cut off would appear in a step. Without a limit of triangles the width of the picture
/// counts for nothing: pictures from one eye through lenses of one `focal_px` show the same ground wherever they
/// overlap or meet.
void apply_detail_budget(const DetailBudget& budget, const NearDetailOptions& detail, NearDetailView& view);

/// Eight directions, counter-clockwise from east.
inline constexpr std::array<glm::vec2, 8> compass_directions = {glm::vec2(1.0F, 0.0F), {0.70710678F, 0.70710678F},
    {0.0F, 1.0F}, {-0.70710678F, 0.70710678F}, {-1.0F, 0.0F}, {-0.70710678F, -0.70710678F}, {0.0F, -1.0F},
    {0.70710678F, -0.70710678F}};

/// Appends vertices and triangles of things, which have none of the ground's fine pattern.
struct LowPolyBuilder {
    std::vector<models::ColourVertex>& vertices;
    std::vector<std::uint32_t>& indices;

    std::uint32_t add(const glm::vec3& at_m, const glm::vec3& colour) {
        vertices.push_back({at_m, models::packed_colour(colour) & 0x00ffffffU});
        return static_cast<std::uint32_t>(vertices.size() - 1);
    }

    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { indices.insert(indices.end(), {a, b, c}); }
};

/// Where a thing stands. Nothing of it lies below that plane, which may be painted before it.
struct GroundAnchor {
    glm::vec3 at_m;
    glm::vec2 ground_slope; ///< metres up a metre east and north

    /// Height of the ground over the foot, so far off.
    float height_at_offset_m(const glm::vec2& off_m) const {
        return ground_slope.x * off_m.x + ground_slope.y * off_m.y;
    }
};

/// A tree's colours under light: of sides that face the compass, and from above.
struct TreeColours {
    std::array<glm::vec3, 8> sides;
    glm::vec3 top;
};

enum class TreeShape { Conical, Round };

/// How finely a tree is built. Far ones have four sides, others eight; near ones are rounder.
enum class TreeLod { Near, Medium, Far };

/// `size_m`: radius and height. The crown's rings lie along the ground.
void add_tree(LowPolyBuilder& to, const GroundAnchor& anchor, const glm::vec2& size_m, TreeShape shape, TreeLod detail,
    const TreeColours& light);

/// Four walls and a gable roof. `along` (unit) is the ridge's direction, `size_m` half the length, half the width and
/// the height; `height_share`, 0..1, says how much of the height there is yet; walls face along, to the left, back and
/// to the right, the roof's sides left and right.
void add_house(LowPolyBuilder& to, const GroundAnchor& anchor, const glm::vec2& along, const glm::vec3& size_m,
    float height_share, const std::array<glm::vec3, 4>& wall, const std::array<glm::vec3, 2>& roof);

/// What may stand at a place: shares of places, 0..1, and the sunlight there.
struct SceneryDensity {
    float broadleaves = 0.0F;
    float conifers = 0.0F;
    float shrubs = 0.0F;
    float houses = 0.0F;
    float sun = 1.0F; ///< 0 in the shadow of the relief
};

/// Trees, shrubs and houses of few polygons near the eye. Where they stand follows from the ground alone: at places of
/// the sample grid that lie well within one triangle in every mesh of it, so that each can be painted right after its
/// triangle.
class Scenery {
public:
    /// At a sample of the ground.
    using SceneryDensityAt = std::function<SceneryDensity(int column, int row)>;

    /// Samples lie `spacing_m` apart, the first at `first_m` in world axes.
    Scenery(glm::dvec2 first_m, glm::ivec2 samples, double spacing_m, SceneryDensityAt scenery_density_at);

    void set_daylight(const Daylight& day);

    /// Forgets what grows where.
    void clear_cache();

    /// Begins a frame seen from there: what add() appends is chosen for it.
    void begin(const NearDetailView& view);

    /// Whether anything stands in a quarter of a cell that holds a place or ends there.
    bool has_scenery_at(const glm::dvec2& place_m);

    /// Appends what stands on a triangle (world axes with the eye subtracted, as drawn), none of it below the
    /// triangle's plane, from near to far: to `vertices`, and as triangles, counter-clockwise seen from outside, to
    /// `indices`.
    void add(const std::array<glm::vec3, 3>& triangle_m, std::vector<models::ColourVertex>& vertices,
        std::vector<std::uint32_t>& indices);

    /// Triangles appended since begin().
    std::size_t triangles_added() const { return added_; }

    static constexpr double highest_m = 16.0; ///< of all that stands here, above its ground

    /// Farther off nothing stands.
    double reach_m() const { return reach_m_ * static_cast<double>(view_.range_ratio); }

private:
    enum class SceneryKind : std::uint8_t { None, Broadleaf, Conifer, Shrub, House };

    struct SceneryItem {
        SceneryKind kind = SceneryKind::None;
        std::uint8_t sun = 255;
        std::uint32_t random_bits = 0;
    };

    struct CachedItem {
        std::uint64_t place = ~std::uint64_t{0};
        SceneryItem item;
    };

    struct PlacedItem {
        glm::vec3 at_m;
        glm::vec2 ground_slope; ///< of its ground, metres up a metre east and north
        SceneryItem item;
        /// The power of the eye in plan with respect to the circle around it: of two that stand apart, the one with the
        /// greater power hides no part of the other.
        float power_m2 = 0.0F;
    };

    SceneryItem item_at(int column, int row, int quarter_index);
    void collect(const std::array<glm::vec3, 3>& triangle_m);
    float radius_m(const SceneryItem& item) const;
    float house_half_m() const;
    glm::vec3 lit(const PlacedItem& one, const glm::vec3& own, std::size_t side) const;
    void build_house(const PlacedItem& one, float height_share, std::vector<models::ColourVertex>& vertices,
        std::vector<std::uint32_t>& indices) const;
    void build_tree(const PlacedItem& one, float height_share, TreeLod detail,
        std::vector<models::ColourVertex>& vertices, std::vector<std::uint32_t>& indices) const;

    glm::dvec2 first_m_;
    glm::ivec2 samples_;
    double spacing_m_;
    int stride_;         ///< cells from one that bears something to the next
    float max_radius_m_; ///< of what fits into its triangle; too small: nothing stands anywhere
    double reach_m_;
    SceneryDensityAt density_at_;
    std::array<glm::vec3, 9> side_light_{}; ///< on the eight sides, then on what faces up; the shade
    glm::vec3 shade_{0.4F};
    NearDetailView view_;
    std::size_t added_ = 0;
    std::vector<CachedItem> item_cache_;
    std::vector<PlacedItem> placed_items_; ///< on one triangle
};

} // namespace octant::visuals::nature
