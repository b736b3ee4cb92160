#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/search_budget.h"
#include "visuals/draworder/view_cell.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// The cells and lists of a model, with planes in the space of its faces.
struct CellSearchResult {
    WorkingModel work; ///< The model, with the polygons that were split.
    std::vector<DrawOrder::Node> nodes;
    std::vector<std::vector<std::uint32_t>> lists;
    std::vector<OrderCell> cells;
    /// As ViewSpaceTree has them; empty where every cell has its list.
    std::vector<std::vector<std::vector<std::uint32_t>>> incomplete_cells = {};
    std::string incomplete_reason = {};
};

/// The best of several searches for a tree of planes over eye space. Throws SearchGivenUp when none finds anything, or
/// only trees that split polygons more often than `max_splits` says (TreeSearch).
CellSearchResult best_tree(
    const models::polygons::PolygonModel& model, SearchBudget& budget, const std::function<int()>& max_splits = {});

/// The best of several searches for octants that are divided further, for eyes of
/// |x|+|y|+|z| >= `min_distance` radii. Throws SearchGivenUp when none finds anything.
CellSearchResult best_cells(const models::polygons::PolygonModel& model, double min_distance, SearchBudget& budget);

} // namespace octant::visuals::draworder
