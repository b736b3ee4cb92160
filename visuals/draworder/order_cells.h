#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/cell_orders.h"
#include "visuals/draworder/draw_order.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace octant::visuals::draworder {

/// More cells than these, or more entries in all lists, say less than the parts do.
inline constexpr std::size_t most_cells_of_parts = 1'000;
inline constexpr std::size_t most_entries_of_parts = 8'000'000;

/// The cells of any order: a plane that parts polygons is a choice of eye space, too, so that the
/// cells on both sides of it are combined. Only regions with a volume become cells. Returns nothing
/// when there are too many.
std::optional<std::vector<ListedCell>>
cells_of_parts(const models::polygons::PolygonModel& model, const DrawOrder& order);

} // namespace octant::visuals::draworder
