#pragma once

#include "visuals/terrain/box_error_bound.h"
#include "visuals/terrain/float4.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/ground_tiles.h"
#include "visuals/terrain/vertical_distances.h"
#include "visuals/terrain/level_reader.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::terrain {

/// A node, with what its ancestors know about it.
struct NodeContext {
    int level = 0;
    int column = 0;
    int row = 0;
    const VerticalDistances* distances = nullptr; ///< Those of the node or of its ancestor of range_level.
};

/// The critical values and errors of the samples that a node's fan may have.
struct FanCriticalValues {
    Float4 middle;   ///< The mid-points of fan_edges.
    Float4 quadrant; ///< The centres of the children; meaningless where there is no child.
    Float4 quadrant_error_m; ///< The errors of those centres.
};

/// Decides by screen-space error which samples of a ground belong to the mesh of a view.
class BisectionCriterion {
public:
    /// The ground must outlive the rule.
    explicit BisectionCriterion(const GroundTiles& ground);

    /// Judges by this view from now on, until it is given another. Errors are those with this share
    /// of the full room to move (tile_builder_errors.cpp), from 0 to 1.
    void set_view(const MeshView& view, double margin_share = 1.0);

    const GroundTiles& ground() const { return *ground_; }

    const LevelReader& memory(int level) const {
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
    VerticalDistances vertical_distances_of(int level, int column, int row) const;

    /// The error of the root's centre.
    float root_error_m() const;

    /// The critical values of a node's fan. `place.gaps` must be set.
    FanCriticalValues criticals_of(const NodeContext& place) const;

    /// The largest error of the samples that need a node's centre, in errors of the centre.
    float share_below_centre(int level, int column, int row) const;

    /// The same for the middle of one of a node's fan_edges.
    float share_below_middle(int level, int column, int row, std::size_t edge) const;

    /// crossed_planes (frustum.h) for all that a mesh may draw of a node, where heights are drawn
    /// up to `margin_m` beyond those of the node's samples.
    unsigned crossed_planes_of_node(
        const NodeContext& place, const VerticalDistances& distances, float margin_m, unsigned planes) const;

    /// How much the ground is lowered at a place, given in metres east and north of the eye.
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
    /// For each code of an error with full room the share of it that counts, and the same for those
    /// without room: an error is the sum of both.
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
