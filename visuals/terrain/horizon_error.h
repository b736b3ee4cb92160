#pragma once

#include "visuals/terrain/error_rule.h"
#include "visuals/terrain/error_survey.h"
#include "visuals/terrain/ground_mesh.h"
#include "visuals/terrain/ground_tiles.h"

#include <optional>

namespace octant::visuals::terrain {

/// A view that was turned about a level axis.
struct TurnedView {
    MeshView view;
    double turned_rad = 0.0; ///< Above zero.
};

/// The view, turned up or down by as little as brings a line at this elevation (radians above
/// level) into the picture on the way of the turn. Nothing where it is there already, and where the
/// view has no direction or frustum or looks straight up or down.
std::optional<TurnedView> turned_to(const MeshView& view, double elevation_rad);

/// Finds the error below which a mesh within a budget is not to be refined, so that vertices do not
/// jump when the view turns to the horizon (horizon_error.cpp).
class HorizonError {
public:
    /// The ground must outlive it.
    explicit HorizonError(const GroundTiles& ground);
    HorizonError(const HorizonError&) = delete;
    HorizonError& operator=(const HorizonError&) = delete;
    HorizonError(HorizonError&&) = delete;
    HorizonError& operator=(HorizonError&&) = delete;
    ~HorizonError() = default;

    /// The target with its error raised to that one, whatever was asked before; unchanged without
    /// geomorphs or a budget, and where the horizon is in the picture.
    ErrorTarget eased(const MeshView& view, const ErrorTarget& target);

private:
    double missing_rad(const MeshView& view) const;

    ErrorRule rule_;
    ErrorSurvey survey_;
};

} // namespace octant::visuals::terrain
