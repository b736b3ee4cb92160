#pragma once

namespace octant::visuals::draworder {

/// How the painting orders of a model are found.
enum class OrderMethod {
    Paper, ///< 8 octants with one viewpoint each, steps 1 to 6 as printed.
    Exact  ///< Right for every eye point: a tree of planes over eye space, polygons split where it ends.
};

/// The method that gave an order in the end.
enum class OrderSource {
    Paper, ///< Octants as printed.
    Cells, ///< Octants divided further (visuals/orderstudy).
    Tree,  ///< Cells of a tree of planes over eye space.
    Parts, ///< Polygons divided where they hide one another in cycles.
    /// Cells of a tree as far as the search came, polygons divided in the others.
    TreeAndSplitPolygons
};

} // namespace octant::visuals::draworder
