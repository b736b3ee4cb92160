#pragma once

#include "visuals/terrain/box_reach.h"
#include "visuals/terrain/four_floats.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/ground_tiles.h"
#include "visuals/terrain/height_gaps.h"
#include "visuals/terrain/level_memory.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::terrain {

/// A node, with what its ancestors know about it.
struct ErrorPlace {
    int level = 0;
    int column = 0;
    int row = 0;
    const HeightGaps* gaps = nullptr; ///< Those of the node or of its ancestor of range_level.
};

/// The critical values and errors of the samples that a node's fan may have.
struct FanCriticals {
    FourFloats middle;   ///< The mid-points of fan_edges.
    FourFloats quadrant; ///< The centres of the children; meaningless where there is no child.
    FourFloats quadrant_error_m; ///< The errors of those centres.
};

/// Decides by screen-space error which samples of a ground belong to the mesh of a view.
class ErrorRule {
public:
    /// The ground must outlive the rule.
    explicit ErrorRule(const GroundTiles& ground);

    /// Judges by this view from now on, until it is given another. Errors are those with this share
    /// of the full room to move (tile_builder_errors.cpp), from 0 to 1.
    void look_from(const MeshView& view, double room_share = 1.0);

    const GroundTiles& ground() const { return *ground_; }

    const LevelMemory& memory(int level) const {
        return levels_[static_cast<std::size_t>(level)].memory;
    }

    const MeshView& view() const { return view_; }

    /// The x coordinate of the field's west border relative to the eye.
    double west_m() const { return west_m_; }

    /// The y coordinate of the field's south border relative to the eye.
    double south_m() const { return south_m_; }

    /// The limit for a wanted error in pixels. A sample is in the mesh when its critical value is
    /// below the limit.
    float limit_of(double error_px) const;

    /// The error in pixels that belongs to a limit.
    double error_px_of(float limit) const;

    /// The gaps of a node; its level must have height bounds.
    HeightGaps gaps_around(int level, int column, int row) const;

    /// The error of the root's centre.
    float root_error_m() const;

    /// The critical values of a node's fan. `place.gaps` must be set.
    FanCriticals criticals_of(const ErrorPlace& place) const;

    /// The largest error of the samples that need a node's centre, in errors of the centre.
    float share_below_centre(int level, int column, int row) const;

    /// The same for the middle of one of a node's fan_edges.
    float share_below_middle(int level, int column, int row, std::size_t edge) const;

    /// planes_cutting (frustum.h) for all that a mesh may draw of a node, where heights are drawn
    /// up to `margin_m` beyond those of the node's samples.
    unsigned planes_cutting_node(
        const ErrorPlace& place, const HeightGaps& gaps, float margin_m, unsigned planes) const;

    /// How much the ground is lowered at a place, given in metres east and north of the eye.
    template <typename Real>
    Real drop_m(Real east_m, Real north_m) const {
        return static_cast<Real>(half_curvature_per_m_) * (east_m * east_m + north_m * north_m);
    }

private:
    /// A level of the ground, and the errors that the earth's curvature adds there.
    struct Level {
        LevelMemory memory;
        float half_edge;
        float middle_error_m = 0.0F;
        float quadrant_error_m = 0.0F;
    };

    void share_room(float share);
    FourFloats middle_errors_m(int level, int column, int row) const;
    FourFloats child_errors_m(int level, int column, int row) const;
    float centre_error_m(int level, int column, int row) const;
    template <typename Codes>
    FourFloats errors_m(const Codes& codes_with) const;

    const GroundTiles* ground_;
    MeshView view_;
    std::vector<Level> levels_;
    /// For each code of an error with full room the share of it that counts, and the same for those
    /// without room: an error is the sum of both.
    std::array<float, 256> full_room_m_{};
    std::array<float, 256> no_room_m_{};
    bool has_full_room_ = true;
    double west_m_ = 0.0;
    double south_m_ = 0.0;
    double half_curvature_per_m_ = 0.0;
    BoxReach reach_;
    float eye_z_m_ = 0.0F;
    int range_level_ = 0;
    int origin_column_ = 0; ///< The sample at the eye or next to it in the south-west.
    int origin_row_ = 0;
    float eye_east_ = 0.0F; ///< The eye in samples from there.
    float eye_north_ = 0.0F;
};

} // namespace octant::visuals::terrain
