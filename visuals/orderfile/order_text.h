#pragma once

#include "models/polygons/file_axes.h"
#include "models/polygons/polygon_model.h"
#include "visuals/orderfile/cell_orders.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
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

/// Painting orders as text, in which planes are absolute, in the axes of the exported model: N.p + D >= 0 for points p
/// as they stand in its file, from its origin and not from `center`. Line by line, `#` starts a comment, polygons
/// counted from 0:
///     draworder 1
///     center CX CY CZ          default 0 0 0
///     metric l1 | l2           of min and max: |eye - center|; default l2
///     faces N                  of the model
///     twosided I J ...         default none
///     parents P0 P1 ...        of which polygon each is a piece; default none
///     cell REGION [min R] [max R] order I0 I1 ...    I0 is painted first, others never
/// REGION is an octant path (draworder/octant_order.h), `cone K X1 Y1 Z1 ...` (non-negative sums of K directions, from the
/// centre) or `half K NX NY NZ D ...` (points p with N.p + D >= 0 for all K; K = 0 is everywhere). The first cell that
/// contains an eye is used.
///
/// In place of cells there may be parts, for models that would need too many cells; the polygons themselves are
/// divided, too:
///     list I0 I1 ...                                      may be empty
///     node choice NX NY NZ D FRONT BACK                   the eye's side is painted
///     node parting NX NY NZ D FRONT BACK ALONG AGAINST    the side without the eye, what lies in
///                                                         the plane, then the eye's side
///     node sequence FIRST LATER                           painted one after the other
/// FRONT is what is painted, or lies, where N.p + D >= 0. A child is `node K` or `list K`, counted from 0 in the order
/// of the lines, or no_child; the children of a node are lists or later nodes, and no node is the child of two. Of
/// what lies in a parting's plane, ALONG is painted for eyes in front and AGAINST for those behind. Node 0 is where
/// every eye begins; without nodes it is list 0.
///
/// Coordinates are in `axes`, those of the model file that the orders speak of; so the letters A, B, C of octant paths
/// belong to that file's x, y, z. Numbers have 17 significant digits. Cells without path or directions are written as
/// `half`.
std::string order_text(const CellOrders& orders, const models::polygons::FileAxes& axes = {});

/// Reads order_text for a model of `faces` polygons. Normals of any length become unit vectors. Throws Error
/// "file:line: expected ..., got ...": no header, unknown keywords and regions, numbers that are missing, too many, not
/// finite or too large, indices out of range, a polygon twice in one cell, another count of faces, a keyword twice or
/// after the cells, no cells and no parts, both of them, children that are not there or have another parent, too.
CellOrders read_order_file(
    const std::filesystem::path& path, std::size_t faces, const models::polygons::FileAxes& axes = {});

} // namespace octant::visuals::orderfile
