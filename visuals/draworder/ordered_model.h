#pragma once

#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/octant_order.h"

#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// How the painting orders of a model are found.
enum class Method {
    Paper, ///< 8 octants with one viewpoint each, steps 1 to 6 as printed.
    /// Octants that are divided further where a cycle remains; exact from a stated distance on.
    Cells,
    Tree, ///< A tree of planes over eye space; exact for every eye point.
    Bsp   ///< Polygons divided by planes; exact for every eye point, for any model at once.
};

struct OrderOptions {
    Method method = Method::Tree;
    double min_distance_radii = 2.0; ///< Cells: exact for eyes with |x|+|y|+|z| >= this many radii.
    PaperOptions paper;              ///< For Method::Paper.
};

/// The eye points that share a list.
struct OrderCell {
    std::string path; ///< Paper, Cells: "+-+/0/3"; empty for a cell of a tree.
    /// The cell is the intersection of the half-spaces in front of them; unit normals, body axes.
    std::vector<Plane> planes;
};

/// A model with its painting orders, in body axes.
struct OrderedModel {
    /// The model, with polygons split where no order exists otherwise; its parents tell of what.
    models::polygons::PolygonModel model;
    DrawOrder order; ///< Cell i is cells[i].
    std::vector<OrderCell> cells;
    glm::dvec3 centre_m{0.0}; ///< Paper, Cells: where the octants meet.
    /// Paper, Cells: the orders hold for |x|+|y|+|z| >= this, from centre_m.
    double min_distance_m = 0.0;
    int splits = 0;                 ///< How many polygons were added by splitting.
    int cyclic_cells = 0;           ///< Paper: the number of octants with broken cycles; else 0.
    std::vector<std::string> notes; ///< Messages to the user; often none.
};

/// Finds the painting orders of a model. Meant for loading: it may take seconds. Throws Error when
/// the model needs more cells than can be held.
OrderedModel ordered(models::polygons::PolygonModel model, const OrderOptions& options = {});

} // namespace octant::visuals::draworder
