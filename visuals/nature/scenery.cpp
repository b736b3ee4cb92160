#include "visuals/nature/scenery.h"

#include "models/colour_vertex.h"
#include "sim/base/hash.h"
#include "sim/base/plane.h"
#include "visuals/nature/houses.h"
#include "visuals/nature/plants.h"
#include "visuals/nature/scenery_shadows.h"
#include "visuals/nature/standing_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::nature {

namespace {

constexpr int cache_side = 64; ///< columns and rows of cells of which what stands there is kept: all in reach
constexpr double max_reach_m = 900.0;
constexpr double max_reach_cells = 30.0;
constexpr double min_cell_m = 15.0; ///< denser ground bears something in some cells only
constexpr float min_radius_m = 1.2F;
constexpr float max_height_m = 17.0F;        ///< of all things
constexpr float max_fineness = 1.2F;         ///< of plants where few trees are near
constexpr float min_fineness = 0.6F;         ///< and where they stand everywhere
constexpr float max_crowding = 3.0F;         ///< of trees in view, over those all around
constexpr float spare_share = 0.6F;          ///< of the triangles, after which plants have half of their fineness
constexpr double crowd_reach_m = 250.0;      ///< from the eye
constexpr float house_circle_m = 4.0F;       ///< no house where less fits
constexpr float first_growth_ratio = 0.34F;  ///< of the reach: all things have grown by then
constexpr glm::vec2 shadow_px(46.0F, 66.0F); ///< heights of things at which their shadows begin and are whole
constexpr glm::vec2 rim_px(100.0F, 170.0F);  ///< heights at which a soft rim begins and is whole
constexpr float conifer_taper = 0.5F;
constexpr float layer_part = 0.125F;            ///< of a layer: from one shadow to the next above it
constexpr float shadow_radius_m = 5.0F;         ///< of most of them
constexpr float shadow_margin_m = 45.0F;        ///< beyond the picture, where things still cast shadows into it
constexpr float wood_edge = 0.6F;               ///< 1: as many far trees where half of the places have trees as houses
constexpr float min_full_px = 3.0F;             ///< things that would look lower have not wholly grown
constexpr double placement_radius_ratio = 0.19; ///< radius that fits into a quarter of a cell, over its side

/// Middles of the four quarters into which its diagonals cut a cell, from its middle.
constexpr std::array<glm::vec2, 4> quarter_ways = {
    glm::vec2(0.0F, -0.2929F), {0.2929F, 0.0F}, {0.0F, 0.2929F}, {-0.2929F, 0.0F}};

/// Circles in a circle of radius 1 that are apart, in one of which each plant stands: their middles and their radius.
struct Slots {
    std::span<const glm::vec2> middles;
    float radius;
};

constexpr std::array<glm::vec2, 1> one_slot{glm::vec2(0.0F)};
constexpr std::array<glm::vec2, 3> three_slots{glm::vec2(0.0F, 0.535F), {-0.464F, -0.268F}, {0.464F, -0.268F}};
constexpr std::array<glm::vec2, 7> seven_slots{glm::vec2(0.0F), {0.666F, 0.0F}, {0.333F, 0.577F}, {-0.333F, 0.577F},
    {-0.666F, 0.0F}, {-0.333F, -0.577F}, {0.333F, -0.577F}};

/// As many as leave room for a tree each.
Slots slots_for(float radius_m) {
    constexpr float room_m = 5.0F;
    if (radius_m > 3.0F * room_m) { return {seven_slots, 0.333F}; }
    if (radius_m > 2.155F * room_m) { return {three_slots, 0.464F}; }
    return {one_slot, 1.0F};
}

/// How large a plant is, in sizes of its species: 0.7 to 1.3.
float size_of(std::uint32_t random_bits) { return 0.7F + 0.6F * share_of(random_bits, 16); }

struct Species {
    PlantKind kind;
    float height_m;
    float radius_m;
    float slenderness; ///< the greatest height over the radius
};

constexpr std::array species_of_plants = {Species{PlantKind::Broadleaf, 9.5F, 4.6F, 2.9F},
    Species{PlantKind::Conifer, 13.0F, 3.1F, 4.8F}, Species{PlantKind::Shrub, 1.8F, 1.7F, 1.4F}};

class Scenery final : public GroundDecoration {
public:
    explicit Scenery(SceneryGround ground)
        : ground_(std::move(ground)), stride_(std::max(static_cast<int>(std::ceil(min_cell_m / ground_.spacing_m)), 1)),
          max_radius_m_(static_cast<float>(placement_radius_ratio * ground_.spacing_m)),
          slots_(slots_for(max_radius_m_)),
          reach_m_(max_radius_m_ < min_radius_m ? 0.0
                                                : std::min(max_reach_m, max_reach_cells * stride_ * ground_.spacing_m)),
          plants_(ground_.day), shadows_(ground_.day), cells_(cache_side * cache_side),
          items_(cells_.size() * quarter_ways.size() * slots_.middles.size()) {}

    void begin_standing(const NearDetailView& view) override {
        view_ = view;
        view_reach_m_ = reach_m_ * static_cast<double>(view.range_ratio);
        added_ = 0;
        fineness_ = reach_m_ > 0.0 && view.max_scenery_triangles > 0
                        ? 1.0F / std::clamp(std::sqrt(max_crowding * share_of_trees()), 1.0F / max_fineness,
                                     1.0F / min_fineness)
                        : 1.0F;
        shadow_reach_m_ = 0.0F;
        if (ground_.has_shadows && shadows_.are_cast()) {
            shadow_reach_m_ = std::min(max_height_m * view.focal_px / shadow_px.x, static_cast<float>(view_reach_m_));
        }
    }

    double reach_m() const override { return view_reach_m_; }

    double height_m() const override { return static_cast<double>(max_height_m); }

    bool stands_at(const glm::dvec2& place_m) override {
        constexpr double near = 0.01; // of a cell
        if (reach_m_ <= 0.0) { return false; }
        const glm::dvec2 place = (place_m - ground_.first_m) / ground_.spacing_m;
        const glm::ivec2 min_cell(glm::floor(place - near));
        const glm::ivec2 max_cell(glm::floor(place + near));
        for (int row = std::max(min_cell.y, 0); row <= std::min(max_cell.y, ground_.samples.y - 2); ++row) {
            for (int column = std::max(min_cell.x, 0); column <= std::min(max_cell.x, ground_.samples.x - 2);
                 ++column) {
                if (row % stride_ != 0 || column % stride_ != 0) { continue; }
                const Cell& cell = cell_at(column, row);
                if (cell.most_far < 0.0F) { continue; }
                const glm::dvec2 from_middle = place - glm::dvec2(column, row) - 0.5;
                for (int quarter = 0; quarter < 4; ++quarter) {
                    const glm::dvec2 way(quarter_ways[static_cast<std::size_t>(quarter)]);
                    const bool upright = std::abs(way.y) > std::abs(way.x);
                    const double out =
                        upright ? std::copysign(1.0, way.y) * from_middle.y : std::copysign(1.0, way.x) * from_middle.x;
                    const double aside = std::abs(upright ? from_middle.x : from_middle.y);
                    if (out > aside - near && bears_anything(cell, quarter)) { return true; }
                }
            }
        }
        return false;
    }

    void add_standing(const std::array<models::ColourVertex, 3>& triangle, const StandingTriangles& to) override {
        const std::array triangle_m{triangle[0].position_m, triangle[1].position_m, triangle[2].position_m};
        placed_items_.clear();
        for_each_quarter(
            box_of(triangle_m), view_reach_m_, [&](std::span<const SceneryItem> items, const glm::vec2& centre_m) {
                const std::optional<GroundAnchor> ground = anchor_at(triangle, triangle_m, centre_m);
                if (ground) { place_quarter(items, *ground, 0.0F, 0.0F); }
            });
        std::ranges::sort(placed_items_,
            [&](const PlacedItem& one, const PlacedItem& other) { return one.power_m2 < other.power_m2; });
        StandingMesh mesh{to.vertices, to.indices};
        for (const PlacedItem& one : placed_items_) {
            if (added_ >= view_.max_scenery_triangles) { break; }
            const bool is_scarce =
                static_cast<float>(added_) > spare_share * static_cast<float>(view_.max_scenery_triangles);
            const float fineness = is_scarce ? 0.5F * fineness_ : fineness_;
            const std::size_t before = to.indices.size();
            const auto first_vertex = static_cast<std::uint32_t>(to.vertices.size());
            const bool is_house = one.item.kind == SceneryKind::House;
            if (is_house) {
                add_house(
                    {one.anchor, house_half_m(), one.height_share, one.height_px, sun_of(one), one.item.random_bits},
                    ground_.day, mesh);
            } else {
                plants_.add({species_of(one.item).kind, one.anchor, one.radius_m, one.height_m, one.height_px, fineness,
                                sun_of(one), one.item.random_bits},
                    mesh);
            }
            to.runs.push_back({first_vertex, static_cast<std::uint32_t>(to.vertices.size()),
                is_house ? models::SurfaceClass::Building : models::SurfaceClass::Tree});
            added_ += (to.indices.size() - before) / 3;
        }
        find_casters(triangle, triangle_m);
    }

    void add_shadows(const std::array<models::ColourVertex, 3>& part, const StandingTriangles& to) override {
        if (casters_.empty() || !shadows_.begin(part)) { return; }
        // Rims are painted first, the darkest shadows last. Each is a part of a layer above the one before.
        auto above = static_cast<float>(2 * casters_.size());
        const auto scale = [&] { return depth_offset_factor(1.0F + layer_part * --above); };
        for (const ShadowCaster& caster : casters_) { shadows_.add(caster, scale(), to); }
        for (const ShadowCaster& caster : casters_) { shadows_.add_rim(caster, scale(), to); }
    }

private:
    enum class SceneryKind : std::uint8_t { None, Broadleaf, Conifer, Shrub, House };

    struct SceneryItem {
        SceneryKind kind = SceneryKind::None;
        std::uint8_t sun = 255;
        std::uint8_t edge = 0; ///< how much more of such things are far: 0..255
        std::uint32_t random_bits = 0;
    };

    /// A cell of the grid.
    struct Cell {
        glm::ivec2 place{-1};
        float most_far = -1.0F; ///< the greatest far_share() in it; -1 where nothing stands
        std::size_t first = 0;  ///< of its items: slot by slot, quarter by quarter
    };

    struct PlacedItem {
        GroundAnchor anchor;
        SceneryItem item;
        float radius_m = 0.0F;     ///< of the circle around its foot that holds it
        float height_m = 0.0F;     ///< so far as it has grown
        float height_px = 0.0F;    ///< in the picture
        float height_share = 1.0F; ///< of the whole height
        /// The power of the eye in plan with respect to the circle around it: of two that stand apart, the one with the
        /// greater power hides no part of the other.
        float power_m2 = 0.0F;
    };

    static const Species& species_of(const SceneryItem& item) {
        return species_of_plants[static_cast<std::size_t>(item.kind) - 1];
    }

    static float sun_of(const PlacedItem& one) { return static_cast<float>(one.item.sun) * (1.0F / 255.0F); }

    /// How far from the eye a thing still grows: 0, where all do, to 1. Few plants are far, most of them at the edges
    /// of woods.
    static float far_share(const SceneryItem& item) {
        const float share = share_of(item.random_bits, 0);
        const float edge = item.kind == SceneryKind::House ? 1.0F : static_cast<float>(item.edge) / 255.0F;
        return share * glm::mix(share, 1.0F, edge);
    }

    /// What stands in a quarter of a cell. A house fills it; it stands in the first slot.
    std::span<const SceneryItem> items_of(const Cell& cell, int quarter) const {
        const std::size_t count = slots_.middles.size();
        return std::span(items_).subspan(cell.first + static_cast<std::size_t>(quarter) * count, count);
    }

    bool bears_anything(const Cell& cell, int quarter) const {
        return std::ranges::any_of(
            items_of(cell, quarter), [](const SceneryItem& item) { return item.kind != SceneryKind::None; });
    }

    const Cell& cell_at(int column, int row) {
        const auto place =
            static_cast<std::size_t>((column / stride_) % cache_side + cache_side * ((row / stride_) % cache_side));
        Cell& cell = cells_[place];
        if (cell.place != glm::ivec2(column, row)) {
            cell = {{column, row}, -1.0F, place * quarter_ways.size() * slots_.middles.size()};
            fill(cell);
        }
        return cell;
    }

    void fill(Cell& cell) {
        const SceneryDensity density = ground_.density_at(cell.place.x, cell.place.y);
        const auto column = static_cast<std::uint32_t>(cell.place.x);
        const auto row = static_cast<std::uint32_t>(cell.place.y);
        const auto byte = [](float share) { return static_cast<std::uint8_t>(std::clamp(share, 0.0F, 1.0F) * 255.0F); };
        const float trees = density.conifers + density.broadleaves;
        SceneryItem* item = &items_[cell.first];
        for (std::uint32_t quarter = 0; quarter < quarter_ways.size(); ++quarter) {
            for (std::uint32_t slot = 0; slot < slots_.middles.size(); ++slot) {
                const std::uint32_t random_bits =
                    scrambled((column * 4U + quarter) * 0x9e3779b1U ^ scrambled(row ^ slot * 0x85ebca77U));
                const float pick = share_of(random_bits, 24) + share_of(random_bits, 16) * (1.0F / 256.0F);
                const bool may_be_house = slot == 0 && max_radius_m_ >= house_circle_m;
                float sum = may_be_house ? density.houses : 0.0F;
                SceneryKind kind = pick < sum ? SceneryKind::House : SceneryKind::None;
                for (const auto& [share, own] : {std::pair(density.conifers, SceneryKind::Conifer),
                         std::pair(density.broadleaves, SceneryKind::Broadleaf),
                         std::pair(density.shrubs, SceneryKind::Shrub)}) {
                    sum += share;
                    kind = kind == SceneryKind::None && pick < sum ? own : kind;
                }
                *item = {
                    kind, byte(density.sun), byte(wood_edge * 4.0F * trees * (1.0F - trees)), scrambled(random_bits)};
                if (kind != SceneryKind::None) { cell.most_far = std::max(cell.most_far, far_share(*item)); }
                ++item;
            }
        }
    }

    /// The share of the places around the eye at which trees stand, 0..1. It changes steadily with the eye.
    float share_of_trees() {
        const glm::dvec2 eye = (glm::dvec2(view_.eye_m) - ground_.first_m) / ground_.spacing_m;
        const double reach = crowd_reach_m / ground_.spacing_m;
        const auto first_of = [&](double from) {
            return static_cast<int>(std::ceil(std::max(from, 0.0) / stride_)) * stride_;
        };
        const int last_row = std::min(static_cast<int>(eye.y + reach), ground_.samples.y - 2);
        const int last_column = std::min(static_cast<int>(eye.x + reach), ground_.samples.x - 2);
        float trees = 0.0F;
        float all = 1e-3F;
        for (int row = first_of(eye.y - reach); row <= last_row; row += stride_) {
            for (int column = first_of(eye.x - reach); column <= last_column; column += stride_) {
                const glm::vec2 off((glm::dvec2(column, row) + 0.5 - eye) / reach);
                const float weight = std::max(1.0F - glm::dot(off, off), 0.0F);
                if (weight == 0.0F) { continue; }
                const SceneryKind kind = items_of(cell_at(column, row), (column ^ row) & 3)[0].kind;
                all += weight;
                trees += kind == SceneryKind::Broadleaf || kind == SceneryKind::Conifer ? weight : 0.0F;
            }
        }
        return trees / all;
    }

    /// A rectangle of the plan, metres east and north of the eye.
    struct PlanBox {
        glm::vec2 min_m;
        glm::vec2 max_m;
    };

    static PlanBox box_of(const std::array<glm::vec3, 3>& triangle_m) {
        const auto& [a, b, c] = triangle_m;
        return {glm::vec2(glm::min(glm::min(a, b), c)), glm::vec2(glm::max(glm::max(a, b), c))};
    }

    /// Calls `visit` for the quarters of the cells that reach into a box and are no farther than that from the eye,
    /// with what stands there and their centres; may leave out those of which nothing has grown.
    template <typename Visit>
    void for_each_quarter(const PlanBox& box, double reach_m, const Visit& visit) {
        const glm::dvec2 to_grid = glm::dvec2(view_.eye_m) - ground_.first_m;
        const glm::dvec2 min_cell = (to_grid + glm::dvec2(box.min_m)) / ground_.spacing_m + 0.01;
        const glm::dvec2 max_cell = (to_grid + glm::dvec2(box.max_m)) / ground_.spacing_m - 0.01;
        const auto first_of = [&](double from) {
            const int cell = std::max(static_cast<int>(std::floor(from)), 0);
            return (cell + stride_ - 1) / stride_ * stride_;
        };
        const float farthest_m = static_cast<float>(reach_m) + max_radius_m_;
        const auto cell_m = static_cast<float>(ground_.spacing_m);
        const int last_column = std::min(static_cast<int>(std::floor(max_cell.x)), ground_.samples.x - 2);
        const int last_row = std::min(static_cast<int>(std::floor(max_cell.y)), ground_.samples.y - 2);
        for (int row = first_of(min_cell.y); row <= last_row; row += stride_) {
            for (int column = first_of(min_cell.x); column <= last_column; column += stride_) {
                const Cell& cell = cell_at(column, row);
                if (cell.most_far < 0.0F) { continue; }
                const glm::vec2 middle_m((glm::dvec2(column, row) + 0.5) * ground_.spacing_m - to_grid);
                const float within_m = std::min(farthest_m, growth_reach_m(cell.most_far)) + cell_m;
                if (glm::dot(middle_m, middle_m) > within_m * within_m) { continue; }
                for (int number = 0; number < 4; ++number) {
                    const glm::vec2 centre_m = middle_m + cell_m * quarter_ways[static_cast<std::size_t>(number)];
                    if (glm::dot(centre_m, centre_m) <= farthest_m * farthest_m) {
                        visit(items_of(cell, number), centre_m);
                    }
                }
            }
        }
    }

    /// The ground below a place, as drawn; nothing beyond the triangle.
    static std::optional<GroundAnchor> anchor_at(const std::array<models::ColourVertex, 3>& triangle,
        const std::array<glm::vec3, 3>& triangle_m, const glm::vec2& place_m) {
        const auto& [a, b, c] = triangle_m;
        const float area = signed_area2(a, b, c);
        const glm::vec3 at_m(place_m, 0.0F);
        const float u = signed_area2(b, c, at_m) / area;
        const float v = signed_area2(c, a, at_m) / area;
        if (u < 0.0F || v < 0.0F || u + v > 1.0F) { return std::nullopt; }
        const float w = 1.0F - u - v;
        return GroundAnchor{glm::vec3(place_m, u * a.z + v * b.z + w * c.z), slope_of(triangle_m),
            u * rgb_of(triangle[0]) + v * rgb_of(triangle[1]) + w * rgb_of(triangle[2])};
    }

    static glm::vec3 rgb_of(const models::ColourVertex& vertex) {
        const std::uint32_t colour = vertex.colour;
        return glm::vec3(colour & 0xffU, colour >> 8U & 0xffU, colour >> 16U & 0xffU) * (1.0F / 255.0F);
    }

    static glm::vec2 slope_of(const std::array<glm::vec3, 3>& triangle_m) {
        const glm::vec3 across = glm::cross(triangle_m[1] - triangle_m[0], triangle_m[2] - triangle_m[0]);
        return glm::vec2(across) / -across.z;
    }

    /// Finds what casts shadows on a triangle: what stands there and sunwards of it, taken to stand in its plane.
    void find_casters(const std::array<models::ColourVertex, 3>& triangle, const std::array<glm::vec3, 3>& triangle_m) {
        casters_.clear();
        const auto& [a, b, c] = triangle_m;
        const glm::vec3 nearest_m =
            glm::clamp(glm::vec3(0.0F), glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c));
        const float reach_m = shadow_reach_m_;
        if (glm::dot(nearest_m, nearest_m) > reach_m * reach_m || !shadows_.begin(triangle)) { return; }
        placed_items_.clear();
        const glm::vec2 slope = slope_of(triangle_m);
        PlanBox box = box_of(triangle_m);
        const glm::vec2 sunwards_m = shadows_.reach_m(max_height_m);
        box.min_m += glm::min(sunwards_m, 0.0F) - shadow_radius_m;
        box.max_m += glm::max(sunwards_m, 0.0F) + shadow_radius_m;
        for_each_quarter(
            box, static_cast<double>(reach_m), [&](std::span<const SceneryItem> items, const glm::vec2& centre_m) {
                const float ground_m = triangle_m[0].z + glm::dot(slope, centre_m - glm::vec2(triangle_m[0]));
                const glm::vec3 at_m(centre_m, ground_m);
                const float min_height_m = shadow_px.x / view_.focal_px * (glm::length(at_m) - 2.0F * max_radius_m_);
                place_quarter(items, {at_m, slope}, min_height_m, shadow_margin_m);
            });
        for (const PlacedItem& one : placed_items_) {
            const float strength = std::min((one.height_px - shadow_px.x) / (shadow_px.y - shadow_px.x), 1.0F);
            const float near = std::clamp((one.height_px - rim_px.x) / (rim_px.y - rim_px.x), 0.0F, 1.0F);
            if (strength <= 0.0F) { continue; }
            const ShadowCaster caster{one.anchor.at_m, one.anchor.slope, one.radius_m, one.height_m,
                strength * sun_of(one), one.item.kind == SceneryKind::Conifer ? conifer_taper : 0.0F, near,
                one.item.random_bits};
            if (shadows_.may_fall_on_triangle(caster)) { casters_.push_back(caster); }
        }
        std::ranges::sort(casters_, std::ranges::greater(), &ShadowCaster::strength);
    }

    /// Places what stands in a quarter and may be so high, in view or no farther than a margin beyond. `centre`: of the
    /// quarter.
    void place_quarter(
        std::span<const SceneryItem> items, const GroundAnchor& centre, float min_height_m, float margin_m) {
        const float slot_m = slots_.radius * max_radius_m_;
        for (std::size_t slot = 0; slot < items.size(); ++slot) {
            const SceneryItem& item = items[slot];
            if (item.kind == SceneryKind::None) { continue; }
            PlacedItem one{centre, item};
            float height_m = house_height_m;
            if (item.kind == SceneryKind::House) {
                one.radius_m = house_radius * house_half_m();
            } else {
                const Species& species = species_of(item);
                one.radius_m = std::min(size_of(item.random_bits) * species.radius_m, slot_m);
                height_m = std::min(size_of(item.random_bits) * species.height_m, species.slenderness * one.radius_m);
                if (height_m < min_height_m) { continue; }
                const glm::vec2 off_m = max_radius_m_ * slots_.middles[slot] + (slot_m - one.radius_m) * moved(item);
                one.anchor.at_m += glm::vec3(off_m, centre.height_at_offset_m(off_m));
            }
            if (grow(one, height_m, margin_m)) { placed_items_.push_back(one); }
            if (item.kind == SceneryKind::House) { return; }
        }
    }

    /// A place in the unit circle.
    static glm::vec2 moved(const SceneryItem& item) {
        const std::uint32_t bits = scrambled(item.random_bits);
        const glm::vec2& way = compass_directions[bits & 7U];
        const glm::vec2& other = compass_directions[bits >> 3U & 7U];
        return way * (0.5F * share_of(bits, 8)) + other * (0.5F * share_of(bits, 16));
    }

    /// Each grows out of the ground at a distance of its own. False if nothing of it is seen.
    bool grow(PlacedItem& one, float height_m, float margin_m) const {
        const glm::vec3& at_m = one.anchor.at_m;
        const float distance_m = glm::length(at_m);
        const float full_px_m = height_m * view_.focal_px / min_full_px;
        const float begins_m = std::min(
            growth_reach_m(far_share(one.item)), full_px_m * (0.8F + 0.4F * share_of(one.item.random_bits, 0)));
        one.height_share = std::min(4.0F - 4.0F * distance_m / begins_m, 1.0F);
        if (one.height_share <= 0.0F) { return false; }
        const float room_m = one.radius_m + height_m + margin_m;
        for (const glm::vec3& inwards : view_.frustum_normals) {
            if (glm::dot(inwards, at_m) < -room_m) { return false; }
        }
        if (one.item.kind != SceneryKind::House) { one.radius_m *= one.height_share; }
        one.height_m = height_m * one.height_share;
        one.height_px = one.height_m * view_.focal_px / std::max(distance_m, 1.0F);
        one.power_m2 = at_m.x * at_m.x + at_m.y * at_m.y - one.radius_m * one.radius_m;
        return true;
    }

    /// The distance at which things of a far_share() begin to grow.
    float growth_reach_m(float far_share) const {
        return static_cast<float>(view_reach_m_) * (first_growth_ratio + (1.0F - first_growth_ratio) * far_share);
    }

    float house_half_m() const { return std::min(0.62F * max_radius_m_, 5.5F); }

    SceneryGround ground_;
    int stride_;         ///< cells from one that bears something to the next
    float max_radius_m_; ///< of what fits into its triangle; too small: nothing stands anywhere
    Slots slots_;
    double reach_m_;
    PlantMesher plants_;
    SceneryShadows shadows_;
    float shadow_reach_m_ = 0.0F; ///< in this view
    NearDetailView view_;
    double view_reach_m_ = 0.0;
    float fineness_ = 1.0F;                ///< of plants in this view
    std::size_t added_ = 0;                ///< triangles in this frame
    std::vector<Cell> cells_;              ///< a table by place
    std::vector<SceneryItem> items_;       ///< of those cells
    std::vector<PlacedItem> placed_items_; ///< on one triangle
    std::vector<ShadowCaster> casters_;    ///< of shadows on the triangle of the last add_standing()
};

} // namespace

std::unique_ptr<GroundDecoration> scenery_decoration(SceneryGround ground) {
    return std::make_unique<Scenery>(std::move(ground));
}

} // namespace octant::visuals::nature
