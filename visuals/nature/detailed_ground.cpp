#include "visuals/nature/detailed_ground.h"

#include "sim/base/hash.h"
#include "sim/base/plane.h"
#include "sim/base/units.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::nature {

namespace {

/// Edges of the ground that are shorter stay whole; over the distance of samples.
constexpr float min_split_edge_ratio = 1.0F / 24.0F;
constexpr double default_edge_rad = 0.08;
constexpr double default_edge_px = 70.0; ///< the same in 720 lines over 45 degrees
constexpr double min_budget_edge_rad = 0.02;
constexpr double default_width_rad = 1.4;
/// Halvings over those that even level ground takes: slopes, edges of the picture.
constexpr double slope_allowance = 1.3;
constexpr double base_splits = 500.0; ///< halvings of large level triangles, wherever the eye is
constexpr double default_scenery_triangles = 4000.0;
constexpr std::size_t unlimited_scenery_triangles = 100'000; ///< more than there can be
constexpr double scenery_max_height_m = 900.0;               ///< of the eye over the ground

} // namespace

/// Of level ground between two distances, triangles whose edges look a long take 2 width / a^2 ln(far / near): each
/// covers a^2 / 2 times the square of its distance.
void apply_detail_budget(const DetailBudget& budget, const NearDetailOptions& detail, NearDetailView& view) {
    const double share = std::clamp(budget.share.value_or(1.0), 0.005, 2.0);
    const double wide = std::clamp(budget.width_rad / default_width_rad, 0.01, 2.0);
    const double edge_rad = budget.share ? default_edge_rad * std::sqrt(wide / share)
                                         : std::max(default_edge_px / budget.focal_px, min_budget_edge_rad);
    view.min_edge_rad = static_cast<float>(edge_rad);
    const double to_m = 1.42 * view.spacing_m / edge_rad;
    const double from_m =
        std::max(budget.height_above_ground_m, static_cast<double>(min_split_edge_ratio) * view.spacing_m / edge_rad);
    const double width_rad = budget.share ? budget.width_rad : 2.0 * pi;
    const double level = 2.0 * width_rad / (edge_rad * edge_rad) * std::log(std::max(to_m / from_m, 1.0));
    const double splits = slope_allowance * level + base_splits * share;
    view.max_splits = detail.has_subdivision ? static_cast<std::size_t>(splits) : 0;
    const double low = std::clamp(1.2 - budget.height_above_ground_m / scenery_max_height_m, 0.0, 1.0);
    const double things = default_scenery_triangles * share * low;
    view.max_scenery_triangles = !detail.scenery ? 0
                                 : budget.share  ? static_cast<std::size_t>(things)
                                                 : unlimited_scenery_triangles;
    view.range_ratio = static_cast<float>(std::sqrt(std::min(share, 1.0)));
    view.focal_px = static_cast<float>(budget.focal_px);
}

namespace {

/// Which edges of near ground are halved. Places are in world axes with the eye subtracted, metres.

/// The ground below the eye, and places no nearer than this, metres.
constexpr float min_detail_distance_m = 3.0F;

constexpr int max_split_depth = 14; ///< of a triangle and its parts, one after the other

float squared_length(const glm::vec3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; }

/// Of an edge as seen from straight above.
float squared_plan_length_m2(const glm::vec3& a, const glm::vec3& b) {
    const float x = b.x - a.x;
    const float y = b.y - a.y;
    return x * x + y * y;
}

/// The square of how long an edge looks: its level length over the distance of its middle.
float squared_angular_size(const glm::vec3& a, const glm::vec3& b) {
    const float distance2 = std::max(squared_length(0.5F * (a + b)), min_detail_distance_m * min_detail_distance_m);
    return squared_plan_length_m2(a, b) / distance2;
}

/// Whether an edge is long enough to be halved, however long it looks.
bool is_splittable(const NearDetailView& view, const glm::vec3& a, const glm::vec3& b) {
    const float least = min_split_edge_ratio * static_cast<float>(view.spacing_m);
    return squared_plan_length_m2(a, b) > least * least;
}

/// Whether a triangle, and all that may be made of it, lies outside the frustum.
bool is_outside(const NearDetailView& view, const std::array<glm::vec3, 3>& triangle) {
    const auto vertical_offset_m = static_cast<float>(max_offset_ratio * view.spacing_m);
    return std::ranges::any_of(view.frustum_normals, [&](const glm::vec3& normal) {
        return normal != glm::vec3(0.0F) && glm::dot(normal, triangle[0]) < -vertical_offset_m &&
               glm::dot(normal, triangle[1]) < -vertical_offset_m && glm::dot(normal, triangle[2]) < -vertical_offset_m;
    });
}

constexpr std::size_t min_places = std::size_t{1} << 15U;
constexpr float full_offset_ratio = 1.8F; ///< times as long: the middle is where it belongs
constexpr float offset_per_slope = 0.3F;
constexpr float shade = 0.16F;
constexpr float level_slope = 0.1F;  ///< edges more level than this have fewer shades
constexpr float quarter_edge = 1.2F; ///< over the sample distance: quarters of cells are shorter

/// In [-1, 1) by a place in the world.
float noise_at(std::int64_t column, std::int64_t row, std::uint32_t salt) {
    const auto x = static_cast<std::uint32_t>(column);
    const auto y = static_cast<std::uint32_t>(row);
    const std::uint32_t h = scrambled(x * 0x9e3779b1U ^ scrambled(y + salt * 0x85ebca77U));
    return static_cast<float>(h >> 8U) * (2.0F / 16777216.0F) - 1.0F;
}

/// Each part of two colours mixed, red, green and blue times a factor.
std::uint32_t blended(std::uint32_t a, std::uint32_t b, float share_of_b, float factor) {
    std::uint32_t blend = 0;
    for (unsigned shift = 0; shift < 32; shift += 8) {
        const auto own = static_cast<float>(a >> shift & 0xffU);
        const auto other = static_cast<float>(b >> shift & 0xffU);
        const float mean = own + share_of_b * (other - own);
        const float part = std::clamp(mean * (shift < 24 ? factor : 1.0F) + 0.5F, 0.0F, 255.0F);
        blend |= static_cast<std::uint32_t>(part) << shift;
    }
    return blend;
}

} // namespace

/// Adds detail below the distance of samples to ground near the eye: edges that look long are halved, and the halves'
/// middles are moved up or down and take the colours of their places, in other shades where it is steep. All follow
/// from the middle's place in the world, the steepness of its edge and how long that looks, growing from nothing. What
/// lies at samples stays where it is. Triangles that share an edge halve it alike, so that there are no cracks, and the
/// parts of a triangle come from near to far. Under what stands on the ground, the ground stays even, and each thing
/// goes with the part in which it stands.
class NearDetailMesh {
public:
    /// Begins a frame: vertices of the mesh, with the eye subtracted, to which more are added. `decorations`: what
    /// stands on the ground; null = nothing. `colour`: of middles; null = between those of the ends.
    void begin(const NearDetailView& view, std::span<const models::ColourVertex> vertices,
        const GroundDecorations* decorations, const ColourAtPoint* colour) {
        view_ = view;
        decorations_ = decorations;
        scenery_triangles_ = 0;
        standing_.clear();
        colour_ = colour;
        vertices_.assign(vertices.begin(), vertices.end());
        midpoints_.resize(std::max({min_places, std::bit_ceil(2 * view.max_splits), midpoints_.size()}));
        ++frame_;
        added_ = 0;
    }

    /// Appends a triangle in its parts to `indices`, nearest first; each part after what stands on it and its shadows
    /// where `has_scenery` says that anything does.
    void add(const std::uint32_t* corners, bool has_scenery, std::vector<std::uint32_t>& indices) {
        add_subdivided(
            {corners[0], corners[1], corners[2]}, 0, has_scenery ? SceneryState::Below : SceneryState::None, indices);
    }

    /// Appends what stands on a triangle.
    void add_standing(const std::uint32_t* corners, std::vector<std::uint32_t>& indices) {
        const std::array triangle{vertices_[corners[0]], vertices_[corners[1]], vertices_[corners[2]]};
        const std::size_t before = indices.size();
        for (const auto& decoration : *decorations_) {
            decoration->add_standing(triangle, {vertices_, indices, standing_});
        }
        scenery_triangles_ += (indices.size() - before) / 3;
    }

    /// Appends the shadows on a part of the triangle of the last add_standing().
    void add_shadows(const std::uint32_t* corners, std::vector<std::uint32_t>& indices) {
        const std::array part{vertices_[corners[0]], vertices_[corners[1]], vertices_[corners[2]]};
        const std::size_t before = indices.size();
        for (const auto& decoration : *decorations_) { decoration->add_shadows(part, {vertices_, indices, standing_}); }
        scenery_triangles_ += (indices.size() - before) / 3;
    }

    /// Triangles of what stands on the ground in this frame.
    std::size_t scenery_triangles() const { return scenery_triangles_; }

    /// Those of the mesh, then new ones.
    std::vector<models::ColourVertex>& vertices() { return vertices_; }

    /// The vertices of what stands on the ground.
    std::vector<models::VertexRun>& standing() { return standing_; }

private:
    struct EdgeMidpoint {
        std::uint64_t edge = 0; ///< both ends; 0 = unused
        std::uint32_t vertex = 0;
        std::uint32_t frame = 0;
    };

    /// What stands on a triangle and its parts: nothing, or something that is added with parts of it, or was added.
    enum class SceneryState { None, Below, Added };

    struct TriangleIndices {
        std::uint32_t a;
        std::uint32_t b;
        std::uint32_t c;
    };

    bool exceeds_min_edge(std::uint32_t a, std::uint32_t b) const {
        const glm::vec3& from = vertices_[a].position_m;
        const glm::vec3& to = vertices_[b].position_m;
        return squared_angular_size(from, to) > view_.min_edge_rad * view_.min_edge_rad &&
               is_splittable(view_, from, to);
    }

    /// The vertex in the middle of an edge that is halved; the edge's first end where it stays whole.
    std::uint32_t midpoint_of(std::uint32_t a, std::uint32_t b) {
        if (a > b) { std::swap(a, b); }
        if (!exceeds_min_edge(a, b)) { return a; }
        const std::uint64_t edge = (std::uint64_t{a} << 32U | b) + 1;
        const std::size_t mask = midpoints_.size() - 1;
        std::size_t at = scrambled(a * 0x9e3779b1U ^ b) & mask;
        while (midpoints_[at].frame == frame_ && midpoints_[at].edge != edge) { at = (at + 1) & mask; }
        EdgeMidpoint& middle = midpoints_[at];
        if (middle.frame != frame_) {
            if (added_ >= view_.max_splits) { return a; }
            middle = {edge, add_midpoint(a, b), frame_};
        }
        return middle.vertex;
    }

    std::uint32_t add_midpoint(std::uint32_t a, std::uint32_t b) {
        const models::ColourVertex from = vertices_[a];
        const models::ColourVertex to = vertices_[b];
        glm::vec3 at_m = 0.5F * (from.position_m + to.position_m);
        const glm::dvec2 place_m = glm::dvec2(at_m) + glm::dvec2(view_.eye_m);
        const float length_m = std::sqrt(squared_plan_length_m2(from.position_m, to.position_m));
        const float distance_m = std::max(std::sqrt(squared_length(at_m)), min_detail_distance_m);
        const float grown =
            std::clamp((length_m / (view_.min_edge_rad * distance_m) - 1.0F) / (full_offset_ratio - 1.0F), 0.0F, 1.0F);
        std::uint32_t colour = blended(from.colour, to.colour, 0.5F, 1.0F);
        if (colour_ != nullptr) { colour = blended(colour, (*colour_)(place_m, at_m), grown, 1.0F); }
        if (length_m < 1.45F * static_cast<float>(view_.spacing_m) && colour >> 24U != 0) {
            const float slope = std::abs(to.position_m.z - from.position_m.z) / length_m;
            const float rough = std::min(slope / level_slope, 1.0F);
            const double cell_m = view_.spacing_m / 64.0;
            const float shades = noise_at(std::llround(place_m.x / cell_m), std::llround(place_m.y / cell_m), 2);
            at_m.z += grown * vertical_offset_m(from.position_m, to.position_m, place_m);
            colour = blended(colour, colour, 0.0F, 1.0F + shade * grown * rough * shades);
        }
        vertices_.push_back({at_m, colour});
        return static_cast<std::uint32_t>(vertices_.size() - 1);
    }

    /// How far the middle of an edge between neighbouring samples, or shorter, lies above it when it has wholly come;
    /// nothing under what stands on the ground, which stays even.
    float vertical_offset_m(const glm::vec3& from_m, const glm::vec3& to_m, const glm::dvec2& place_m) const {
        if (decorations_ != nullptr && std::ranges::any_of(*decorations_,
                                           [&](const auto& decoration) { return decoration->stands_at(place_m); })) {
            return 0.0F;
        }
        const auto spacing_m = static_cast<float>(view_.spacing_m);
        const float max_m =
            std::min(offset_per_slope * std::abs(to_m.z - from_m.z), static_cast<float>(max_offset_ratio) * spacing_m);
        const double cell_m = view_.spacing_m / 64.0;
        return 0.5F * max_m * noise_at(std::llround(place_m.x / cell_m), std::llround(place_m.y / cell_m), 1);
    }

    std::array<glm::vec3, 3> corners_of(const TriangleIndices& triangle) const {
        return {vertices_[triangle.a].position_m, vertices_[triangle.b].position_m, vertices_[triangle.c].position_m};
    }

    /// Things stand within quarters of cells, which are even where anything stands.
    bool is_quarter_cell(const TriangleIndices& triangle) const {
        const auto [a, b, c] = corners_of(triangle);
        const float max_m = quarter_edge * static_cast<float>(view_.spacing_m);
        return std::max({squared_plan_length_m2(a, b), squared_plan_length_m2(b, c), squared_plan_length_m2(c, a)}) <
               max_m * max_m;
    }

    /// Halves a triangle by its longest edge that looks long, and its parts likewise. The plane through the cut stands
    /// upright, so that the part on the eye's side hides nothing of the other. What stands on the triangle goes with
    /// its parts down to quarters of cells, unless a cut goes through quarters, as it does where a longer edge stays
    /// whole.
    void add_subdivided(
        const TriangleIndices& triangle, int depth, SceneryState scenery, std::vector<std::uint32_t>& indices) {
        const TriangleIndices turns[3] = {
            triangle, {triangle.b, triangle.c, triangle.a}, {triangle.c, triangle.a, triangle.b}};
        const TriangleIndices* longest = nullptr;
        std::uint32_t middle = 0;
        float length2 = 0.0F;
        float most2 = 0.0F;
        const bool whole = depth >= max_split_depth || (depth > 0 && is_outside(view_, corners_of(triangle)));
        for (const TriangleIndices& turn : turns) {
            const float own2 = squared_plan_length_m2(vertices_[turn.a].position_m, vertices_[turn.b].position_m);
            most2 = std::max(most2, own2);
            if (own2 <= length2 || whole) { continue; }
            const std::uint32_t own = midpoint_of(turn.a, turn.b);
            if (own != std::min(turn.a, turn.b)) {
                longest = &turn;
                middle = own;
                length2 = own2;
            }
        }
        const bool cuts_quarters = length2 < most2;
        const std::array corners{triangle.a, triangle.b, triangle.c};
        if (scenery == SceneryState::Below && (longest == nullptr || cuts_quarters || is_quarter_cell(triangle))) {
            add_standing(corners.data(), indices);
            scenery = SceneryState::Added;
        }
        if (longest == nullptr) {
            if (scenery == SceneryState::Added) { add_shadows(corners.data(), indices); }
            indices.insert(indices.end(), corners.begin(), corners.end());
            return;
        }
        ++added_;
        const TriangleIndices first{longest->a, middle, longest->c};
        const TriangleIndices second{middle, longest->b, longest->c};
        const glm::vec3& cut_from = vertices_[longest->c].position_m;
        const glm::vec3& cut_to = vertices_[middle].position_m;
        const bool eye_by_first = (signed_area2(cut_from, cut_to, glm::vec3(0.0F)) > 0.0F) ==
                                  (signed_area2(cut_from, cut_to, vertices_[longest->a].position_m) > 0.0F);
        add_subdivided(eye_by_first ? first : second, depth + 1, scenery, indices);
        add_subdivided(eye_by_first ? second : first, depth + 1, scenery, indices);
    }

    NearDetailView view_;
    const GroundDecorations* decorations_ = nullptr;
    const ColourAtPoint* colour_ = nullptr;
    std::uint32_t frame_ = 0;
    std::size_t added_ = 0; ///< halvings
    std::size_t scenery_triangles_ = 0;
    std::vector<models::ColourVertex> vertices_;
    std::vector<models::VertexRun> standing_;
    std::vector<EdgeMidpoint> midpoints_; ///< a table by edge
};

namespace {

/// Of the halvings that may be made: edges are halved for their neighbours' sake, too.
constexpr float share_aimed_at = 0.85F;
constexpr std::uint32_t bits_of_one = 127U << 23U;
constexpr unsigned bin_shift = 18; ///< 32 bins for each doubling

/// The square of a triangle's longest edge.
float squared_longest_edge(const std::array<glm::vec3, 3>& triangle) {
    const auto& [a, b, c] = triangle;
    return std::max({squared_length(b - a), squared_length(c - b), squared_length(a - c)});
}

} // namespace

/// Counts how many halvings the near triangles of a mesh take, by how long edges must look to be halved, so that a
/// number of them can be held without cutting any off.
class NearDetailHistogram {
public:
    /// Returns how long edges must look, no less than `view.min_edge_rad`, for a little less than `view.max_splits`
    /// halvings. It changes steadily with the view. `reach_m`: of things that stand on the ground.
    float min_edge_rad_for_budget(const terrain::GroundMesh& mesh, const NearDetailView& view, float reach_m) {
        view_ = view;
        min_angular_size2_ = view.min_edge_rad * view.min_edge_rad;
        split_counts_.fill(0);
        counted_ = 0;
        is_near_.resize(mesh.indices.size() / 3);
        may_reach_.resize(is_near_.size());
        const float over_longest = 1.0F + 1.0F / view.min_edge_rad;
        for (std::size_t i = 0; i < is_near_.size(); ++i) {
            const Triangle triangle{mesh.vertices[mesh.indices[3 * i]].position_m,
                mesh.vertices[mesh.indices[3 * i + 1]].position_m, mesh.vertices[mesh.indices[3 * i + 2]].position_m};
            const float longest2 = squared_longest_edge(triangle);
            const float distance2 = squared_length(triangle[0]);
            // Farther off none of its edges looks longer.
            is_near_[i] = distance2 < over_longest * over_longest * longest2 ? 1 : 0;
            // The square of a sum is at most twice the sum of the squares.
            may_reach_[i] = distance2 < 2.1F * (reach_m * reach_m + longest2) ? 1 : 0;
            if (is_near_[i] != 0) {
                count(triangle, min_angular_size2_ * static_cast<float>(1U << (bins / bins_an_octave)), 0);
            }
        }
        const float aim = share_aimed_at * static_cast<float>(view.max_splits);
        auto left = static_cast<float>(counted_);
        std::size_t bin = 0;
        while (bin < bins && left - static_cast<float>(split_counts_[bin]) > aim) {
            left -= static_cast<float>(split_counts_[bin++]);
        }
        if (left <= aim || bin == bins) {
            return view.min_edge_rad * std::exp2(0.5F * static_cast<float>(bin) / bins_an_octave);
        }
        const float part = (left - aim) / static_cast<float>(split_counts_[bin]);
        const float octaves = (static_cast<float>(bin) + part) / bins_an_octave;
        return view.min_edge_rad * std::exp2(0.5F * octaves);
    }

    /// Whether a triangle of the last mesh has edges that may look long: most are too far off.
    bool is_near(std::size_t triangle) const { return is_near_[triangle] != 0; }

    /// False only if all of the triangle is farther off than things stand.
    bool may_reach(std::size_t triangle) const { return may_reach_[triangle] != 0; }

private:
    using Triangle = std::array<glm::vec3, 3>;

    static constexpr std::uint32_t bins_an_octave = 32;
    static constexpr std::size_t bins = std::size_t{16} * bins_an_octave;

    /// As NearDetailMesh halves it, by the longest edge. Parts are halved no sooner than the whole.
    void count(const Triangle& triangle, float max_look2, int depth) {
        if (depth >= max_split_depth || (depth > 0 && is_outside(view_, triangle))) { return; }
        std::size_t longest = 0;
        float length2 = 0.0F;
        for (std::size_t k = 0; k < 3; ++k) {
            const float own2 = squared_plan_length_m2(triangle[k], triangle[(k + 1) % 3]);
            if (own2 > length2) {
                length2 = own2;
                longest = k;
            }
        }
        const glm::vec3& a = triangle[longest];
        const glm::vec3& b = triangle[(longest + 1) % 3];
        const glm::vec3& c = triangle[(longest + 2) % 3];
        const float seen2 = std::min(squared_angular_size(a, b), max_look2);
        if (seen2 <= min_angular_size2_ || !is_splittable(view_, a, b)) { return; }
        const std::uint32_t doublings = std::bit_cast<std::uint32_t>(seen2 / min_angular_size2_);
        const std::size_t bin = (doublings - bits_of_one) >> bin_shift;
        ++split_counts_[std::min(bin, bins - 1)];
        ++counted_;
        const glm::vec3 middle = 0.5F * (a + b);
        count({a, middle, c}, seen2, depth + 1);
        count({middle, b, c}, seen2, depth + 1);
    }

    NearDetailView view_;
    float min_angular_size2_ = 0.0F;
    std::size_t counted_ = 0;
    /// Halvings by the square of how long the edge looks, over min_angular_size2_.
    std::array<std::uint32_t, bins> split_counts_{};
    std::vector<std::uint8_t> is_near_;
    std::vector<std::uint8_t> may_reach_;
};

namespace {

/// The triangle's distance from the eye is less than that; by the box around it.
bool is_nearer(const std::array<glm::vec3, 3>& triangle_m, float reach_m) {
    const glm::vec3 least = glm::min(glm::min(triangle_m[0], triangle_m[1]), triangle_m[2]);
    const glm::vec3 most = glm::max(glm::max(triangle_m[0], triangle_m[1]), triangle_m[2]);
    const glm::vec3 nearest = glm::clamp(glm::vec3(0.0F), least, most);
    return glm::dot(nearest, nearest) < reach_m * reach_m;
}

/// The triangles of a mesh from near to far.
struct NearToFar {
    std::span<const std::uint32_t> indices;
    bool far_first; ///< in the mesh
    std::size_t count = indices.size() / 3;

    std::size_t triangle(std::size_t step) const { return far_first ? count - 1 - step : step; }

    /// Where the number is kept of what was made before a step's triangle.
    std::size_t place(std::size_t step) const { return far_first ? count - step : step; }

    /// Appends those of some steps as they are.
    void append(
        std::size_t step, std::size_t end, std::vector<std::uint32_t>& to, std::vector<std::uint32_t>& first_of) const {
        std::size_t next = to.size() / 3;
        to.resize(to.size() + 3 * (end - step));
        for (; step < end; ++step, ++next) {
            first_of[place(step)] = static_cast<std::uint32_t>(next);
            std::copy_n(&indices[3 * triangle(step)], 3, &to[3 * next]);
        }
    }
};

void reverse_triangles(std::vector<std::uint32_t>& indices) {
    for (std::size_t low = 0, high = indices.size(); low + 3 < high; low += 3) {
        high -= 3;
        std::swap_ranges(indices.begin() + static_cast<std::ptrdiff_t>(low),
            indices.begin() + static_cast<std::ptrdiff_t>(low + 3),
            indices.begin() + static_cast<std::ptrdiff_t>(high));
    }
}

} // namespace

struct DetailedFrame {
    std::vector<models::ColourVertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<models::VertexRun> standing;
};

struct DetailedGround::Memory {
    NearDetailHistogram histogram;
    NearDetailMesh mesh_builder;
    std::array<DetailedFrame, 2> frames;
    std::size_t frame_number = 0;
    std::vector<std::uint32_t> first_index_of; ///< for each triangle of the mesh, and the end
    std::vector<std::uint32_t> replaced;
};

DetailedGround::DetailedGround() : memory_(std::make_unique<Memory>()) {}

DetailedGround::~DetailedGround() = default;

/// Goes from near to far, so that what there is no room for is far off.
DetailedGround::Triangles DetailedGround::detailed_mesh(const terrain::GroundMesh& mesh, const NearDetailView& wanted,
    const NearDetailOptions& detail, const GroundDecorations& decorations, const ColourAtPoint* colour) {
    Memory& memory = *memory_;
    NearDetailMesh& mesh_builder = memory.mesh_builder;
    std::vector<std::uint32_t>& first_index_of = memory.first_index_of;
    NearDetailView view = wanted;
    float reach_m = 0.0F;
    for (const auto& decoration : decorations) {
        decoration->begin_standing(view);
        if (detail.scenery) { reach_m = std::max(reach_m, static_cast<float>(decoration->reach_m())); }
    }
    if (detail.has_subdivision) { view.min_edge_rad = memory.histogram.min_edge_rad_for_budget(mesh, wanted, reach_m); }
    memory.frame_number = 1 - memory.frame_number;
    DetailedFrame& frame = memory.frames[memory.frame_number];
    std::swap(mesh_builder.vertices(), frame.vertices); // memory of the frame before the last
    std::swap(mesh_builder.standing(), frame.standing);
    mesh_builder.begin(view, mesh.vertices, detail.scenery ? &decorations : nullptr, colour);
    const bool far_first = view.order == terrain::PaintOrder::BackToFront;
    const NearToFar walk{mesh.indices, far_first};
    const std::size_t count = walk.count;
    frame.indices.clear();
    frame.indices.reserve(mesh.indices.size());
    first_index_of.resize(count + 1);
    const auto corners_m = [&](std::size_t triangle) {
        const std::uint32_t* const corners = &mesh.indices[3 * triangle];
        return std::array{mesh.vertices[corners[0]].position_m, mesh.vertices[corners[1]].position_m,
            mesh.vertices[corners[2]].position_m};
    };
    const auto has_scenery = [&](std::size_t triangle) {
        return reach_m > 0.0F && (!detail.has_subdivision || memory.histogram.may_reach(triangle)) &&
               is_nearer(corners_m(triangle), reach_m);
    };
    const auto is_near = [&](std::size_t triangle) {
        return detail.has_subdivision && memory.histogram.is_near(triangle);
    };
    for (std::size_t step = 0; step < count; ++step) {
        // Most triangles stay as they are.
        const std::size_t first = step;
        while (step < count && !is_near(walk.triangle(step)) && !has_scenery(walk.triangle(step))) { ++step; }
        walk.append(first, step, frame.indices, first_index_of);
        if (step == count) { break; }
        const std::size_t triangle = walk.triangle(step);
        if (is_near(triangle)) {
            first_index_of[walk.place(step)] = static_cast<std::uint32_t>(frame.indices.size() / 3);
            mesh_builder.add(&mesh.indices[3 * triangle], has_scenery(triangle), frame.indices);
        } else {
            const auto before = static_cast<std::uint32_t>(frame.indices.size() / 3);
            mesh_builder.add_standing(&mesh.indices[3 * triangle], frame.indices);
            mesh_builder.add_shadows(&mesh.indices[3 * triangle], frame.indices);
            walk.append(step, step + 1, frame.indices, first_index_of);
            first_index_of[walk.place(step)] = before;
        }
    }
    const auto all = static_cast<std::uint32_t>(frame.indices.size() / 3);
    first_index_of[far_first ? 0 : count] = all;
    if (far_first) {
        reverse_triangles(frame.indices);
        for (std::uint32_t& first : first_index_of) { first = all - first; }
    }
    std::swap(mesh_builder.vertices(), frame.vertices);
    std::swap(mesh_builder.standing(), frame.standing);
    const std::size_t scenery_triangles = mesh_builder.scenery_triangles();
    return {frame.vertices, frame.indices, frame.standing, frame.indices.size() / 3 - count - scenery_triangles,
        scenery_triangles, view.min_edge_rad};
}

void DetailedGround::replace(std::vector<std::uint32_t>& triangles, std::size_t first) const {
    std::vector<std::uint32_t>& replaced = memory_->replaced;
    replaced.clear();
    for (std::size_t i = first; i < triangles.size(); ++i) {
        for (std::uint32_t triangle = memory_->first_index_of[triangles[i]];
             triangle < memory_->first_index_of[triangles[i] + 1]; ++triangle) {
            replaced.push_back(triangle);
        }
    }
    triangles.resize(first);
    triangles.insert(triangles.end(), replaced.begin(), replaced.end());
}

} // namespace octant::visuals::nature
