#include "visuals/nature/scenery.h"

#include "models/colour_vertex.h"
#include "sim/base/hash.h"
#include "sim/base/plane.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace octant::visuals::nature {

// Things of few polygons that are convex, or nearly: seen from outside, none of their front faces hides another.
// Triangles are counter-clockwise seen from outside.

namespace {

/// Eight directions, counter-clockwise from east.
constexpr std::array<glm::vec2, 8> compass_directions = {glm::vec2(1.0F, 0.0F), {0.70710678F, 0.70710678F},
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

/// How a tree is built: heights and radii of rings over its height and radius, from below.
struct Outline {
    std::array<glm::vec2, 3> rings; ///< radius, height
    int count;
};

constexpr Outline cone{{glm::vec2(1.0F, 0.10F), {}, {}}, 1};
constexpr Outline crown{{glm::vec2(0.7F, 0.18F), {1.0F, 0.50F}, {}}, 2};
constexpr Outline round_crown{{glm::vec2(0.45F, 0.12F), {1.0F, 0.42F}, {0.74F, 0.80F}}, 3};

const Outline& outline_of(TreeShape shape, TreeLod detail) {
    if (shape == TreeShape::Conical || detail == TreeLod::Far) { return cone; }
    return detail == TreeLod::Near ? round_crown : crown;
}

/// `size_m`: radius and height. The crown's rings lie along the ground.
void add_tree(LowPolyBuilder& to, const GroundAnchor& anchor, const glm::vec2& size_m, TreeShape shape, TreeLod detail,
    const TreeColours& light) {
    const Outline& outline = outline_of(shape, detail);
    const std::uint32_t step = detail == TreeLod::Far ? 2 : 1;
    const std::uint32_t sides = 8 / step;
    const auto first = static_cast<std::uint32_t>(to.vertices.size());
    for (int ring = 0; ring < outline.count; ++ring) {
        const glm::vec2& at = outline.rings[static_cast<std::size_t>(ring)];
        const float darker = 0.62F + 0.38F * at.y;
        for (std::uint32_t side = 0; side < 8; side += step) {
            const glm::vec2 out = size_m.x * at.x * compass_directions[side];
            const float height_m = size_m.y * at.y + anchor.height_at_offset_m(out);
            to.add(anchor.at_m + glm::vec3(out, height_m), light.sides[side] * darker);
        }
    }
    const std::uint32_t top = to.add(anchor.at_m + glm::vec3(0.0F, 0.0F, size_m.y), light.top);
    for (std::uint32_t ring = 0; ring < static_cast<std::uint32_t>(outline.count); ++ring) {
        const std::uint32_t own = first + ring * sides;
        const bool last = ring + 1 == static_cast<std::uint32_t>(outline.count);
        for (std::uint32_t side = 0; side < sides; ++side) {
            const std::uint32_t next = (side + 1) % sides;
            if (last) {
                to.triangle(own + side, own + next, top);
            } else {
                to.triangle(own + side, own + next, own + sides + next);
                to.triangle(own + side, own + sides + next, own + sides + side);
            }
        }
    }
}

/// Four walls and a gable roof. `along` (unit) is the ridge's direction, `size_m` half the length, half the width and
/// the height; `height_share`, 0..1, says how much of the height there is yet; walls face along, to the left, back and
/// to the right, the roof's sides left and right.
void add_house(LowPolyBuilder& to, const GroundAnchor& anchor, const glm::vec2& along, const glm::vec3& size_m,
    float height_share, const std::array<glm::vec3, 4>& wall, const std::array<glm::vec3, 2>& roof) {
    const glm::vec2 across(-along.y, along.x);
    const auto at = [&](float x, float y, float z) {
        const glm::vec2 level = along * (x * size_m.x) + across * (y * size_m.y);
        const float ground_m = anchor.height_at_offset_m(level);
        return anchor.at_m + glm::vec3(level, ground_m + height_share * std::max(z - ground_m, 0.0F));
    };
    const float eaves_m = 0.58F * size_m.z;
    const auto quad = [&](const std::array<glm::vec3, 4>& corner, const glm::vec3& colour) {
        const std::uint32_t first = to.add(corner[0], colour);
        for (std::size_t i = 1; i < 4; ++i) { to.add(corner[i], colour); }
        to.triangle(first, first + 1, first + 2);
        to.triangle(first, first + 2, first + 3);
    };
    constexpr float low = -1e3F; // metres: walls end at the ground
    quad({at(1, -1, low), at(1, 1, low), at(1, 1, eaves_m), at(1, -1, eaves_m)}, wall[0]);
    quad({at(1, 1, low), at(-1, 1, low), at(-1, 1, eaves_m), at(1, 1, eaves_m)}, wall[1]);
    quad({at(-1, 1, low), at(-1, -1, low), at(-1, -1, eaves_m), at(-1, 1, eaves_m)}, wall[2]);
    quad({at(-1, -1, low), at(1, -1, low), at(1, -1, eaves_m), at(-1, -1, eaves_m)}, wall[3]);
    quad({at(1, 1, eaves_m), at(-1, 1, eaves_m), at(-1, 0, size_m.z), at(1, 0, size_m.z)}, roof[0]);
    quad({at(-1, -1, eaves_m), at(1, -1, eaves_m), at(1, 0, size_m.z), at(-1, 0, size_m.z)}, roof[1]);
    for (const float end : {1.0F, -1.0F}) {
        const glm::vec3& colour = wall[end > 0.0F ? 0 : 2];
        const std::uint32_t first = to.add(at(end, -end, eaves_m), colour);
        to.add(at(end, end, eaves_m), colour);
        to.add(at(end, 0, size_m.z), colour);
        to.triangle(first, first + 1, first + 2);
    }
}

constexpr std::size_t cache_size = std::size_t{1} << 15U;
constexpr double max_reach_m = 900.0;
constexpr double max_reach_cells = 30.0;
constexpr double min_cell_m = 15.0; ///< denser ground bears something in some cells only
constexpr float min_radius_m = 1.2F;
constexpr float house_radius_m = 4.0F; ///< no house where less fits
constexpr float house_m = 7.5F;        ///< its height
constexpr float house_length = 1.25F;  ///< half of it, over the half size
constexpr float house_width = 0.85F;
constexpr float house_corner = 1.52F; ///< its farthest corner from its middle, likewise
constexpr float near_lod_distance_m = 60.0F;
constexpr float far_lod_distance_m = 130.0F;
constexpr float first_growth_ratio = 0.35F;     ///< of the reach: all things have grown by then
constexpr std::size_t upward_light_index = 8;   ///< place of the light from above, after the eight sides
constexpr double placement_radius_ratio = 0.19; ///< radius that fits into a quarter of a cell, over its side

/// Middles of the four quarters into which its diagonals cut a cell.
constexpr std::array<glm::dvec2, 4> quarter_centres = {
    glm::dvec2(0.5, 0.2071), {0.7929, 0.5}, {0.5, 0.7929}, {0.2071, 0.5}};

/// A share in [0, 1) of some of the bits.
float share_of(std::uint32_t random_bits, unsigned shift) {
    return static_cast<float>(random_bits >> shift & 0xffU) * (1.0F / 256.0F);
}

/// How large a tree is, in sizes of its species: 0.7 to 1.3.
float size_of(std::uint32_t random_bits) { return 0.7F + 0.6F * share_of(random_bits, 16); }

TreeLod detail_at(float distance_m) {
    return distance_m < near_lod_distance_m  ? TreeLod::Near
           : distance_m < far_lod_distance_m ? TreeLod::Medium
                                             : TreeLod::Far;
}

/// Leaves out triangles from `first` on that face away: near the outline of a thing far off, where renderers cannot
/// tell, they would be painted over those before them.
void remove_back_faces(
    const std::vector<models::ColourVertex>& vertices, std::size_t first, std::vector<std::uint32_t>& indices) {
    std::size_t kept = first;
    for (std::size_t i = first; i < indices.size(); i += 3) {
        const glm::vec3& a = vertices[indices[i]].position_m;
        const glm::vec3& b = vertices[indices[i + 1]].position_m;
        const glm::vec3& c = vertices[indices[i + 2]].position_m;
        if (glm::dot(glm::cross(b - a, c - a), a) < 0.0F) {
            std::copy_n(&indices[i], 3, &indices[kept]);
            kept += 3;
        }
    }
    indices.resize(kept);
}

struct Species {
    glm::vec3 colour;
    float height_m;
    float radius_m;
    TreeShape shape;
};

/// By kind: broadleaf, conifer, shrub.
const Species& species_of(std::size_t kind) {
    static const std::array<Species, 3> all = {Species{glm::vec3(0.25F, 0.36F, 0.15F), 9.0F, 4.3F, TreeShape::Round},
        Species{glm::vec3(0.16F, 0.27F, 0.15F), 12.0F, 3.0F, TreeShape::Conical},
        Species{glm::vec3(0.42F, 0.40F, 0.24F), 1.8F, 1.7F, TreeShape::Round}};
    return all[kind - 1];
}

class Scenery final : public GroundDecoration {
public:
    Scenery(const glm::dvec2& first_m, const glm::ivec2& samples, double spacing_m, const Daylight& day,
        SceneryDensityAt density_at)
        : first_m_(first_m), samples_(samples), spacing_m_(spacing_m),
          stride_(std::max(static_cast<int>(std::ceil(min_cell_m / spacing_m)), 1)),
          max_radius_m_(static_cast<float>(placement_radius_ratio * spacing_m)),
          reach_m_(max_radius_m_ < min_radius_m ? 0.0 : std::min(max_reach_m, max_reach_cells * stride_ * spacing_m)),
          density_at_(std::move(density_at)), shade_(day.ambient()), item_cache_(cache_size) {
        const glm::vec3 to_sun(day.to_sun());
        for (std::size_t i = 0; i < compass_directions.size(); ++i) {
            const glm::vec3 outwards =
                glm::normalize(glm::vec3(compass_directions[i].x, compass_directions[i].y, 0.45F));
            side_light_[i] = day.sunlight() * std::max(glm::dot(outwards, to_sun), 0.0F);
        }
        side_light_[upward_light_index] = day.sunlight() * std::max(to_sun.z, 0.0F);
    }

    void begin_standing(const NearDetailView& view) override {
        view_ = view;
        added_ = 0;
    }

    double reach_m() const override { return reach_m_ * static_cast<double>(view_.range_ratio); }

    double height_m() const override { return 16.0; }

    bool stands_at(const glm::dvec2& place_m) override {
        constexpr double near = 0.01; // of a cell
        if (reach_m_ <= 0.0) { return false; }
        const glm::dvec2 place = (place_m - first_m_) / spacing_m_;
        const glm::ivec2 min_cell(glm::floor(place - near));
        const glm::ivec2 max_cell(glm::floor(place + near));
        for (int row = std::max(min_cell.y, 0); row <= std::min(max_cell.y, samples_.y - 2); ++row) {
            for (int column = std::max(min_cell.x, 0); column <= std::min(max_cell.x, samples_.x - 2); ++column) {
                if (row % stride_ != 0 || column % stride_ != 0) { continue; }
                const glm::dvec2 from_middle = place - glm::dvec2(column, row) - 0.5;
                for (int quarter_index = 0; quarter_index < 4; ++quarter_index) {
                    const glm::dvec2 way = quarter_centres[static_cast<std::size_t>(quarter_index)] - 0.5;
                    const bool upright = std::abs(way.y) > std::abs(way.x);
                    const double out =
                        upright ? std::copysign(1.0, way.y) * from_middle.y : std::copysign(1.0, way.x) * from_middle.x;
                    const double aside = std::abs(upright ? from_middle.x : from_middle.y);
                    if (out > aside - near && item_at(column, row, quarter_index).kind != SceneryKind::None) {
                        return true;
                    }
                }
            }
        }
        return false;
    }

    void add_standing(const std::array<glm::vec3, 3>& triangle_m, const StandingTriangles& to) override {
        std::vector<models::ColourVertex>& vertices = to.vertices;
        std::vector<std::uint32_t>& indices = to.indices;
        placed_items_.clear();
        collect(triangle_m);
        std::ranges::sort(placed_items_,
            [&](const PlacedItem& one, const PlacedItem& other) { return one.power_m2 < other.power_m2; });
        for (const PlacedItem& one : placed_items_) {
            const float distance_m = glm::length(one.at_m);
            // Each grows out of the ground at a distance of its own.
            const float begins_m =
                static_cast<float>(reach_m()) *
                (first_growth_ratio + (1.0F - first_growth_ratio) * share_of(one.item.random_bits, 0));
            const float height_share = std::clamp(4.0F - 4.0F * distance_m / begins_m, 0.0F, 1.0F);
            if (height_share <= 0.0F || added_ >= view_.max_scenery_triangles) { continue; }
            const std::size_t before = indices.size();
            const auto first_vertex = static_cast<std::uint32_t>(vertices.size());
            const bool is_house = one.item.kind == SceneryKind::House;
            if (is_house) {
                build_house(one, height_share, vertices, indices);
            } else {
                build_tree(one, height_share, detail_at(distance_m), vertices, indices);
            }
            remove_back_faces(vertices, before, indices);
            to.runs.push_back({first_vertex, static_cast<std::uint32_t>(vertices.size()),
                is_house ? models::SurfaceClass::Building : models::SurfaceClass::Tree});
            added_ += (indices.size() - before) / 3;
        }
    }

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

    SceneryItem item_at(int column, int row, int quarter_index) {
        const std::uint64_t place =
            (static_cast<std::uint64_t>(row) << 32U | static_cast<std::uint64_t>(column) << 2U) +
            static_cast<std::uint64_t>(quarter_index);
        const std::uint32_t random_bits =
            scrambled(static_cast<std::uint32_t>(column * 4 + quarter_index) * 0x9e3779b1U ^
                      scrambled(static_cast<std::uint32_t>(row)));
        CachedItem& known = item_cache_[random_bits & (cache_size - 1)];
        if (known.place != place) {
            const SceneryDensity& scenery_density = density_of(column, row);
            const float pick = share_of(random_bits, 24) + share_of(random_bits, 16) * (1.0F / 256.0F);
            float sum = scenery_density.houses;
            SceneryKind kind = pick < sum ? SceneryKind::House : SceneryKind::None;
            for (const auto& [share, own] : {std::pair(scenery_density.conifers, SceneryKind::Conifer),
                     std::pair(scenery_density.broadleaves, SceneryKind::Broadleaf),
                     std::pair(scenery_density.shrubs, SceneryKind::Shrub)}) {
                sum += share;
                kind = kind == SceneryKind::None && pick < sum ? own : kind;
            }
            if (kind == SceneryKind::House && max_radius_m_ < house_radius_m) { kind = SceneryKind::None; }
            known = {place, {kind, static_cast<std::uint8_t>(std::clamp(scenery_density.sun, 0.0F, 1.0F) * 255.0F),
                                scrambled(random_bits)}};
        }
        return known.item;
    }

    /// The quarters of a cell follow one another.
    const SceneryDensity& density_of(int column, int row) {
        if (last_cell_ != glm::ivec2(column, row)) {
            last_density_ = density_at_(column, row);
            last_cell_ = {column, row};
        }
        return last_density_;
    }

    /// What stands within a triangle, with the ground below it as drawn.
    void collect(const std::array<glm::vec3, 3>& triangle_m) {
        const auto& [a, b, c] = triangle_m;
        const glm::dvec2 to_grid = glm::dvec2(view_.eye_m) - first_m_;
        const glm::dvec2 min_cell = (to_grid + glm::dvec2(glm::min(glm::min(a, b), c))) / spacing_m_ + 0.01;
        const glm::dvec2 max_cell = (to_grid + glm::dvec2(glm::max(glm::max(a, b), c))) / spacing_m_ - 0.01;
        const float area = signed_area2(a, b, c);
        const glm::vec3 across = glm::cross(b - a, c - a);
        const glm::vec2 ground_slope = glm::vec2(across) / -across.z;
        const auto reach2_m2 = static_cast<float>(reach_m() * reach_m());
        const auto first_of = [&](double from) {
            const int cell = std::max(static_cast<int>(std::floor(from)), 0);
            return (cell + stride_ - 1) / stride_ * stride_;
        };
        const int last_column = std::min(static_cast<int>(std::floor(max_cell.x)), samples_.x - 2);
        const int last_row = std::min(static_cast<int>(std::floor(max_cell.y)), samples_.y - 2);
        for (int row = first_of(min_cell.y); row <= last_row; row += stride_) {
            for (int column = first_of(min_cell.x); column <= last_column; column += stride_) {
                for (int quarter_index = 0; quarter_index < 4; ++quarter_index) {
                    const glm::dvec2 place =
                        (glm::dvec2(column, row) + quarter_centres[static_cast<std::size_t>(quarter_index)]) *
                            spacing_m_ -
                        to_grid;
                    glm::vec3 at_m(glm::dvec3(place, 0.0));
                    const float u = signed_area2(b, c, at_m) / area;
                    const float v = signed_area2(c, a, at_m) / area;
                    if (u < 0.0F || v < 0.0F || u + v > 1.0F) { continue; }
                    at_m.z = u * a.z + v * b.z + (1.0F - u - v) * c.z;
                    if (glm::dot(at_m, at_m) > reach2_m2) { continue; }
                    const SceneryItem item = item_at(column, row, quarter_index);
                    if (item.kind != SceneryKind::None) {
                        const float radius = radius_m(item);
                        const float power_m2 = at_m.x * at_m.x + at_m.y * at_m.y - radius * radius;
                        placed_items_.push_back({at_m, ground_slope, item, power_m2});
                    }
                }
            }
        }
    }

    float house_half_m() const { return std::min(0.62F * max_radius_m_, 5.5F); }

    /// Of a circle that holds it in plan, its middle where it stands.
    float radius_m(const SceneryItem& item) const {
        if (item.kind == SceneryKind::House) { return house_corner * house_half_m(); }
        const Species& species = species_of(static_cast<std::size_t>(item.kind));
        return std::min(size_of(item.random_bits) * species.radius_m, max_radius_m_);
    }

    /// A colour under the light on one of the eight sides, or from above.
    glm::vec3 lit(const PlacedItem& one, const glm::vec3& own, std::size_t side) const {
        const float sun = static_cast<float>(one.item.sun) * (1.0F / 255.0F);
        return own * (shade_ + sun * side_light_[side]);
    }

    void build_house(const PlacedItem& one, float height_share, std::vector<models::ColourVertex>& vertices,
        std::vector<std::uint32_t>& indices) const {
        const std::uint32_t random_bits = one.item.random_bits;
        const glm::vec3 plaster =
            glm::mix(glm::vec3(0.86F, 0.82F, 0.74F), glm::vec3(0.72F, 0.60F, 0.48F), share_of(random_bits, 12));
        const glm::vec3 tiles =
            glm::mix(glm::vec3(0.56F, 0.27F, 0.18F), glm::vec3(0.36F, 0.34F, 0.34F), share_of(random_bits, 4));
        const std::size_t turn = random_bits >> 20U & 7U;
        const auto wall = [&](std::size_t eighths) { return lit(one, plaster, (turn + eighths) % 8); };
        const auto roof = [&](std::size_t eighths) {
            return 0.5F * (lit(one, tiles, (turn + eighths) % 8) + lit(one, tiles, upward_light_index));
        };
        const float half_m = house_half_m();
        LowPolyBuilder to{vertices, indices};
        add_house(to, {one.at_m, one.ground_slope}, compass_directions[turn],
            glm::vec3(house_length * half_m, house_width * half_m, house_m), height_share,
            {wall(0), wall(2), wall(4), wall(6)}, {roof(2), roof(6)});
    }

    void build_tree(const PlacedItem& one, float height_share, TreeLod detail,
        std::vector<models::ColourVertex>& vertices, std::vector<std::uint32_t>& indices) const {
        const Species& species = species_of(static_cast<std::size_t>(one.item.kind));
        const glm::vec3 leaf = species.colour * (0.85F + 0.3F * share_of(one.item.random_bits, 8));
        TreeColours light{{}, lit(one, leaf, upward_light_index)};
        for (std::size_t side = 0; side < light.sides.size(); ++side) { light.sides[side] = lit(one, leaf, side); }
        LowPolyBuilder to{vertices, indices};
        add_tree(to, {one.at_m, one.ground_slope},
            {radius_m(one.item), size_of(one.item.random_bits) * species.height_m * height_share}, species.shape,
            detail, light);
    }

    glm::dvec2 first_m_;
    glm::ivec2 samples_;
    double spacing_m_;
    int stride_;         ///< cells from one that bears something to the next
    float max_radius_m_; ///< of what fits into its triangle; too small: nothing stands anywhere
    double reach_m_;
    SceneryDensityAt density_at_;
    glm::ivec2 last_cell_{-1};
    SceneryDensity last_density_;           ///< in that cell
    std::array<glm::vec3, 9> side_light_{}; ///< on the eight sides, then on what faces up; the shade
    glm::vec3 shade_{0.4F};
    NearDetailView view_;
    std::size_t added_ = 0; ///< triangles in this frame
    std::vector<CachedItem> item_cache_;
    std::vector<PlacedItem> placed_items_; ///< on one triangle
};

} // namespace

std::unique_ptr<GroundDecoration> scenery_decoration(const glm::dvec2& first_m, const glm::ivec2& samples,
    double spacing_m, const Daylight& day, SceneryDensityAt density_at) {
    return std::make_unique<Scenery>(first_m, samples, spacing_m, day, std::move(density_at));
}

} // namespace octant::visuals::nature
