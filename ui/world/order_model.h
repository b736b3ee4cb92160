#pragma once

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/orderfile/cell_orders.h"
#include "visuals/orderfile/random_ray_test.h"

#include <string>

namespace octant::ui::world {

/// A model to find painting orders for, and its axes.
struct OrderModel {
    models::polygons::PolygonModel model;
    models::polygons::FileAxes axes;
};

/// A built-in model (base::built_in_models, torus) in the usual axes, or a file in `axes`: polygons of an OBJ file, the
/// triangles of any other mesh file, with parts that turn and glass where they are told. Throws Error, also for more
/// polygons than orders can be found for in reasonable time.
OrderModel load_order_model(const std::string& name_or_file, const std::string& axes);

/// How many planes an eye is tried against.
struct PlaneTests {
    int most = 0;
    /// Over eyes in all directions, 0.05 to 20 times the radius away.
    double mean = 0.0;
};

PlaneTests plane_tests(const visuals::draworder::OrderedModel& ordered);

/// Tries orders with `rays` rays from random eyes within their range, 0.05 to 20 times the radius away, a quarter of
/// them each at four angles of the turning parts where there are such.
visuals::orderfile::RayTestCounts cast_rays(
    const models::polygons::PolygonModel& model, const visuals::orderfile::CellOrders& orders, int rays);

} // namespace octant::ui::world
