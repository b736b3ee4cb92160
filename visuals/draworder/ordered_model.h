#pragma once

#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/octant_order.h"

#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// How the orders of a model are found.
enum class Method {
    Paper, ///< 8 octants, one viewpoint each, steps 1 to 6 as printed
    Cells, ///< octants, divided further where a cycle remains; exact beyond a stated distance
    Tree   ///< a tree of planes over eye space; exact for every eye point
};

struct OrderOptions {
    Method method = Method::Tree;
    double min_distance_radii = 2.0; ///< Cells: exact for eyes with |x|+|y|+|z| >= this * radius
    PaperOptions paper;              ///< Paper
};

/// The eye points that share a list.
struct OrderCell {
    std::string path;          ///< Paper, Cells: "+-+/0/3"; empty for a cell of a tree
    std::vector<Plane> planes; ///< the cell is their common front; unit normals, body axes
};

/// A model with its painting orders.
struct OrderedModel {
    models::polygons::PolygonModel
        model;       ///< polygons split where no order exists; parents say of what
    DrawOrder order; ///< cell i is cells[i]
    std::vector<OrderCell> cells;
    glm::dvec3 centre_m{0.0};       ///< Paper, Cells: where the octants meet, body axes
    double min_distance_m = 0.0;    ///< Paper, Cells: made for |x|+|y|+|z| >= this, from centre_m
    int splits = 0;                 ///< polygons added by splitting
    int cyclic_cells = 0;           ///< Paper: octants that kept a cycle; else 0
    std::vector<std::string> notes; ///< what a person should be told; often none
};

/// Finds the orders of a model. Loading work. Throws Error when the model needs more cells than
/// can be held.
OrderedModel ordered(models::polygons::PolygonModel model, const OrderOptions& options = {});

} // namespace octant::visuals::draworder
