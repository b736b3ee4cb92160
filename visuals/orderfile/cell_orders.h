#pragma once

#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/ordered_model.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::visuals::orderfile {

/// How the distance of an eye from the centre is measured: L1 is |x| + |y| + |z|, L2 the usual length.
enum class Metric { L1, L2 };

/// The length of a vector in a metric.
double length_m(Metric metric, const glm::dvec3& vector_m);

/// A cell: the eyes that share one list. It is the intersection of the half-spaces in front of `planes`, from a
/// distance of min_m to one of max_m from the centre. Body axes, metres.
struct ListedCell {
    std::string path; ///< The octant path, "+-+/0/3"; empty when the cell has none.
    /// The edges of a cone with its apex in the centre; empty when the cell is no cone.
    std::vector<glm::dvec3> directions;
    std::vector<Plane> planes; ///< With unit normals.
    double min_m = 0.0;
    double max_m = std::numeric_limits<double>::infinity();
    /// Polygons, the first painted first; those not listed are never painted.
    std::vector<std::uint32_t> list;
};

/// Painting orders by cells, as files hold them and checks read them. An eye uses the first cell that contains it.
struct CellOrders {
    glm::dvec3 centre_m{0.0};
    Metric metric = Metric::L2;
    std::size_t faces = 0;                ///< The number of polygons of the model they belong to.
    std::vector<std::uint32_t> two_sided; ///< The polygons that are seen from both sides.
    std::vector<std::uint32_t> parents;   ///< As PolygonModel::parents.
    std::vector<ListedCell> cells;
    /// In place of cells: an order in which polygons are divided, too. Body axes, metres.
    std::optional<draworder::DrawOrder> parts;
};

/// Converts a model's orders to this form. An order with polygon splits is turned into cells where these are few.
/// Octant cells are made from their paths rather than from the planes that the model gives them, except where several
/// cells share a path (an octant divided by planes). They begin at the distance from which the model's orders hold: at
/// its min_distance_m, or for OrderMethod::Paper, which has none, at sqrt(3) times the model's radius, so that no eye
/// of them lies inside the radius.
CellOrders cell_orders(const draworder::OrderedModel& ordered);

/// The index of the cell that an eye uses; nothing when none contains it.
std::optional<std::size_t> cell_of(const CellOrders& orders, const glm::dvec3& eye_m);

/// Whether an eye is between the least and the greatest distance of all cells.
bool in_range(const CellOrders& orders, const glm::dvec3& eye_m);

/// The planes through `apex_m` that bound the cone of all non-negative sums of the directions; none when these span all
/// of space. Returns nothing when the directions lie in one plane.
std::optional<std::vector<Plane>> planes_of_cone(std::span<const glm::dvec3> directions, const glm::dvec3& apex_m);

/// The planes of a convex region that holds every eye of a cell, its distances included. A plane for the least distance
/// is known only for cones of three directions; other cells are taken to reach to the centre.
std::vector<Plane> region_of(const CellOrders& orders, const ListedCell& cell);

} // namespace octant::visuals::orderfile
