#pragma once

#include "visuals/terrain/four_floats.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/ground_tiles.h"
#include "visuals/terrain/level_memory.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::visuals::terrain {

/// How far the eye is above or below the ground near a block: a node with height bounds.
struct HeightGaps {
    /// Squares of the distance to the block and those beside it, the least. Index: 1 with those
    /// beyond its west side, 2 east, 4 south, 8 north.
    std::array<float, 16> squared_m2{};
    float lowest_m = 0.0F; ///< of the block's samples
    float highest_m = 0.0F;
};

/// A node, and what its ancestors know for it.
struct ErrorPlace {
    int level = 0;
    int column = 0;
    int row = 0;
    const HeightGaps* gaps = nullptr; ///< of the node, or of its ancestor of range_level
};

/// Critical values of the samples that a node's fan may have, and errors.
struct FanCriticals {
    FourFloats middle;           ///< mid-points of fan_edges
    FourFloats quadrant;         ///< centres of the children; any where there is none
    FourFloats quadrant_error_m; ///< of those centres
};

/// Which samples of a ground a view wants by screen-space error.
class ErrorRule {
public:
    /// The ground must outlive the rule.
    explicit ErrorRule(const GroundTiles& ground);

    void look_from(const MeshView& view);

    const GroundTiles& ground() const { return *ground_; }

    const LevelMemory& memory(int level) const {
        return levels_[static_cast<std::size_t>(level)].memory;
    }

    const MeshView& view() const { return view_; }

    double west_m() const { return west_m_; } ///< of the field, eye subtracted

    double south_m() const { return south_m_; } ///< of the field, eye subtracted

    /// What critical values are compared with: a sample is in the mesh where its own is smaller.
    float limit_of(double error_px) const;

    double error_px_of(float limit) const;

    /// For a node of a level with height bounds.
    HeightGaps gaps_around(int level, int column, int row) const;

    /// Error of the root's centre.
    float root_error_m() const;

    /// `place.gaps` is set.
    FanCriticals criticals_of(const ErrorPlace& place) const;

    /// planes_cutting for all that a mesh may draw of a node. Drawn heights lie up to `margin_m`
    /// beyond those of the node's samples.
    unsigned planes_cutting_node(
        const ErrorPlace& place, const HeightGaps& gaps, float margin_m, unsigned planes) const;

    /// How much the ground is lowered at a place, metres east and north of the eye.
    template <typename Real>
    Real drop_m(Real east_m, Real north_m) const {
        return static_cast<Real>(half_curvature_per_m_) * (east_m * east_m + north_m * north_m);
    }

private:
    /// A level of the ground, and errors by curvature.
    struct Level {
        LevelMemory memory;
        float half_edge;
        float middle_error_m = 0.0F;
        float quadrant_error_m = 0.0F;
    };

    FourFloats metres_of(const LevelMemory::FourCodes& codes) const;

    const GroundTiles* ground_;
    MeshView view_;
    std::vector<Level> levels_;
    std::array<float, 256> error_m_{}; ///< by code
    double west_m_ = 0.0;
    double south_m_ = 0.0;
    double half_curvature_per_m_ = 0.0;
    float spacing_squared_m2_ = 0.0F;
    float eye_z_m_ = 0.0F;
    int range_level_ = 0;
    int origin_column_ = 0; ///< sample at or south-west of the eye
    int origin_row_ = 0;
    float eye_east_ = 0.0F; ///< samples from there
    float eye_north_ = 0.0F;
};

} // namespace octant::visuals::terrain
