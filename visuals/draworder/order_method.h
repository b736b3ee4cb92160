#pragma once

namespace octant::visuals::draworder {

/// How the painting orders of a model are found.
enum class OrderMethod {
    Paper, ///< 8 octants with one viewpoint each, steps 1 to 6 as printed.
    Cells, ///< Octants, divided further where a cycle remains; exact from a stated distance on.
    Tree,  ///< A tree of planes over eye space; exact for every eye point.
    Bsp    ///< Polygons divided by planes; exact for every eye point, for any model at once.
};

} // namespace octant::visuals::draworder
