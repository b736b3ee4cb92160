#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/ordered_model.h"

#include <glm/vec3.hpp>

namespace octant::visuals::orderstudy {

/// The painting orders of the octants of the 1989 paper, each divided further until its cells have an order: right for
/// eyes of |x| + |y| + |z| >= `min_distance_radii` model radii from the centre that the result names. Octants are those
/// of the model's own axes. Notes and replacements as of draworder::ordered().
draworder::OrderedModel ordered_by_cells(
    models::polygons::PolygonModel model, const draworder::OrderOptions& options = {}, double min_distance_radii = 2.0);

/// The painting order for every eye that draworder::ordered() falls back to: polygons are split by planes where they
/// hide one another in cycles, without a search over eye space.
draworder::OrderedModel ordered_by_splitting(
    models::polygons::PolygonModel model, const draworder::OrderOptions& options = {});

/// Restricts an order by octants about a centre (body axes, metres) to the eyes with |x| + |y| + |z| >= `distance_m`
/// from the centre: each octant gets one more view split, and nearer eyes are painted nothing. The first three view
/// splits on each path must be planes through the centre across the axes (asserted).
draworder::DrawOrder with_min_distance(
    const draworder::DrawOrder& order, const glm::dvec3& centre_m, double distance_m);

} // namespace octant::visuals::orderstudy
