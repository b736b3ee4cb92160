#pragma once

#include "visuals/terrain/bisection_selection.h"
#include "visuals/terrain/ground_mesh.h"

#include <optional>

namespace octant::visuals::terrain {

/// Elevations, in radians above level.
struct ElevationBand {
    double low_rad = 0.0;
    double high_rad = 0.0; ///< At or above the low one.
};

/// A view that was turned about a level axis and then widened.
struct TurnedView {
    MeshView view;
    double turned_rad = 0.0; ///< Without the widening; at or above zero.
};

/// The view, turned up or down until its border reaches a band, and widened until it contains the band at all headings
/// of the turn. For a view above the band, the band begins 4 degrees lower. A view whose border is in the band is only
/// widened. Nothing where the band is already in the picture, and for a view without direction or frustum, or straight
/// up or down.
std::optional<TurnedView> turned_to_band(const MeshView& view, const ElevationBand& band);

/// Finds the error below which a mesh with a budget must not be refined, so that vertices do not jump when the view
/// turns to the horizon.
class HorizonError {
public:
    /// The ground must outlive it.
    explicit HorizonError(const GroundTiles& ground);
    HorizonError(const HorizonError&) = delete;
    HorizonError& operator=(const HorizonError&) = delete;
    HorizonError(HorizonError&&) = delete;
    HorizonError& operator=(HorizonError&&) = delete;
    ~HorizonError() = default;

    /// The target with its error raised to that one; earlier calls do not influence it. Unchanged without geomorphs or
    /// a budget, and where the horizon is in the picture.
    ErrorTarget raise_to_horizon_error(const MeshView& view, const ErrorTarget& target);

    /// As BisectionSelection::expect_other_view().
    void expect_other_view() { selection_.expect_other_view(); }

private:
    ElevationBand far_ground(const MeshView& view) const;

    BisectionCriterion criterion_;
    BisectionSelection selection_;
    double motion_share_; ///< How much the error may change in a turn, in pixels that it moves.
};

} // namespace octant::visuals::terrain
