#pragma once

#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"
#include "visuals/draworder/ordered_model.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::visuals::draworder {

/// How far an eye is from the centre: |x| + |y| + |z| or the usual length.
enum class Metric { L1, L2 };

double length_m(Metric metric, const glm::dvec3& vector_m);

/// Eyes that share a list: the common front of `planes`, at a distance of min_m to max_m from the
/// centre.
struct ListedCell {
    std::string path;                   ///< octant path in body axes, "+-+/0/3"; empty: none
    std::vector<glm::dvec3> directions; ///< edges of a cone from the centre; empty: no cone
    std::vector<Plane> planes;          ///< unit normals, body axes
    double min_m = 0.0;
    double max_m = std::numeric_limits<double>::infinity();
    std::vector<std::uint32_t> list; ///< first painted first; others are never painted
};

/// Painting orders by cells, as files hold them and checks read them. An eye uses the first cell
/// that contains it. Body axes.
struct CellOrders {
    glm::dvec3 centre_m{0.0};
    Metric metric = Metric::L2;
    std::size_t faces = 0;                ///< of the model they belong to
    std::vector<std::uint32_t> two_sided; ///< polygons seen from both sides
    std::vector<std::uint32_t> parents;   ///< as PolygonModel::parents
    std::vector<ListedCell> cells;
};

/// The cells of a model in this form. Octant cells are made from their paths, not from the planes
/// that the model gives them, except where several share a path (a cell divided by planes); they
/// begin where the model's orders are meant for: at its
/// min_distance_m, or for Method::Paper (which has none) at sqrt(3) times the model's radius, so
/// that no eye of them lies inside the radius.
CellOrders cell_orders(const OrderedModel& ordered);

/// The cell that an eye uses; nothing when none contains it.
std::optional<std::size_t> cell_of(const CellOrders& orders, const glm::dvec3& eye_m);

/// Whether an eye lies between the least distance and the greatest distance of all cells.
bool in_range(const CellOrders& orders, const glm::dvec3& eye_m);

/// Signs of x, y, z, then up to most_path_levels children 0 .. 3, each behind a slash.
bool is_octant_path(std::string_view text);
inline constexpr std::size_t most_path_levels = 24;

/// Corners A, B, C of the flat triangle that an octant path names, on |x| + |y| + |z| = 1. Children
/// of (A, B, C), with AB the middle of an edge: 0 = (A, AB, CA), 1 = (AB, B, BC), 2 = (CA, BC, C),
/// 3 = (BC, CA, AB).
std::array<glm::dvec3, 3> corners_of_path(std::string_view path);

/// Planes through `apex_m` whose common front is the cone of the directions; none when they span
/// all of space that way; nothing when they lie in one plane.
std::optional<std::vector<Plane>>
planes_of_cone(std::span<const glm::dvec3> directions, const glm::dvec3& apex_m);

/// Planes whose common front holds every eye of a cell, its distances included. Of a least distance
/// only cones of three directions know a plane; other cells are taken down to the centre.
std::vector<Plane> region_of(const CellOrders& orders, const ListedCell& cell);

} // namespace octant::visuals::draworder
