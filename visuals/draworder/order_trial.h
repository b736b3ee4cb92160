#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/draw_order.h"

#include <string>

namespace octant::visuals::draworder {

/// Which eyes and polygons a trial looks at.
struct TrialScope {
    /// Whether parts with a pivot are looked at, at four angles. Without them, where no order can
    /// be right for them.
    bool turning_parts = true;
    /// Eyes are at least so far from where octants meet: |x| + |y| + |z| from the origin, metres.
    double min_distance_m = 0.0;
};

/// What a trial saw.
struct Trial {
    long rays = 0;  ///< Rays that meet the front of a polygon away from its sides.
    long wrong = 0; ///< Of these, rays along which a polygon farther away was painted last.
};

/// Tries an order before it is used, with none of the code that made it: from eyes far and near,
/// close to the planes of its nodes and close to polygons, at points of polygons. The work is
/// bounded, some tenths of a second at most; the same model and order give the same trial.
Trial try_order(
    const models::polygons::PolygonModel& model, const DrawOrder& order, const TrialScope& scope);

} // namespace octant::visuals::draworder
