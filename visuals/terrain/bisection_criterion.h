#pragma once

#include "sim/base/float4.h"
#include "visuals/terrain/bisection_tiles.h"
#include "visuals/terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::terrain {

/// Vertical distances from the eye to the ground around a block. A block is a node with height bounds.
struct VerticalDistances {
    /// The smallest squared vertical distance to the block and to some of its neighbours. The index is a sum: 1
    /// includes the neighbours beyond its west side, 2 east, 4 south, 8 north.
    std::array<float, 16> squared_m2{};
    /// For the same neighbours the smallest vertical part of the depth: the height above the eye times the vertical
    /// part of the direction of view, in metres. The depth of a place in the picture is this plus its horizontal part.
    std::array<float, 16> ahead_m{};
    float lowest_m = 0.0F; ///< The lowest of the block's own samples.
    float highest_m = 0.0F;
};

/// Fast access to the numbers of a level of GroundTiles by node. The numbers of a node's fan lie close together.
class LevelReader {
public:
    using FourCodes = std::array<std::uint8_t, 4>;

    /// The location of a node's numbers: the memory of its tile, and the index of the node in it.
    struct NodeSlot {
        const std::byte* tile;
        std::size_t node;
    };

    /// The ground's memory must outlive it.
    LevelReader(const GroundTiles& ground, int level)
        : memory_(ground.memory().data()), corners_(ground.layout().corners()), at_(ground.layout().level(level)),
          validator_(&ground.validator()), level_(level), mask_((1 << at_.tile_shift) - 1) {}

    int edge() const { return at_.edge; }

    int columns() const { return at_.columns; }

    int rows() const { return at_.rows; }

    NodeSlot slot(int column, int row) const {
        const std::size_t tile = at_.tile_of(column, row);
        validator_->ensure_valid(level_, tile);
        return {memory_ + at_.offset_of(tile), at_.node_in_tile(column, row)};
    }

    /// The error codes of the mid-points of a node's fan_edges.
    FourCodes middle_codes(int column, int row, MorphMargin morph_margin) const {
        const NodeSlot own = slot(column, row);
        const auto r = static_cast<std::size_t>(morph_margin);
        return {*error(own, NodePart::South, morph_margin),
            *(column + 1 == at_.columns ? codes(at_.east_errors[r]) + row
                                        : error(east_of(own, column, row), NodePart::West, morph_margin)),
            *(row + 1 == at_.rows ? codes(at_.north_errors[r]) + column
                                  : error(north_of(own, column, row), NodePart::South, morph_margin)),
            *error(own, NodePart::West, morph_margin)};
    }

    /// The error codes of the centres of the four children of one node of the level above, the first of which is at
    /// (column, row); meaningless for children that do not exist.
    FourCodes child_codes(int column, int row, MorphMargin morph_margin) const {
        const std::uint8_t* first = error(slot(column, row), NodePart::Centre, morph_margin);
        const std::uint8_t* above = first + (std::ptrdiff_t{1} << at_.tile_shift);
        return {first[0], first[1], above[0], above[1]};
    }

    std::uint8_t centre_code(int column, int row, MorphMargin morph_margin) const {
        return *error(slot(column, row), NodePart::Centre, morph_margin);
    }

    /// The stored height of the root's corner in a quadrant.
    std::int16_t corner_height(std::size_t quadrant) const { return heights(corners_)[quadrant]; }

    std::int16_t centre_height(const NodeSlot& own) const { return *height(own, NodePart::Centre); }

    /// The stored height of the mid-point of one of a node's fan_edges.
    std::int16_t middle_height(const NodeSlot& own, int column, int row, std::size_t edge) const {
        switch (edge) {
        case 0:
            return *height(own, NodePart::South);
        case 1:
            return *(column + 1 == at_.columns ? heights(at_.east_heights) + row
                                               : height(east_of(own, column, row), NodePart::West));
        case 2:
            return *(row + 1 == at_.rows ? heights(at_.north_heights) + column
                                         : height(north_of(own, column, row), NodePart::South));
        default:
            return *height(own, NodePart::West);
        }
    }

private:
    const std::uint8_t* codes(std::size_t offset) const {
        return reinterpret_cast<const std::uint8_t*>(memory_ + offset);
    }

    const std::int16_t* heights(std::size_t offset) const {
        return reinterpret_cast<const std::int16_t*>(memory_ + offset);
    }

    const std::uint8_t* error(const NodeSlot& slot, NodePart part, MorphMargin morph_margin) const {
        return reinterpret_cast<const std::uint8_t*>(slot.tile) + at_.error_offset(part, morph_margin, slot.node);
    }

    const std::int16_t* height(const NodeSlot& slot, NodePart part) const {
        return reinterpret_cast<const std::int16_t*>(slot.tile + at_.height_offset(part, slot.node));
    }

    NodeSlot east_of(const NodeSlot& own, int column, int row) const {
        return (column & mask_) != mask_ ? NodeSlot{own.tile, own.node + 1} : slot(column + 1, row);
    }

    NodeSlot north_of(const NodeSlot& own, int column, int row) const {
        return (row & mask_) != mask_ ? NodeSlot{own.tile, own.node + (std::size_t{1} << at_.tile_shift)}
                                      : slot(column, row + 1);
    }

    const std::byte* memory_;
    std::size_t corners_;
    GroundLayout::Level at_;
    const TileValidator* validator_;
    int level_;
    int mask_;
};

/// Bounds the size in a picture of errors in boxes; bisection_criterion.cpp derives the bound.
class BoxErrorBound {
public:
    /// The boxes of influence of four samples: their ends in samples from the eye, and, over each box, the minimum of
    /// the squared vertical distance (`gap_m2`) and of the vertical part of the depth (`ahead_m`).
    struct FourBoxes {
        Float4 west;
        Float4 east;
        Float4 south;
        Float4 north;
        Float4 gap_m2;
        Float4 ahead_m;
    };

    explicit BoxErrorBound(double spacing_m)
        : spacing_m_(spacing_m), spacing_squared_m2_(static_cast<float>(spacing_m * spacing_m)) {}

    /// Sets the direction of view and the cosine of the angle between it and the picture's corners. With a zero
    /// direction the picture is a sphere around the eye.
    void set_direction(const glm::dvec3& ahead, double corner_cos);

    /// Whether the view has a direction.
    bool has_direction() const { return has_direction_; }

    /// The squares of lower bounds of m, where an error e anywhere in a box is at most focal length
    /// * e / m pixels.
    Float4 squared_m2(const FourBoxes& boxes) const;

private:
    /// The components, along a level direction, of one sample's step east and one north, in metres.
    struct AxisProjection {
        float east_m = 0.0F;
        float north_m = 0.0F;
    };

    /// The extent of boxes along a direction.
    struct Range {
        Float4 min_m;
        Float4 max_m;
    };

    static Range range_along(const FourBoxes& boxes, const AxisProjection& along);
    Float4 min_share(const FourBoxes& boxes, const Range& level) const;

    double spacing_m_;
    float spacing_squared_m2_;
    bool has_direction_ = false;
    AxisProjection ahead_; ///< The level part of the direction.
    AxisProjection aside_; ///< Square to it, times the sine of the pitch.
    float level_ = 1.0F;   ///< The cosine of the pitch.
    float corner_cos_squared_ = 1.0F;
    float max_aside_squared_ = 0.0F; ///< The largest ratio of sideways distance to depth in a picture, squared.
    float near_factor_ = 1.0F;
};

/// The squared distances along one axis from the eye to four boxes that reach from `before` to `after`, in samples^2.
inline Float4 squared_distance(Float4 before, Float4 after) {
    const Float4 off = max4(max4(before, -after), splat4(0.0F));
    return off * off;
}

/// The minimum of the linear function slope * x over x from `before` to `after`; with exchanged arguments its maximum.
inline Float4 min_along(Float4 before, Float4 after, float slope) {
    return splat4(slope) * (slope > 0.0F ? before : after);
}

inline BoxErrorBound::Range BoxErrorBound::range_along(const FourBoxes& b, const AxisProjection& along) {
    return {min_along(b.west, b.east, along.east_m) + min_along(b.south, b.north, along.north_m),
        min_along(b.east, b.west, along.east_m) + min_along(b.north, b.south, along.north_m)};
}

/// Lower bounds, at or above zero, of the ratio of depth to level distance ahead or behind, for points in the picture.
inline Float4 BoxErrorBound::min_share(const FourBoxes& b, const Range& level) const {
    constexpr float min_divisor_m = 1e-6F; // in place of a division by zero
    // Only a picture that shows the nadir or the zenith shows points behind the eye. Above 1 because of rounding.
    constexpr float sees_nadir = 1.0001F;
    const Float4 worst_m = b.ahead_m < splat4(0.0F) ? level.min_m : level.max_m;
    const Float4 before = splat4(1.0F) + b.ahead_m / max4(worst_m, splat4(min_divisor_m));
    Float4 share = before;
    if (level_ * level_ + corner_cos_squared_ < sees_nadir) {
        const Float4 behind = b.ahead_m / max4(-level.min_m, splat4(min_divisor_m)) - splat4(1.0F);
        share = level.min_m < splat4(0.0F) ? min4(before, behind) : before;
    }
    return splat4(level_) * max4(share, splat4(0.0F));
}

inline Float4 BoxErrorBound::squared_m2(const FourBoxes& b) const {
    const Float4 distance_m2 =
        max4(splat4(spacing_squared_m2_) * (squared_distance(b.west, b.east) + squared_distance(b.south, b.north)) +
                 b.gap_m2,
            splat4(1.0F));
    if (!has_direction_) { return distance_m2; }
    const Range level = range_along(b, ahead_);
    const Float4 depth_m = max4(level.min_m + b.ahead_m, splat4(0.0F));
    const Float4 depth_m2 = max4(depth_m * depth_m, splat4(corner_cos_squared_) * distance_m2);
    const Range aside = range_along(b, aside_);
    const Float4 aside_m2 = max4(aside.min_m * aside.min_m, aside.max_m * aside.max_m);
    const Float4 share = min_share(b, level);
    const Float4 across = splat4(1.0F) / (share * share) + min4(aside_m2 / depth_m2, splat4(max_aside_squared_));
    return depth_m2 * max4(splat4(1.0F) / across, splat4(near_factor_));
}

/// A node, with the vertical distances of its block.
struct NodeContext {
    int level = 0;
    int column = 0;
    int row = 0;
    const VerticalDistances* distances = nullptr; ///< Those of the node, or of its ancestor of range_level.
};

/// The critical values and errors of the samples that a node's fan may have.
struct FanCriticalValues {
    Float4 middle;           ///< The mid-points of fan_edges.
    Float4 quadrant;         ///< The centres of the children; meaningless where there is no child.
    Float4 quadrant_error_m; ///< The errors of those centres.
};

/// Decides by screen-space error which samples of a ground belong to the mesh of a view.
class BisectionCriterion {
public:
    /// The ground must outlive the criterion.
    explicit BisectionCriterion(const GroundTiles& ground);

    /// Sets the view for the following calls. Errors include this share, 0 to 1, of the full morph margin
    /// (bisection_tile_builder.cpp).
    void set_view(const MeshView& view, double margin_share = 1.0);

    const GroundTiles& ground() const { return *ground_; }

    const LevelReader& memory(int level) const { return levels_[static_cast<std::size_t>(level)].memory; }

    const MeshView& view() const { return view_; }

    /// The x coordinate of the field's west border relative to the eye.
    double west_m() const { return west_m_; }

    /// The y coordinate of the field's south border relative to the eye.
    double south_m() const { return south_m_; }

    /// The limit for a target error in pixels, about (focal length / error)^2: a larger limit gives a finer mesh. A
    /// sample is in the mesh when its critical value is below the limit.
    float limit_of(double error_px) const;

    /// The error in pixels that belongs to a limit.
    double error_px_of(float limit) const;

    /// The vertical distances of a node; its level must have height ranges.
    VerticalDistances vertical_distances_of(int level, int column, int row) const;

    /// The error of the root's centre.
    float root_error_m() const;

    /// The critical values of a node's fan. `place.distances` must be set.
    FanCriticalValues criticals_of(const NodeContext& place) const;

    /// The largest error of the samples that need a node's centre, in errors of the centre.
    float share_below_centre(int level, int column, int row) const;

    /// The largest error of the samples that need the middle of one of a node's fan_edges, in errors of that middle.
    float share_below_middle(int level, int column, int row, std::size_t edge) const;

    /// crossed_planes (frustum.h) for a box around all triangles of a node in any mesh, whose vertices are drawn up to
    /// `margin_m` above or below the node's samples. `lowest_m`, `highest_m`: of the node, or of its ancestor of
    /// range_level.
    unsigned crossed_planes_of_node(
        const NodeContext& place, float lowest_m, float highest_m, float margin_m, unsigned planes) const;

    /// The drop of the ground by the earth's curvature at a point, given in metres east and north of the eye.
    template <typename Real>
    Real drop_m(Real east_m, Real north_m) const {
        return static_cast<Real>(half_curvature_per_m_) * (east_m * east_m + north_m * north_m);
    }

private:
    /// A level of the ground, and the errors that the earth's curvature adds there.
    struct Level {
        LevelReader memory;
        float half_edge;
        float middle_error_m = 0.0F;
        float quadrant_error_m = 0.0F;
    };

    void set_margin_share(float share);
    Float4 middle_errors_m(int level, int column, int row) const;
    Float4 child_errors_m(int level, int column, int row) const;
    float centre_error_m(int level, int column, int row) const;
    template <typename Codes>
    Float4 errors_m(const Codes& codes_with) const;

    const GroundTiles* ground_;
    MeshView view_;
    std::vector<Level> levels_;
    /// An error is the sum of both: the metres of its code with full margin times margin_share, and of its code without
    /// margin times the rest.
    std::array<float, 256> full_margin_m_{};
    std::array<float, 256> no_margin_m_{};
    bool has_full_margin_ = true;
    double west_m_ = 0.0;
    double south_m_ = 0.0;
    double half_curvature_per_m_ = 0.0;
    BoxErrorBound reach_;
    float eye_z_m_ = 0.0F;
    int range_level_ = 0;
    int origin_column_ = 0; ///< The sample at the eye or next to it in the south-west.
    int origin_row_ = 0;
    float eye_east_ = 0.0F; ///< The eye in samples from there.
    float eye_north_ = 0.0F;
};

} // namespace octant::visuals::terrain
