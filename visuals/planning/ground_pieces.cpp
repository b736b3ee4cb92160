#include "visuals/planning/ground_pieces.h"

#include "models/collapse_sequence.h"
#include "models/colour_vertex.h"
#include "sim/base/plane.h"
#include "sim/base/units.h"
#include "visuals/landscape/ground.h"
#include "visuals/scene/truth.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace octant::visuals::planning {

namespace {

float depth_offset_factor(GroundLayer layer) { return nature::depth_offset_factor(static_cast<float>(layer)); }

} // namespace

/// The pieces on the ground of a frame with their indices, and the decals, on which shadows fall.
struct PieceList {
    std::size_t ground_vertices = 0;
    std::vector<models::ColourVertex>* vertices = nullptr; ///< Their numbers follow those of the ground's vertices.
    std::vector<models::SurfaceClass>* surfaces = nullptr; ///< One for each of them.
    std::vector<std::uint32_t> indices;
    std::vector<PieceRange> pieces;
    std::vector<GroundDecal> decals;
    std::vector<glm::dvec3> decal_corners_m;
    int decal_triangles = 0;

    void begin(const GroundPieces::Ground& ground, std::vector<models::ColourVertex>& to,
        std::vector<models::SurfaceClass>& their_surfaces) {
        ground_vertices = ground.triangles.vertices.size();
        vertices = &to;
        surfaces = &their_surfaces;
        to.clear();
        surfaces->clear();
        indices.clear();
        pieces.clear();
        decals.clear();
        decal_corners_m.clear();
        decal_triangles = 0;
    }

    /// Adds the last vertices as a fan.
    void add_fan(std::size_t corners, models::SurfaceClass surface) {
        surfaces->resize(vertices->size(), surface);
        const auto all = static_cast<std::uint32_t>(ground_vertices + vertices->size());
        const std::uint32_t base = all - static_cast<std::uint32_t>(corners);
        for (std::uint32_t i = 2; i < corners; ++i) { indices.insert(indices.end(), {base, base + i - 1, base + i}); }
    }

    /// Adds the indices from `first` to the end as a piece, if there are any.
    void add_range(std::uint32_t triangle, GroundLayer layer, std::size_t first, float light = 1.0F) {
        if (indices.size() > first) {
            pieces.push_back({triangle, static_cast<std::uint32_t>(first),
                static_cast<std::uint32_t>(indices.size() - first), layer, light});
        }
    }

    std::span<const glm::dvec3> corners_of(const GroundDecal& decal) const {
        return std::span(decal_corners_m).subspan(decal.first, decal.count);
    }
};

namespace {

constexpr double min_area_m2 = 1e-5;
/// A little more than two rounding steps of renderers (1/256 pixel), by which two sides may be rounded apart.
constexpr double overlap_px = 0.01;
constexpr double max_overlap = 0.05; ///< of the distance from the eye

/// The distance by which a corner of an edge must move across the edge so that the eye sees it move by an angle. Unit:
/// the map length of `across`, a vector in the triangle's plane. `sideways`: a unit vector normal to the plane through
/// the eye and the edge.
double moved_m(const glm::dvec3& corner_m, const glm::dvec3& across, const glm::dvec3& sideways, double angle_rad) {
    const double seen = std::abs(glm::dot(across, sideways));
    return glm::length(corner_m) * std::min(angle_rad / std::max(seen, 1e-9), max_overlap);
}

} // namespace

/// Clips patches to triangles of the ground. Each decal is in the plane of its triangle and reaches a little beyond its
/// sides, so that there is no gap between two decals. Positions in plan are metres east and north of the eye. The
/// current triangle is the one of set_triangle().
class DecalClipper {
public:
    explicit DecalClipper(PieceList& pieces) : pieces_(pieces) {}

    void begin(const GroundPieces::Ground& ground) {
        ground_.emplace(ground);
        overlap_rad_ = overlap_px * ground.view.pixel_rad;
    }

    /// GroundPieces::lay().
    void lay(nature::GroundDecoration& decoration, int max_triangles) {
        const glm::dvec3& eye_m = ground_->view.camera.eye_m;
        const int limit = pieces_.decal_triangles + max_triangles - max_decal_triangles;
        if (!decoration.begin_lying(eye_m, ground_->view.pixel_rad)) { return; }
        candidates_.clear();
        ground_->mesher.triangles_in(
            [&](const glm::dvec3& min_m, const glm::dvec3& max_m) {
                return decoration.may_lie_in(glm::dvec2(min_m), glm::dvec2(max_m));
            },
            candidates_);
        if (!ground_->is_front_to_back) { std::ranges::reverse(candidates_); }
        for (const std::uint32_t candidate : candidates_) {
            set_triangle(candidate);
            if (!is_seen()) { continue; }
            patches_.clear();
            const auto& [a, b, c] = corners_on_plan_m_;
            decoration.find_patches(glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c), patches_);
            if (patches_.empty()) { continue; }
            const bool on_water = is_on_water();
            mean_colour_ = mean_colour();
            for (const nature::GroundPatch& patch : patches_) {
                if ((patch.is_required || pieces_.decal_triangles <= limit) && (patch.is_on_water || !on_water)) {
                    add_decal(patch);
                }
            }
        }
    }

private:
    /// The largest number of triangles of a decal: three cuts add a corner each.
    static constexpr int max_decal_triangles = 5;

    /// A convex polygon on the plan.
    struct ClippedPatch {
        std::array<glm::dvec2, max_decal_triangles + 3> corners;
        std::size_t count = 0;
    };

    using SideFlags = std::array<bool, 3>;

    /// A side of the triangle, its outward unit vector, and the distances by which its ends move along that for one
    /// overlap.
    struct Side {
        glm::dvec2 from_m;
        glm::dvec2 to_m;
        glm::dvec2 out;
        double from_moved_m = 0.0;
        double to_moved_m = 0.0;
    };

    void set_triangle(std::uint32_t triangle) {
        number_ = triangle;
        has_sides_ = false;
        place_triangle(ground_->triangles, triangle, triangle_);
        for (std::size_t i = 0; i < 3; ++i) { corners_on_plan_m_[i] = glm::dvec2(triangle_[i].at_m); }
    }

    /// False if the current triangle is not visible; may be true for such a triangle.
    bool is_seen() const {
        const glm::dvec3& a = triangle_[0].at_m;
        const glm::dvec3 up = glm::cross(triangle_[1].at_m - a, triangle_[2].at_m - a);
        return up.z > 0.0 && glm::dot(up, a) < 0.0 && may_be_in_view();
    }

    /// False only if neither the triangle nor a margin of a pixel around it is in view.
    bool may_be_in_view() const {
        return std::ranges::all_of(ground_->view.frustum, [&](const glm::dvec3& inwards) {
            return std::ranges::any_of(triangle_, [&](const ViewVertex& corner) {
                const double inside_m = glm::dot(inwards, corner.at_m);
                return inside_m >= 0.0 || inside_m >= -ground_->view.pixel_rad * glm::length(corner.at_m);
            });
        });
    }

    /// The mean colour of the current triangle's corners, display values.
    glm::vec3 mean_colour() const {
        const std::uint32_t* const corner = &ground_->triangles.indices[std::size_t{3} * number_];
        glm::vec3 sum(0.0F);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t packed = ground_->triangles.vertices[corner[i]].colour;
            sum += glm::vec3(packed & 0xffU, packed >> 8U & 0xffU, packed >> 16U & 0xffU);
        }
        return sum / (3.0F * 255.0F);
    }

    /// Whether the current triangle is water, or belongs to scenery and not to the ground.
    bool is_on_water() const {
        const std::uint32_t* const corner = &ground_->triangles.indices[std::size_t{3} * number_];
        if (scene::surface_of(ground_->triangles, {}, corner) != models::SurfaceClass::Terrain) { return true; }
        return std::all_of(corner, corner + 3,
            [&](std::uint32_t vertex) { return ground_->triangles.vertices[vertex].colour >> 24U == 0; });
    }

    /// Computes the plane and the sides of the current triangle. Done only for triangles that get a decal, which are
    /// few.
    void place_sides() {
        has_sides_ = true;
        plane_ = plane_of(triangle_);
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3& from_m = triangle_[i].at_m;
            const glm::dvec3& to_m = triangle_[(i + 1) % 3].at_m;
            const glm::dvec2 edge = glm::normalize(glm::dvec2(to_m - from_m));
            const glm::dvec2 out(edge.y, -edge.x);
            const glm::dvec3 across(out, -glm::dot(glm::dvec2(plane_.normal), out) / plane_.normal.z);
            const glm::dvec3 upright = glm::cross(from_m, to_m);
            const glm::dvec3 sideways = upright / std::max(glm::length(upright), 1e-9);
            sides_[i] = {glm::dvec2(from_m), glm::dvec2(to_m), out, moved_m(from_m, across, sideways, overlap_rad_),
                moved_m(to_m, across, sideways, overlap_rad_)};
        }
    }

    /// Cuts off the part to the right of a line.
    static void cut(ClippedPatch& piece, const glm::dvec2& from, const glm::dvec2& to) {
        ClippedPatch kept;
        for (std::size_t i = 0; i < piece.count; ++i) {
            const glm::dvec2& a = piece.corners[i];
            const glm::dvec2& b = piece.corners[i + 1 < piece.count ? i + 1 : 0];
            const double a_side = signed_area2(from, to, a);
            const double b_side = signed_area2(from, to, b);
            if (a_side >= 0.0) { kept.corners[kept.count++] = a; }
            if ((a_side > 0.0 && b_side < 0.0) || (a_side < 0.0 && b_side > 0.0)) {
                kept.corners[kept.count++] = glm::mix(a, b, a_side / (a_side - b_side));
            }
        }
        piece = kept;
    }

    /// The sides of the current triangle that cut a patch; nothing if the patch is beyond one of them.
    std::optional<SideFlags> sides_across(const ClippedPatch& patch) const {
        SideFlags across{};
        for (std::size_t side = 0; side < sides_.size(); ++side) {
            std::size_t inside = 0;
            for (std::size_t i = 0; i < patch.count; ++i) {
                const bool is_in = signed_area2(sides_[side].from_m, sides_[side].to_m, patch.corners[i]) >= 0.0;
                inside += is_in ? 1U : 0U;
            }
            if (inside == 0) { return std::nullopt; }
            across[side] = inside < patch.count;
        }
        return across;
    }

    /// A patch clipped to some sides of the current triangle, moved outwards by this number of overlaps.
    ClippedPatch piece_of(const ClippedPatch& patch, const SideFlags& across, double overlaps) const {
        ClippedPatch piece = patch;
        for (std::size_t i = 0; i < sides_.size(); ++i) {
            if (across[i]) {
                const Side& side = sides_[i];
                cut(piece, side.from_m + side.out * (side.from_moved_m * overlaps),
                    side.to_m + side.out * (side.to_moved_m * overlaps));
            }
        }
        return piece;
    }

    /// Adds the part of a patch on the current triangle, if there is any, as a decal. A marking overlaps the triangle's
    /// sides twice as far as the surface below it, which must not show along its ends.
    void add_decal(const nature::GroundPatch& patch) {
        const auto area_m2 = [](const ClippedPatch& piece) {
            double sum_m2 = 0.0;
            for (std::size_t i = 2; i < piece.count; ++i) {
                sum_m2 += 0.5 * signed_area2(piece.corners[0], piece.corners[i - 1], piece.corners[i]);
            }
            return sum_m2;
        };
        if (!has_sides_) { place_sides(); }
        ClippedPatch all{{}, patch.corners_m.size()};
        std::ranges::copy(patch.corners_m, all.corners.begin());
        const std::optional<SideFlags> across = sides_across(all);
        if (!across || area_m2(piece_of(all, *across, 0.0)) <= min_area_m2) { return; }
        const ClippedPatch piece = piece_of(all, *across, patch.is_marking ? 2.0 : 1.0);
        const glm::vec3 colour = glm::mix(mean_colour_, patch.colour, patch.own_share);
        GroundDecal& decal = pieces_.decals.emplace_back();
        decal = {number_, static_cast<std::uint32_t>(pieces_.decal_corners_m.size()),
            static_cast<std::uint32_t>(piece.count), models::packed_colour(colour) & 0x00ffffffU,
            patch.is_marking ? GroundLayer::Marking : GroundLayer::Surface, patch.surface};
        const std::size_t first = pieces_.indices.size();
        for (std::size_t i = 0; i < piece.count; ++i) {
            const glm::dvec2& at_m = piece.corners[i];
            const double up_m = -(glm::dot(glm::dvec2(plane_.normal), at_m) + plane_.offset_m) / plane_.normal.z;
            const glm::dvec3 corner_m(at_m, up_m);
            pieces_.decal_corners_m.push_back(corner_m);
            pieces_.vertices->push_back({glm::vec3(corner_m) * depth_offset_factor(decal.layer), decal.colour});
        }
        pieces_.add_fan(piece.count, decal.surface);
        pieces_.add_range(number_, decal.layer, first);
        pieces_.decal_triangles += static_cast<int>(piece.count) - 2;
    }

    PieceList& pieces_;
    std::optional<GroundPieces::Ground> ground_;
    double overlap_rad_ = 0.0;
    std::vector<std::uint32_t> candidates_;
    std::vector<nature::GroundPatch> patches_; ///< Those that may be on the current triangle.
    // The current triangle.
    std::uint32_t number_ = 0;
    ViewPolygon triangle_;
    bool has_sides_ = false;
    Plane plane_;
    std::array<Side, 3> sides_;
    std::array<glm::dvec2, 3> corners_on_plan_m_;
    glm::vec3 mean_colour_{0.0F};
};

namespace {

/// Share of a sunlit surface's colour that is left where a shadow is darkest.
constexpr float shadow_share = 0.55F;
constexpr double sun_diameter_rad = 0.0093;
/// Width of penumbra, pixels, for each edge of a shadow. A shadow has at most max_edges edges, and fewer if it is
/// faint.
constexpr double edge_px = 2.5;
constexpr int max_edges = 5;
/// The least darkening from one edge to the next, a share of the light.
constexpr double min_step = 0.03;
/// The error of a shadow that its penumbra hides, as a share of the penumbra's width.
constexpr double hidden_share = 0.25;
/// The size of the cells in which the polygons of a penumbra are put together, as a share of its width.
constexpr double cell_share = 1.0;
/// The width of the strips of which an aircraft's shadow is made, as wings and fuselage are, as a share of its half
/// diagonal: where the penumbra is wider, no place is without sun.
constexpr double strip_share = 0.15;
constexpr double min_sun_elevation_deg = 3.0;
constexpr double min_shadow_px = 2.0;
constexpr int max_march_steps = 200;

glm::vec4 unpacked(std::uint32_t colour) {
    return glm::vec4(static_cast<float>(colour & 255U), static_cast<float>((colour >> 8U) & 255U),
               static_cast<float>((colour >> 16U) & 255U), static_cast<float>(colour >> 24U)) /
           255.0F;
}

/// The colour where a shadow leaves this share of the light. The alpha is darkened, too, if it is the light that
/// reaches the ground.
std::uint32_t shaded(const glm::vec4& colour, bool is_light, float light) {
    const float left = is_light ? light : 1.0F;
    const auto alpha = static_cast<std::uint32_t>(255.0F * left * colour.w + 0.5F);
    return (models::packed_colour(glm::vec3(colour) * light) & 0x00ffffffU) | alpha << 24U;
}

/// Moves the sides of a convex polygon that faces the sun outwards, across the sunlight; corners of more than a right
/// angle are cut off where they leave the circle around the old ones.
void grow(ViewPolygon& polygon, double by_m, const glm::dvec3& to_sun, ViewPolygon& scratch) {
    scratch.clear();
    const auto along = [&](std::size_t from) {
        const glm::dvec3 side_m = polygon[(from + 1) % polygon.size()].at_m - polygon[from].at_m;
        const glm::dvec3 seen_m = side_m - glm::dot(side_m, to_sun) * to_sun;
        return seen_m / std::max(glm::length(seen_m), 1e-9);
    };
    glm::dvec3 before = along(polygon.size() - 1);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& corner_m = polygon[i].at_m;
        const glm::dvec3 after = along(i);
        const glm::dvec3 out = glm::cross(before, to_sun);
        const glm::dvec3 next_out = glm::cross(after, to_sun);
        const double cosine = glm::dot(out, next_out);
        if (cosine >= 0.0) {
            scratch.push_back({corner_m + by_m / (1.0 + cosine) * (out + next_out), false});
        } else {
            const double half = std::sqrt(0.5 * std::max(1.0 + cosine, 0.0));
            const double ahead = std::sqrt((1.0 - half) / (1.0 + half)); // tan of a quarter of the turn
            scratch.push_back({corner_m + by_m * (out + ahead * before), false});
            scratch.push_back({corner_m + by_m * (next_out - ahead * after), false});
        }
        before = after;
    }
    polygon.swap(scratch);
}

/// The volume of the light through a box from its middle down to `path_m` along the light, and `reach_m` beyond.
ConvexVolume shadow_volume_of(const OrientedBox& hull, const glm::dvec3& to_sun, double path_m, double reach_m) {
    const AxisAlignedBox extent = world_bounds(hull);
    const glm::dvec3 down_m = to_sun * -(path_m + reach_m);
    ConvexVolume volume;
    volume.extent = {glm::min(extent.min_m, extent.min_m + down_m), glm::max(extent.max_m, extent.max_m + down_m)};
    const LightPrism prism = prism_of(hull, to_sun);
    for (int i = 0; i < prism.count; ++i) { volume.add(prism.planes[static_cast<std::size_t>(i)]); }
    return volume;
}

constexpr double root_half = 0.70710678118654752;

/// Eight directions, counter-clockwise.
constexpr std::array<glm::dvec2, 8> eighth_ways = {glm::dvec2(1.0, 0.0), {root_half, root_half}, {0.0, 1.0},
    {-root_half, root_half}, {-1.0, 0.0}, {-root_half, -root_half}, {0.0, -1.0}, {root_half, -root_half}};

} // namespace

/// Polygons as the light sees them. Their extents across it are in two directions square to it and to one another: what
/// light carries from one polygon to another has places in both extents.
class LightExtents {
public:
    /// Forgets all polygons. `origin_m`: a corner of cells, and where octagons are measured from.
    void begin(const glm::dvec3& to_sun, const glm::dvec3& origin_m) {
        const glm::dvec3 aside = std::abs(to_sun.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
        to_sun_ = to_sun;
        across_ = glm::normalize(glm::cross(to_sun, aside));
        along_ = glm::cross(to_sun, across_);
        origin_m_ = origin_m;
        ends_m_.clear();
    }

    void add(const ViewPolygon& polygon) { ends_m_.push_back(ends_of(polygon)); }

    /// Fills in the numbers of those polygons whose extents overlap that of another.
    void find(const ViewPolygon& other, std::vector<std::uint32_t>& found) const {
        constexpr double margin_m = 1e-3; // far more than rounding moves a corner
        const Ends wanted = ends_of(other);
        found.clear();
        for (std::size_t i = 0; i < ends_m_.size(); ++i) {
            const Ends& own = ends_m_[i];
            if (own.max_m.x >= wanted.min_m.x - margin_m && own.min_m.x <= wanted.max_m.x + margin_m &&
                own.max_m.y >= wanted.min_m.y - margin_m && own.min_m.y <= wanted.max_m.y + margin_m) {
                found.push_back(static_cast<std::uint32_t>(i));
            }
        }
    }

    /// The square cell, across the light, that holds the middle of a polygon's extent; nothing for one longer than
    /// that.
    std::optional<std::array<double, 2>> cell_of(std::span<const ViewVertex> polygon, double cell_m) const {
        const Ends ends = ends_of(polygon);
        const glm::dvec2 size_m = ends.max_m - ends.min_m;
        if (std::max(size_m.x, size_m.y) > cell_m || cell_m <= 0.0) { return std::nullopt; }
        const glm::dvec2 cell = glm::floor(0.5 * (ends.min_m + ends.max_m) / cell_m);
        return std::array{cell.x, cell.y};
    }

    /// An octagon around polygons as the light sees them, so far from the origin in eight directions.
    struct Octagon {
        std::array<double, 8> reach_m;
        double sunwards_m = -std::numeric_limits<double>::infinity(); ///< of the polygon nearest to the sun

        Octagon() { reach_m.fill(-std::numeric_limits<double>::infinity()); }
    };

    /// Makes an octagon hold a polygon too.
    void extend(Octagon& octagon, std::span<const ViewVertex> polygon) const {
        for (const ViewVertex& corner : polygon) {
            const glm::dvec2 at_m = seen_m(corner.at_m);
            for (std::size_t i = 0; i < 4; ++i) {
                const double reach_m = glm::dot(at_m, eighth_ways[i]);
                octagon.reach_m[i] = std::max(octagon.reach_m[i], reach_m);
                octagon.reach_m[i + 4] = std::max(octagon.reach_m[i + 4], -reach_m);
            }
            octagon.sunwards_m = std::max(octagon.sunwards_m, glm::dot(to_sun_, corner.at_m - origin_m_));
        }
    }

    /// Fills in the corners of an octagon, grown by a distance; it faces the sun.
    void corners_of(const Octagon& octagon, double grown_m, ViewPolygon& corners) const {
        corners.clear();
        const glm::dvec3 middle_m = origin_m_ + octagon.sunwards_m * to_sun_;
        for (std::size_t i = 0; i < 8; ++i) {
            const double own_m = octagon.reach_m[i] + grown_m;
            const double next_m = octagon.reach_m[(i + 1) % 8] + grown_m;
            const glm::dvec2& out = eighth_ways[i];
            const glm::dvec2 at_m = own_m * out + (std::sqrt(2.0) * next_m - own_m) * glm::dvec2(-out.y, out.x);
            corners.push_back({middle_m + at_m.x * across_ + at_m.y * along_, false});
        }
    }

private:
    struct Ends {
        glm::dvec2 min_m{std::numeric_limits<double>::infinity()};
        glm::dvec2 max_m{-std::numeric_limits<double>::infinity()};
    };

    Ends ends_of(std::span<const ViewVertex> polygon) const {
        Ends ends;
        for (const ViewVertex& corner : polygon) {
            const glm::dvec2 at_m = seen_m(corner.at_m);
            ends.min_m = glm::min(ends.min_m, at_m);
            ends.max_m = glm::max(ends.max_m, at_m);
        }
        return ends;
    }

    glm::dvec2 seen_m(const glm::dvec3& at_m) const {
        return {glm::dot(across_, at_m - origin_m_), glm::dot(along_, at_m - origin_m_)};
    }

    glm::dvec3 to_sun_{0.0, 0.0, 1.0};
    glm::dvec3 origin_m_{0.0};
    glm::dvec3 across_{1.0, 0.0, 0.0};
    glm::dvec3 along_{0.0, 1.0, 0.0};
    std::vector<Ends> ends_m_;
};

namespace {

/// The vertical plane through an edge of a polygon that is counter-clockwise from above; the polygon is in front of it.
Plane side_of(const glm::dvec3& from_m, const glm::dvec3& to_m) {
    const glm::dvec3 edge_m = to_m - from_m;
    const glm::dvec3 inward(-edge_m.y, edge_m.x, 0.0);
    return {inward, -glm::dot(inward, from_m)};
}

} // namespace

/// Shadows of aircraft: each polygon that faces the sun is projected along the sunlight onto each triangle of the
/// ground below and clipped to that triangle. The pieces are opaque and have the triangle's own colours, darkened, so
/// that overlapping pieces of one darkness change nothing; decals have shadows of their own. Around the whole shadow
/// lies the outer half of its penumbra, as wide as the sun makes it over the light's way from the middle of the
/// aircraft: the polygons of the aircraft's outlines, grown, in lighter colours and painted before it. Polygons that
/// are small beside the penumbra are put together, as no edge of them is seen. Where the penumbra is wider than the
/// shadow's own strips, all of it is lighter. Only the first ground on the way of the light has the shadow; ground
/// casts no shadow here. The volume in which ground is looked for is that of the aircraft's own model.
class ShadowCaster {
public:
    explicit ShadowCaster(PieceList& pieces) : pieces_(pieces) {}

    void begin(const GroundPieces::Ground& ground) {
        ground_.emplace(ground);
        decals_by_triangle_.clear();
    }

    /// GroundPieces::cast().
    void cast(const PlacedAircraft& aircraft, const OrientedBox& hull, const glm::dvec3& to_sun, double max_error_px) {
        const bool is_high_enough = to_sun.z >= std::sin(rad_from_deg(min_sun_elevation_deg));
        if (!is_high_enough || ground_->triangles.indices.empty()) { return; }
        to_sun_ = to_sun;
        sort_decals();
        const FrameView& view = ground_->view;
        const double path_m = light_path_m(hull, ground_->mesher.ground(), view.camera.eye_m);
        if (path_m < 0.0) { return; }
        const glm::dvec3 position_m = hull.centre_m - to_sun_ * path_m;
        const AxisAlignedBox& extent = aircraft.model->hull;
        const double size_m = 0.5 * glm::distance(extent.min_m, extent.max_m);
        const double penumbra_m = 0.5 * sun_diameter_rad * path_m;
        choose_edges(size_m, penumbra_m, penumbra_m / (view.pixel_rad * glm::length(position_m)));
        // On a slope that falls away from the sun a shadow is longer than on level ground.
        const double reach_m = 2.0 * (size_m + penumbra_m) / to_sun_.z;
        if (2.0 * size_m < min_shadow_px * view.pixel_rad * glm::length(position_m) ||
            !scene::in_view(position_m, reach_m, view.frustum)) {
            return;
        }
        OrientedBox casting = hull;
        casting.half_m += (1.0 + hidden_share) * edges_.back().grown_m;
        const ConvexVolume volume = shadow_volume_of(casting, to_sun_, path_m, reach_m);

        struct Look {
            const ConvexVolume& volume;
            const glm::dvec3& eye_m;
        } const look{volume, view.camera.eye_m};

        candidates_.clear();
        ground_->mesher.triangles_in(
            [&look](const glm::dvec3& min_m, const glm::dvec3& max_m) {
                return may_intersect(look.volume, min_m - look.eye_m, max_m - look.eye_m);
            },
            candidates_);
        if (candidates_.empty()) { return; }
        // The shadow's error is that of the model, drawn out along the light; a small part of the penumbra hides it.
        const double nearest_m = std::max(glm::length(position_m) - reach_m, 0.0);
        const double hidden_m =
            std::max(max_error_px * view.pixel_rad * nearest_m, hidden_share * edges_.back().grown_m);
        const bool far_model_casts = !aircraft.far_parts.empty() && aircraft.far_error_m / to_sun_.z <= hidden_m;
        if (far_model_casts) {
            collect_faces({*aircraft.far_model, aircraft.far_parts, aircraft.far_disc_strengths}, hull.centre_m);
        } else {
            collect_faces({*aircraft.model, aircraft.parts, aircraft.disc_strengths}, hull.centre_m);
        }
        for (const std::uint32_t candidate : candidates_) {
            place_triangle(ground_->triangles, candidate, triangle_);
            const glm::dvec3& a = triangle_[0].at_m;
            const glm::dvec3& b = triangle_[1].at_m;
            const glm::dvec3& c = triangle_[2].at_m;
            if (may_intersect(volume, glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c))) { cast_on(candidate); }
        }
    }

private:
    struct Face {
        std::size_t first = 0;
        std::size_t count = 0;
        std::size_t edge = 0; ///< Index into edges_.
    };

    /// A polygon that faces the sun: its corners in sunlit_corners_ and its number.
    struct SunlitPolygon {
        std::size_t first = 0;
        std::size_t count = 0;
        std::uint32_t polygon = 0;
    };

    using CellPolygon = std::pair<std::array<double, 2>, SunlitPolygon>;

    /// One of the outlines of a shadow: its distance from the whole shadow, and the share of light that is left inside.
    struct Edge {
        double grown_m = 0.0;
        float light = shadow_share;
    };

    /// A polygon's shadow in shadow_parts_, up to its end there.
    struct Part {
        std::size_t end = 0;
        std::size_t edge = 0;
    };

    /// Fills in edges_, the shadow's own first, the outermost last. `penumbra_m`, `penumbra_px`: the width of the half
    /// outside.
    void choose_edges(double size_m, double penumbra_m, double penumbra_px) {
        const double strip_m = strip_share * size_m;
        const double dark = (1.0 - static_cast<double>(shadow_share)) * std::min(strip_m / (2.0 * penumbra_m), 1.0);
        const double most = std::clamp(std::ceil(dark / min_step) - 1.0, 1.0, static_cast<double>(max_edges));
        const int count = penumbra_px < 0.5 ? 0 : static_cast<int>(std::min(std::ceil(penumbra_px / edge_px), most));
        edges_ = {{0.0, static_cast<float>(1.0 - dark)}};
        for (int i = count - 1; i >= 0; --i) {
            edges_.push_back(
                {penumbra_m * (1.0 - (i + 0.5) / count), static_cast<float>(1.0 - dark * (i + 1) / (count + 1))});
        }
    }

    /// The length of the light's path from the middle of the box to the ground; negative if it reaches no ground, or
    /// the middle is below the ground.
    double light_path_m(const OrientedBox& hull, const landscape::Ground& ground, const glm::dvec3& eye_m) const {
        const glm::dvec3 from_m = hull.centre_m + eye_m;
        const auto height_over_ground_m = [&](double path_m) -> std::optional<double> {
            const glm::dvec3 at_m = from_m - to_sun_ * path_m;
            const std::optional<double> ground_m = ground.height_at(at_m.x, at_m.y);
            return ground_m ? std::optional<double>(at_m.z - *ground_m) : std::nullopt;
        };
        const double min_step_m = radius_m(hull);
        double above_m = 0.0;
        double path_m = 0.0;
        for (int step = 0; step < max_march_steps; ++step) {
            const std::optional<double> height_m = height_over_ground_m(path_m);
            if (!height_m || (step == 0 && *height_m < 0.0)) { return -1.0; }
            if (*height_m <= 0.0) {
                for (int halving = 0; halving < 20; ++halving) {
                    const double middle_m = 0.5 * (above_m + path_m);
                    (height_over_ground_m(middle_m).value_or(0.0) > 0.0 ? above_m : path_m) = middle_m;
                }
                return path_m;
            }
            above_m = path_m;
            path_m += std::max(min_step_m, 0.25 * *height_m / to_sun_.z);
        }
        return -1.0;
    }

    /// A model in its place, and how strong its discs are.
    struct Caster {
        const AircraftModel& model;
        std::span<const glm::dmat4> parts;
        std::span<const float> disc_strengths;
    };

    /// Collects the faces of all edges_, and of discs in place of their blades. `middle_m`: of the aircraft.
    void collect_faces(const Caster& caster, const glm::dvec3& middle_m) {
        const AircraftModel& model = caster.model;
        faces_.clear();
        face_corners_.clear();
        face_extents_.begin(to_sun_, middle_m);
        sunlit_.clear();
        sunlit_corners_.clear();
        const auto count = static_cast<std::uint32_t>(model.polygons.polygons.size());
        is_sunlit_.assign(count, false);
        for (std::uint32_t polygon = 0; polygon < count; ++polygon) {
            const std::uint32_t disc = model.discs.empty() ? models::none : model.disc_of_polygon[polygon];
            if (disc != models::none && caster.disc_strengths[disc] >= 1.0F) { continue; }
            place_polygon(model, caster.parts, polygon, part_);
            if (glm::dot(plane_of(part_).normal, to_sun_) <= 0.0) { continue; }
            is_sunlit_[polygon] = true;
            sunlit_.push_back({sunlit_corners_.size(), part_.size(), polygon});
            sunlit_corners_.insert(sunlit_corners_.end(), part_.begin(), part_.end());
        }
        const double outermost_m = edges_.back().grown_m;
        add_faces(0, 1, hidden_share * outermost_m);
        std::erase_if(sunlit_, [&](const SunlitPolygon& one) {
            const auto first = model.neighbours.begin() + model.first_vertices[one.polygon];
            const auto end = model.neighbours.begin() + model.first_vertices[one.polygon + 1];
            return std::all_of(
                first, end, [&](std::uint32_t other) { return other != models::none && is_sunlit_[other]; });
        });
        add_faces(1, edges_.size(), cell_share * outermost_m);
        for (std::uint32_t disc = 0; disc < model.discs.size(); ++disc) {
            if (caster.disc_strengths[disc] > 0.0F) { add_disc(caster, disc); }
        }
    }

    /// Adds a disc, with an edge of its own: it leaves more light than the whole shadow.
    void add_disc(const Caster& caster, std::uint32_t disc) {
        constexpr float covered = 0.21F; // of the light, as RotorDisc is drawn
        constexpr int corners = 24;
        const WorldCircle circle = place_disc(caster.model, caster.parts, disc, 0);
        const double facing = glm::dot(circle.axis, to_sun_);
        if (std::abs(facing) < 0.02) { return; } // edge-on
        const glm::dvec3 right = glm::normalize(
            glm::cross(circle.axis, std::abs(circle.axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        const glm::dvec3 up = glm::cross(circle.axis, right) * (facing > 0.0 ? 1.0 : -1.0);
        part_.clear();
        for (int i = 0; i < corners; ++i) {
            const double turn = 2.0 * pi * i / corners;
            part_.push_back(
                {circle.centre_m + circle.radius_m * (std::cos(turn) * right + std::sin(turn) * up), false});
        }
        const float dark = 1.0F - edges_.front().light;
        edges_.push_back({0.0, 1.0F - dark * covered * caster.disc_strengths[disc]});
        add_face(edges_.size() - 1);
    }

    /// Adds the polygons of sunlit_ to the faces of edges_[begin] to edges_[end - 1], grown: those in one cell across
    /// the light as one octagon, those longer than a cell each by itself.
    void add_faces(std::size_t begin, std::size_t end, double cell_m) {
        long_.clear();
        in_cells_.clear();
        const auto corners_of = [&](const SunlitPolygon& one) {
            return std::span(std::as_const(sunlit_corners_)).subspan(one.first, one.count);
        };
        for (const SunlitPolygon& one : sunlit_) {
            if (const auto cell = face_extents_.cell_of(corners_of(one), cell_m)) {
                in_cells_.emplace_back(*cell, one);
            } else {
                long_.push_back(one);
            }
        }
        std::ranges::stable_sort(in_cells_, {}, &CellPolygon::first);
        octagons_.clear();
        for (std::size_t i = 0; i < in_cells_.size(); ++i) {
            const auto& [cell, one] = in_cells_[i];
            if (i == 0 || in_cells_[i - 1].first != cell) { octagons_.emplace_back(); }
            face_extents_.extend(octagons_.back(), corners_of(one));
        }
        for (std::size_t edge = begin; edge < end; ++edge) {
            const double grown_m = edges_[edge].grown_m;
            for (const SunlitPolygon& one : long_) {
                const auto corners = corners_of(one);
                part_.assign(corners.begin(), corners.end());
                if (grown_m > 0.0) { grow(part_, grown_m, to_sun_, scratch_); }
                add_face(edge);
            }
            for (const LightExtents::Octagon& octagon : octagons_) {
                face_extents_.corners_of(octagon, grown_m, part_);
                add_face(edge);
            }
        }
    }

    /// Adds part_ as a face.
    void add_face(std::size_t edge) {
        faces_.push_back({face_corners_.size(), part_.size(), edge});
        face_extents_.add(part_);
        face_corners_.insert(face_corners_.end(), part_.begin(), part_.end());
    }

    void cast_on(std::uint32_t triangle) {
        const Plane plane = plane_of(triangle_);
        const double slope = glm::dot(plane.normal, to_sun_);
        if (slope <= 0.01 || plane.offset_m <= 0.0 || plane.normal.z <= 0.0) {
            return; // It faces away from the sun or from the eye.
        }
        std::array<Plane, 3> sides;
        for (std::size_t i = 0; i < 3; ++i) { sides[i] = side_of(triangle_[i].at_m, triangle_[(i + 1) % 3].at_m); }
        shadow_parts_.clear();
        part_ends_.clear();
        face_extents_.find(triangle_, faces_on_triangle_);
        if (faces_on_triangle_.empty()) { return; }
        const std::uint32_t* const corners_of_triangle = &ground_->triangles.indices[std::size_t{3} * triangle];
        for (std::size_t i = 0; i < 3; ++i) {
            corner_colours_[i] = unpacked(ground_->triangles.vertices[corners_of_triangle[i]].colour);
        }
        surface_ = scene::surface_of(ground_->triangles, ground_->water, corners_of_triangle);
        auto next = faces_on_triangle_.begin();
        for (std::size_t edge = 0; edge < edges_.size(); ++edge) {
            const std::size_t first = pieces_.indices.size();
            for (; next != faces_on_triangle_.end() && faces_[*next].edge == edge; ++next) {
                const Face& face = faces_[*next];
                const auto corners = std::span(face_corners_).subspan(face.first, face.count);
                part_.assign(corners.begin(), corners.end());
                clip_to_front(part_, plane, 0.0, scratch_);
                for (ViewVertex& corner : part_) { corner.at_m -= to_sun_ * (distance_m(plane, corner.at_m) / slope); }
                const std::size_t before = shadow_parts_.size();
                shadow_parts_.insert(shadow_parts_.end(), part_.begin(), part_.end());
                for (std::size_t i = 0; i < 3 && !part_.empty(); ++i) { clip_to_front(part_, sides[i], 0.0, scratch_); }
                if (part_.size() >= 3) {
                    add_piece(edges_[edge].light);
                    part_ends_.push_back({shadow_parts_.size(), edge});
                } else {
                    shadow_parts_.resize(before);
                }
            }
            pieces_.add_range(triangle, GroundLayer::Shadow, first, edges_[edge].light);
        }
        if (!pieces_.decals.empty() && !part_ends_.empty()) { add_on_decals(triangle); }
    }

    /// As depth_offset_factor(); by depth a dark shadow is in front of a lighter one by up to 128 float steps.
    float depth_factor(GroundLayer layer, float light) const {
        const float factor = depth_offset_factor(layer);
        return ground_->is_front_to_back ? factor - (1.0F - light) * 0x1p-16F : factor;
    }

    /// Adds part_ as a fan with the colours of triangle_, darkened.
    void add_piece(float light) {
        const glm::dvec3& a = triangle_[0].at_m;
        const glm::dvec3& b = triangle_[1].at_m;
        const glm::dvec3& c = triangle_[2].at_m;
        const double whole = signed_area2(a, b, c);
        for (const ViewVertex& at : part_) {
            const double share_a = signed_area2(at.at_m, b, c) / whole;
            const double share_b = signed_area2(a, at.at_m, c) / whole;
            const glm::vec4 colour = corner_colours_[0] * static_cast<float>(share_a) +
                                     corner_colours_[1] * static_cast<float>(share_b) +
                                     corner_colours_[2] * static_cast<float>(1.0 - share_a - share_b);
            pieces_.vertices->push_back({glm::vec3(at.at_m) * depth_factor(GroundLayer::Shadow, light),
                shaded(colour, ground_->has_light_in_alpha, light)});
        }
        pieces_.add_fan(part_.size(), surface_);
    }

    /// Adds the shadows on a triangle again, clipped to its decals and in their darkened colours.
    void add_on_decals(std::uint32_t triangle) {
        const auto triangle_of = [&](std::uint32_t decal) { return pieces_.decals[decal].triangle; };
        const auto own = std::ranges::equal_range(decals_by_triangle_, triangle, {}, triangle_of);
        for (std::size_t edge = 0; edge < edges_.size(); ++edge) {
            const std::size_t first = pieces_.indices.size();
            for (const std::uint32_t decal : own) { add_on_decal(pieces_.decals[decal], edge); }
            pieces_.add_range(triangle, GroundLayer::ShadowOnDecal, first, edges_[edge].light);
        }
    }

    void add_on_decal(const GroundDecal& decal, std::size_t edge) {
        const auto corners = pieces_.corners_of(decal);
        const float light = edges_[edge].light;
        const float factor = depth_factor(GroundLayer::ShadowOnDecal, light);
        std::size_t begin = 0;
        for (const Part& part : part_ends_) {
            const std::size_t first = std::exchange(begin, part.end);
            if (part.edge != edge) { continue; }
            part_.assign(shadow_parts_.begin() + static_cast<std::ptrdiff_t>(first),
                shadow_parts_.begin() + static_cast<std::ptrdiff_t>(part.end));
            for (std::size_t i = 0; i < corners.size() && !part_.empty(); ++i) {
                const glm::dvec3& next_m = corners[i + 1 < corners.size() ? i + 1 : 0];
                clip_to_front(part_, side_of(corners[i], next_m), 0.0, scratch_);
            }
            for (const ViewVertex& at : part_) {
                pieces_.vertices->push_back(
                    {glm::vec3(at.at_m) * factor, shaded(unpacked(decal.colour), false, light)});
            }
            pieces_.add_fan(part_.size(), decal.surface);
        }
    }

    void sort_decals() {
        if (decals_by_triangle_.size() == pieces_.decals.size()) { return; }
        decals_by_triangle_.resize(pieces_.decals.size());
        std::iota(decals_by_triangle_.begin(), decals_by_triangle_.end(), 0U);
        std::ranges::stable_sort(
            decals_by_triangle_, {}, [&](std::uint32_t decal) { return pieces_.decals[decal].triangle; });
    }

    PieceList& pieces_;
    std::optional<GroundPieces::Ground> ground_;
    glm::dvec3 to_sun_{0.0, 0.0, 1.0};
    std::vector<std::uint32_t> decals_by_triangle_; ///< Indices into PieceList::decals.
    std::vector<std::uint32_t> candidates_;
    std::vector<Edge> edges_;
    std::vector<SunlitPolygon> sunlit_;
    std::vector<ViewVertex> sunlit_corners_;
    std::vector<bool> is_sunlit_;       ///< one for each polygon of the model
    std::vector<SunlitPolygon> long_;   ///< longer than a cell
    std::vector<CellPolygon> in_cells_; ///< the others, by cell
    std::vector<LightExtents::Octagon> octagons_;
    std::vector<Face> faces_;
    std::vector<ViewVertex> face_corners_;
    LightExtents face_extents_;                    ///< Of faces_.
    std::vector<std::uint32_t> faces_on_triangle_; ///< Those that may cast a shadow on triangle_.
    ViewPolygon triangle_;
    std::array<glm::vec4, 3> corner_colours_{}; ///< Of triangle_.
    models::SurfaceClass surface_ = models::SurfaceClass::Terrain;
    ViewPolygon part_;
    /// The shadows in one triangle's plane that intersect it, not clipped to it, and where each ends in that list.
    std::vector<ViewVertex> shadow_parts_;
    std::vector<Part> part_ends_;
    ViewPolygon scratch_;
};

struct GroundPieces::Memory {
    PieceList list;
    DecalClipper clipper{list};
    ShadowCaster caster{list};
    scene::TriangleDraw triangles;
};

GroundPieces::GroundPieces() : memory_(std::make_unique<Memory>()) {}

GroundPieces::~GroundPieces() = default;

void GroundPieces::begin(
    const Ground& ground, std::vector<models::ColourVertex>& vertices, std::vector<models::SurfaceClass>& surfaces) {
    memory_->list.begin(ground, vertices, surfaces);
    memory_->clipper.begin(ground);
    memory_->caster.begin(ground);
    memory_->triangles = ground.triangles;
}

void GroundPieces::lay(nature::GroundDecoration& decoration, int max_triangles) {
    memory_->clipper.lay(decoration, max_triangles);
}

void GroundPieces::cast(
    const PlacedAircraft& aircraft, const OrientedBox& hull, const glm::dvec3& to_sun, double max_error_px) {
    memory_->caster.cast(aircraft, hull, to_sun, max_error_px);
}

GroundFrame GroundPieces::finish() {
    PieceList& list = memory_->list;
    std::ranges::sort(list.pieces, {},
        [](const PieceRange& piece) { return std::tuple(piece.triangle, piece.layer, -piece.light, piece.first); });
    return {memory_->triangles, list.pieces, list.indices};
}

std::span<const GroundDecal> GroundPieces::decals() const { return memory_->list.decals; }

std::span<const glm::dvec3> GroundPieces::corners_of(const GroundDecal& decal) const {
    return memory_->list.corners_of(decal);
}

int GroundPieces::decal_triangles() const { return memory_->list.decal_triangles; }

} // namespace octant::visuals::planning
