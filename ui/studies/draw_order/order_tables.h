#pragma once

#include "ui/report/html_text.h"
#include "visuals/draworder/ordered_model.h"

#include <array>
#include <cstddef>
#include <span>
#include <string>

namespace octant::ui::studies::draw_order {

/// A model ordered in every way.
struct OrderedByEachMethod {
    std::string name;
    std::size_t polygons = 0;                                  ///< before splitting
    std::array<visuals::draworder::OrderedModel, 3> by_method; ///< paper, cells, tree
    std::array<double, 3> build_ms{};
};

OrderedByEachMethod order_by_each_method(const std::string& name);

/// The eight orders that the paper prints for its example object, ours beside, and whether the
/// polygons are the same and those that must come first do.
report::HtmlTable paper_order_table();

/// Cells, lists, splits, plane tests and building time of each method, and whether the certificate
/// (order_check.h) holds.
report::HtmlTable method_table(std::span<const OrderedByEachMethod> models);

/// Shares of rays that see a wrong polygon, in percent, by method and distance; file order without
/// back faces beside them.
report::HtmlTable wrong_pixel_table(std::span<const OrderedByEachMethod> models);

/// Splits, nodes and time a frame of a BSP tree against finding a cell of the tree of planes.
report::HtmlTable bsp_table(std::span<const OrderedByEachMethod> models);

} // namespace octant::ui::studies::draw_order
