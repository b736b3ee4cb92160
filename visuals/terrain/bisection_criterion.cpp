// Longest-edge bisection by screen-space error: P. Lindstrom, V. Pascucci, "Terrain Simplification Simplified: A
// General Framework for View-Dependent Out-of-Core Visualization", 2002, with saturated errors and nested regions of
// influence. A sample v, the middle of the longest edge of two triangles, is in the mesh if its error e(v), seen from
// the nearest point of its region of influence, is larger than the target error: if critical(v) = D2(v) / e(v)^2 <
// (focal length / target error)^2, where D2 is the squared distance.
//
// Deviations:
// - Regions are boxes, not spheres. Horizontally they are squares about a node's centre, of half
//   size 3h - 1, and about the middle of an edge, of half size 2h - 1, where h is half the node's
//   edge in samples; they contain all triangles that v may split and those that samples needing v
//   may split. Vertically they have the bounds of all blocks (nodes with height bounds, of v's
//   level where that has them) that the square overlaps.
// - D2 is at least 1 m^2.
// - In a flat picture an error off the middle counts for more than D says. At a place p, whose
//   depth is z = p f, where f is the direction of view, an error e moves a pixel by F e n / (z (z +
//   e f_z)), with n^2 = P^2 + f_z^2 R^2, where P and R are how far p lies ahead and aside on the
//   level. So D is replaced by a lower bound of z / (n / z) over what a picture can see of the box.
//   z is at least the least of the box, and at least D by the cosine of the picture's corners.
//   With a = p_z f_z, z = P |f_h| + a (h: horizontal part), so that z / P is at least |f_h| + a / P
//   for the least a of the box and its largest P, or its least P where a is below zero. R / z is at
//   most the largest R of the box over its least z, and at most the tangent at the picture's
//   corners. What lies behind the eye (P below zero) counts only where the picture's corners reach
//   the vertical: z is at most |a| there, which is at most |f_z| D. All are nested as D is. The
//   term e f_z is at most the target error: it adds one to F / target error.
// - On a curved earth, e(v) is the stored error plus what the edge that v halves rises above the
//   curve, L^2 / (8 R); the heights in D2 are not lowered.
//
// There are no cracks, because critical values never decrease from a sample to one that needs it, to the last bit. An
// edge's middle lies h from the centre it needs, and 2h - 1 + h = 3h - 1. A child's centre, with a box of 3h/2 - 1,
// lies (h/2, h/2) from the middles it needs, and h/2 + (3h/2 - 1) = 2h - 1. So the ends of boxes, which are whole
// numbers, are nested; subtracting the eye with rounding keeps their order, and so do all steps from there to the
// critical value: maximum, minimum, sum and product of non-negative numbers, and quotient. The bounds of a block
// contain those of finer blocks, and a box overlaps (a common line does not count) no block that is not within one that
// the larger box overlaps. Errors are nested as stored; those of curvature halve from each step to the next.
#include "visuals/terrain/bisection_criterion.h"

#include "visuals/terrain/fan_triangles.h"
#include "visuals/terrain/frustum.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

namespace octant::visuals::terrain {

namespace {

constexpr float no_end = std::numeric_limits<float>::infinity();

/// A number of a block and its neighbours, row after row from the south-west.
using NineBlocks = std::array<float, 9>;

/// The minimum of the block's own number and those of some neighbours, indexed as VerticalDistances::squared_m2.
std::array<float, 16> min_by_reach(const NineBlocks& of) {
    // Of each row with no neighbour, the western one, the eastern one and both.
    const auto row_min = [&of](std::size_t row) {
        const Float4 west = {no_end, of[3 * row], no_end, of[3 * row]};
        const Float4 east = {no_end, no_end, of[3 * row + 2], of[3 * row + 2]};
        return min4(min4(west, east), splat4(of[3 * row + 1]));
    };
    const Float4 own = row_min(1);
    const Float4 with_south = min4(own, row_min(0));
    const Float4 north = row_min(2);
    const std::array<Float4, 4> rows = {own, with_south, min4(own, north), min4(with_south, north)};
    std::array<float, 16> min{};
    std::memcpy(min.data(), rows.data(), sizeof(min));
    return min;
}

/// An eye farther from the field than this, in samples, is treated as being there, so that whole numbers of samples
/// stay exact in float.
constexpr double farthest_eye = 4194304.0;

/// More than the rounding of heights in double precision can amount to.
constexpr double criterion_margin_m = 1e-3;

// The ends of the boxes of influence, a sample farther out on each side, in half edges from a node's south-west corner:
// of the middles of its south, east, north and west edges, and of the centres of its four children.
constexpr Float4 west_of_middles = {-1.0F, 0.0F, -1.0F, -2.0F};
constexpr Float4 east_of_middles = {3.0F, 4.0F, 3.0F, 2.0F};
constexpr Float4 south_of_middles = {-2.0F, -1.0F, 0.0F, -1.0F};
constexpr Float4 north_of_middles = {2.0F, 3.0F, 4.0F, 3.0F};
constexpr Float4 west_of_centres = {-1.0F, 0.0F, -1.0F, 0.0F};
constexpr Float4 east_of_centres = {2.0F, 3.0F, 2.0F, 3.0F};
constexpr Float4 south_of_centres = {-1.0F, -1.0F, 0.0F, 0.0F};
constexpr Float4 north_of_centres = {2.0F, 2.0F, 3.0F, 3.0F};

/// The sample at or below a coordinate, clamped to farthest_eye.
int floor_to_sample(double place) {
    return static_cast<int>(std::floor(std::clamp(place, -farthest_eye, farthest_eye)));
}

float largest(Float4 of) { return std::max({of[0], of[1], of[2], of[3]}); }

} // namespace

void BoxErrorBound::set_direction(const glm::dvec3& ahead, double corner_cos) {
    has_direction_ = ahead != glm::dvec3(0.0);
    ahead_ = {static_cast<float>(ahead.x * spacing_m_), static_cast<float>(ahead.y * spacing_m_)};
    const double level = std::hypot(ahead.x, ahead.y);
    const double tilt = level > 0.0 ? std::abs(ahead.z) / level : 0.0;
    aside_ = {static_cast<float>(-tilt * ahead.y * spacing_m_), static_cast<float>(tilt * ahead.x * spacing_m_)};
    level_ = static_cast<float>(level);
    corner_cos_squared_ = static_cast<float>(corner_cos * corner_cos);
    const double corner = std::sqrt(1.0 - corner_cos * corner_cos) / corner_cos;
    const double max_aside = std::abs(ahead.z) * corner;
    max_aside_squared_ = static_cast<float>(max_aside * max_aside);
    const double max_across = level + max_aside;
    near_factor_ = static_cast<float>(1.0 / (max_across * max_across));
}

BisectionCriterion::BisectionCriterion(const GroundTiles& ground)
    : ground_(&ground), reach_(ground.spacing_m()), range_level_(ground.layout().range_level()) {
    for (int level = 0; level < ground.levels(); ++level) {
        const LevelReader memory(ground, level);
        levels_.push_back({memory, 0.5F * static_cast<float>(memory.edge())});
    }
}

void BisectionCriterion::set_view(const MeshView& view, double margin_share) {
    assert(view.focal_px > 0.0 && view.earth_radius_m >= 0.0);
    assert(margin_share >= 0.0 && margin_share <= 1.0);
    set_margin_share(static_cast<float>(margin_share));
    const glm::dvec2 half_m = ground_->half_extent_m();
    view_ = view;
    west_m_ = -half_m.x - view.eye_m.x;
    south_m_ = -half_m.y - view.eye_m.y;
    eye_z_m_ = static_cast<float>(view.eye_m.z);
    const double column = -west_m_ / ground_->spacing_m();
    const double row = -south_m_ / ground_->spacing_m();
    origin_column_ = floor_to_sample(column);
    origin_row_ = floor_to_sample(row);
    eye_east_ = static_cast<float>(std::clamp(column - origin_column_, 0.0, 1.0));
    eye_north_ = static_cast<float>(std::clamp(row - origin_row_, 0.0, 1.0));
    half_curvature_per_m_ = half_curvature(view.earth_radius_m);
    reach_.set_direction(view.ahead, view.corner_cos);
    // An edge that is halved by a node's side is 2h long, one by its child's centre sqrt(2) h.
    const double spacing_squared = ground_->spacing_m() * ground_->spacing_m();
    for (Level& level : levels_) {
        const double half = 0.5 * level.memory.edge();
        const double middle_m = half * half * spacing_squared * half_curvature_per_m_;
        level.middle_error_m = static_cast<float>(middle_m);
        level.quadrant_error_m = static_cast<float>(0.5 * middle_m);
    }
}

/// Fills in the tables of errors.
void BisectionCriterion::set_margin_share(float share) {
    has_full_margin_ = share == 1.0F;
    for (unsigned code = 0; code < 256; ++code) {
        const float error_m = ground_->codes().metres(static_cast<std::uint8_t>(code));
        full_margin_m_[code] = share * error_m;
        no_margin_m_[code] = (1.0F - share) * error_m;
    }
}

float BisectionCriterion::limit_of(double error_px) const {
    const double ratio = view_.focal_px / error_px + (reach_.has_direction() ? 1.0 : 0.0);
    return static_cast<float>(ratio * ratio);
}

double BisectionCriterion::error_px_of(float limit) const {
    const double ratio = std::sqrt(static_cast<double>(limit)) - (reach_.has_direction() ? 1.0 : 0.0);
    return view_.focal_px / std::max(ratio, 1e-6);
}

float BisectionCriterion::root_error_m() const {
    return centre_error_m(0, 0, 0) + 2.0F * levels_.front().middle_error_m;
}

VerticalDistances BisectionCriterion::vertical_distances_of(int level, int column, int row) const {
    const GroundLayout::Level& of_level = ground_->layout().level(level);
    const auto ahead_up = static_cast<float>(view_.ahead.z);
    NineBlocks gap{};
    NineBlocks ahead{};
    gap.fill(no_end);
    ahead.fill(no_end);
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            const int c = column + i - 1;
            const int r = row + j - 1;
            if (c < 0 || r < 0 || c >= of_level.columns || r >= of_level.rows) { continue; }
            const float low = ground_->lowest_m(level, c, r) - eye_z_m_;
            const float high = ground_->highest_m(level, c, r) - eye_z_m_;
            const float off = std::max({low, -high, 0.0F});
            gap[static_cast<std::size_t>(3 * j + i)] = off * off;
            ahead[static_cast<std::size_t>(3 * j + i)] = ahead_up * (ahead_up > 0.0F ? low : high);
        }
    }
    return {min_by_reach(gap), min_by_reach(ahead), ground_->lowest_m(level, column, row),
        ground_->highest_m(level, column, row)};
}

FanCriticalValues BisectionCriterion::criticals_of(const NodeContext& place) const {
    const Level& at = levels_[static_cast<std::size_t>(place.level)];
    const int edge = at.memory.edge();
    const auto x = static_cast<float>(place.column * edge - origin_column_);
    const auto y = static_cast<float>(place.row * edge - origin_row_);
    const auto first = [&at](float start, Float4 halves, float eye) {
        return splat4(start + 1.0F) + halves * splat4(at.half_edge) - splat4(eye);
    };
    const auto last = [&at](float start, Float4 halves, float eye) {
        return splat4(start - 1.0F) + halves * splat4(at.half_edge) - splat4(eye);
    };
    BoxErrorBound::FourBoxes middles{first(x, west_of_middles, eye_east_), last(x, east_of_middles, eye_east_),
        first(y, south_of_middles, eye_north_), last(y, north_of_middles, eye_north_), {}, {}};
    BoxErrorBound::FourBoxes centres{first(x, west_of_centres, eye_east_), last(x, east_of_centres, eye_east_),
        first(y, south_of_centres, eye_north_), last(y, north_of_centres, eye_north_), {}, {}};
    // On which sides the boxes of influence reach beyond the block: at its first and last node.
    const int last_node = (1 << std::max(place.level - range_level_, 0)) - 1;
    const auto reach = [&](int along) {
        const int within = along & last_node;
        return (within == 0 ? 1U : 0U) | (within == last_node ? 2U : 0U);
    };
    const unsigned across = reach(place.column);
    const unsigned up = reach(place.row) << 2U;
    const auto of_middles = [across, up](const std::array<float, 16>& from) {
        return Float4{
            from[across | (up & 4U)], from[(across & 2U) | up], from[across | (up & 8U)], from[(across & 1U) | up]};
    };
    const auto of_centres = [across, up](const std::array<float, 16>& from) {
        return Float4{from[(across & 1U) | (up & 4U)], from[(across & 2U) | (up & 4U)], from[(across & 1U) | (up & 8U)],
            from[(across & 2U) | (up & 8U)]};
    };
    middles.gap_m2 = of_middles(place.distances->squared_m2);
    centres.gap_m2 = of_centres(place.distances->squared_m2);
    middles.ahead_m = of_middles(place.distances->ahead_m);
    centres.ahead_m = of_centres(place.distances->ahead_m);
    FanCriticalValues criticals;
    const Float4 middle_error_m = middle_errors_m(place.level, place.column, place.row) + splat4(at.middle_error_m);
    criticals.middle = reach_.squared_m2(middles) / (middle_error_m * middle_error_m);
    if (place.level + 1 == ground_->levels()) {
        criticals.quadrant = splat4(std::numeric_limits<float>::infinity());
        criticals.quadrant_error_m = splat4(0.0F);
        return criticals;
    }
    const Float4 error_m = child_errors_m(place.level, place.column, place.row) + splat4(at.quadrant_error_m);
    criticals.quadrant = reach_.squared_m2(centres) / (error_m * error_m);
    criticals.quadrant_error_m = error_m;
    return criticals;
}

float BisectionCriterion::share_below_centre(int level, int column, int row) const {
    const Level& at = levels_[static_cast<std::size_t>(level)];
    const float below_m = largest(middle_errors_m(level, column, row)) + at.middle_error_m;
    return below_m / (centre_error_m(level, column, row) + 2.0F * at.middle_error_m);
}

float BisectionCriterion::share_below_middle(int level, int column, int row, std::size_t edge) const {
    if (level + 1 == ground_->levels()) { return 0.0F; }
    const Level& at = levels_[static_cast<std::size_t>(level)];
    const FanEdge& side = fan_edges[edge];
    const Float4 own = child_errors_m(level, column, row);
    float below_m = std::max(own[side.quadrant_a], own[side.quadrant_b]);
    const int beyond_column = column + side.beyond_east;
    const int beyond_row = row + side.beyond_north;
    if (beyond_column >= 0 && beyond_row >= 0 && beyond_column < at.memory.columns() && beyond_row < at.memory.rows()) {
        const Float4 beyond = child_errors_m(level, beyond_column, beyond_row);
        const unsigned across = side.beyond_east != 0 ? 1U : 2U;
        below_m = std::max({below_m, beyond[side.quadrant_a ^ across], beyond[side.quadrant_b ^ across]});
    }
    const float own_m = middle_errors_m(level, column, row)[edge] + at.middle_error_m;
    return (below_m + at.quadrant_error_m) / own_m;
}

/// The stored errors of the mid-points of a node's fan_edges, with the morph margin that counts.
inline Float4 BisectionCriterion::middle_errors_m(int level, int column, int row) const {
    const LevelReader& memory = levels_[static_cast<std::size_t>(level)].memory;
    return errors_m([&](MorphMargin morph_margin) { return memory.middle_codes(column, row, morph_margin); });
}

/// The same of the centres of its children; meaningless for children that do not exist.
inline Float4 BisectionCriterion::child_errors_m(int level, int column, int row) const {
    const LevelReader& below = levels_[static_cast<std::size_t>(level) + 1].memory;
    return errors_m([&](MorphMargin morph_margin) { return below.child_codes(2 * column, 2 * row, morph_margin); });
}

/// The same of its centre.
inline float BisectionCriterion::centre_error_m(int level, int column, int row) const {
    const LevelReader& memory = levels_[static_cast<std::size_t>(level)].memory;
    return full_margin_m_[memory.centre_code(column, row, MorphMargin::Full)] +
           no_margin_m_[memory.centre_code(column, row, MorphMargin::None)];
}

/// Errors by their codes for each MorphMargin. With full margin the others are not read.
template <typename Codes>
inline Float4 BisectionCriterion::errors_m(const Codes& codes_with) const {
    const auto metres = [](const std::array<float, 256>& of, const LevelReader::FourCodes& codes) {
        return Float4{of[codes[0]], of[codes[1]], of[codes[2]], of[codes[3]]};
    };
    const Float4 full_m = metres(full_margin_m_, codes_with(MorphMargin::Full));
    return has_full_margin_ ? full_m : full_m + metres(no_margin_m_, codes_with(MorphMargin::None));
}

unsigned BisectionCriterion::crossed_planes_of_node(
    const NodeContext& place, float lowest_m, float highest_m, float margin_m, unsigned planes) const {
    const int edge = memory(place.level).edge();
    const int west = place.column * edge;
    const int south = place.row * edge;
    const int east = std::min(west + edge, ground_->columns() - 1);
    const int north = std::min(south + edge, ground_->rows() - 1);
    const double half_spacing_m = 0.5 * ground_->spacing_m();
    const glm::dvec2 centre_m(west_m_ + (west + east) * half_spacing_m, south_m_ + (south + north) * half_spacing_m);
    const glm::dvec2 half_m((east - west) * half_spacing_m, (north - south) * half_spacing_m);
    const double margin = static_cast<double>(margin_m) + criterion_margin_m;
    double low_m = static_cast<double>(lowest_m) - view_.eye_m.z - margin;
    double high_m = static_cast<double>(highest_m) - view_.eye_m.z + margin;
    if (half_curvature_per_m_ > 0.0) {
        const glm::dvec2 off_m = glm::abs(centre_m);
        const glm::dvec2 far_m = off_m + half_m;
        const glm::dvec2 near_m = glm::max(off_m - half_m, glm::dvec2(0.0));
        low_m -= drop_m(far_m.x, far_m.y);
        high_m -= drop_m(near_m.x, near_m.y);
    }
    return crossed_planes(view_.frustum_normals, planes, {centre_m.x, centre_m.y, 0.5 * (low_m + high_m)},
        {half_m.x, half_m.y, 0.5 * (high_m - low_m)});
}

} // namespace octant::visuals::terrain
