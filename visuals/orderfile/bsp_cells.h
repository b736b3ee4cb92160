#pragma once

#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"
#include "visuals/draworder/draw_order.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace octant::visuals::orderfile {

/// More cells than these, or more entries in all lists, say less than the parts do.
inline constexpr std::size_t max_cells_of_parts = 1'000;
inline constexpr std::size_t max_entries_of_parts = 8'000'000;

/// A region of eyes and what is painted for all of them.
struct BspCell {
    std::vector<Plane> planes; ///< The region is in front of them; unit normals, body axes.
    std::vector<std::uint32_t> list;
};

/// The cells of any order: a plane that parts polygons is a choice of eye space, too, so that the
/// cells on both sides of it are combined. Only regions with a volume become cells. Returns nothing
/// when there are too many.
std::optional<std::vector<BspCell>>
bsp_cells(const models::polygons::PolygonModel& model, const draworder::DrawOrder& order);

} // namespace octant::visuals::orderfile
