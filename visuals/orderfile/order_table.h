#pragma once

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"
#include "visuals/orderfile/cell_orders.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace octant::visuals::orderfile {

/// One row of a table of painting orders, in the form of the 1989 paper's table 4.
struct OrderRow {
    std::string cell; ///< The octant path in the file's axes, or the cell's number counted from 1.
    /// For other cells their planes in words: "in front of P3, y < 1.2"; often empty.
    std::string region;
    std::string list; ///< Such as "P1, P7, P2": counted from 1, first painted first.
};

/// The list 0, 6, 1 as "P1, P7, P2".
std::string list_description(std::span<const std::uint32_t> list);

/// The planes of a cell in words, in the axes of the model's file: a polygon's plane by the polygon, one perpendicular
/// to an axis as x > 2, others as 0.6 x - 0.8 y > 1. Without planes it is "everywhere".
std::string region_description(
    std::span<const Plane> planes, const models::polygons::PolygonModel& model, const models::polygons::FileAxes& axes);

/// The rows of all cells: octants in the paper's order (+++, ++-, +-+, ...), other cells as they come; of an order by
/// parts its lists, numbered as in its text.
std::vector<OrderRow> order_table(
    const models::polygons::PolygonModel& model, const CellOrders& orders, const models::polygons::FileAxes& axes = {});

} // namespace octant::visuals::orderfile
