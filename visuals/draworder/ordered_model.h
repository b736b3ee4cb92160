#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/octant_order.h"
#include "visuals/draworder/order_method.h"
#include "visuals/draworder/order_ray_test.h"
#include "visuals/draworder/search_budget.h"

#include <cstdint>
#include <string>
#include <vector>

namespace octant::visuals::draworder {

/// How far polygons are divided.
enum class BspLeaves {
    Clusters, ///< Where they hide one another in rings.
    Single    ///< Until each stands alone: a BSP tree.
};

/// A model ordered by dividing its polygons, and the pieces that they were cut into.
struct BspOrder {
    models::polygons::PolygonModel model;
    DrawOrder order;
    int splits = 0; ///< How many polygons were added by cutting.
    std::vector<std::string> notes;
};

/// Orders any model for every eye by partings (visuals/bsp), without a search. A polygon that turns is taken for what
/// it sweeps and never cut, so that the order holds at every angle. Notes tell of turning parts that no plane parts
/// from others.
BspOrder bsp_order(models::polygons::PolygonModel model, BspLeaves way = BspLeaves::Clusters);

/// A tree of choices of which some cells have no list yet.
struct IncompleteOrder {
    std::vector<DrawOrder::Node> nodes; ///< As DrawOrder takes them; at least one.
    std::vector<std::vector<std::uint32_t>> lists;
    /// For each cell without a list the sets of polygons that are painted one after the other; empty for others.
    std::vector<std::vector<std::vector<std::uint32_t>>> incomplete_cells;
    /// For each polygon of the model its plane, in body axes: slivers are not asked for theirs.
    std::vector<Plane> planes;
};

/// Orders the open cells by dividing their sets: what hides nothing in a ring for the eyes of a cell is not parted, and
/// found lists take up the pieces that are cut.
BspOrder complete_order(models::polygons::PolygonModel model, IncompleteOrder order);

struct OrderOptions {
    OrderMethod method = OrderMethod::Tree;
    /// Cells, Tree: about how long the search may take on one core. It is counted in work, not in time, so that the
    /// same model gives the same order everywhere.
    double seconds = 20.0;
    /// Cells, Tree: told how much of that is spent, 0 to 1; may be empty.
    SearchBudget::Progress progress = {};
    double min_distance_radii = 2.0; ///< Cells: exact for eyes with |x|+|y|+|z| >= this many radii.
    PaperOrderOptions paper;         ///< For Method::Paper.
};

/// What an order was found by in the end.
enum class OrderSource {
    Paper, ///< Octants as printed.
    Cells, ///< Octants divided further.
    Tree,  ///< Cells of a tree of planes over eye space.
    Parts, ///< Polygons divided where they hide one another in rings.
    Bsp,   ///< Polygons divided until each stands alone.
    /// Cells of a tree as far as the search came, polygons divided in the others.
    TreeAndSplitPolygons
};

/// A model with its painting orders, in body axes.
struct OrderedModel {
    /// The model, with polygons split where no order exists otherwise; its parents tell of what.
    models::polygons::PolygonModel model;
    DrawOrder order;
    std::vector<OrderCell> cells; ///< For each cell of the order; empty where it has parts.
    glm::dvec3 centre_m{0.0};     ///< Paper, Cells: where the octants meet.
    /// Paper, Cells: the orders hold for |x|+|y|+|z| >= this, from centre_m.
    double min_distance_m = 0.0;
    int splits = 0;                 ///< How many polygons were added by splitting.
    int cyclic_cells = 0;           ///< Paper: the number of octants with broken cycles; else 0.
    std::vector<std::string> notes; ///< Messages to the user; often none.
    OrderSource found_by = OrderSource::Tree;
    RayTestResult ray_test{}; ///< Not for Method::Paper.
};

/// Finds the painting orders of a model. Meant for loading: it may take seconds.
///
/// There is an answer for any model. Where the search for cells is given up, what was found is kept, and in the other
/// cells polygons are divided (bsp_order.h); all of them where nothing was found or the model has more polygons than
/// are searched. Every order but that of Method::Paper is tried by rays before it is returned, and proved pair by pair
/// as far as a fiftieth of the seconds goes (order_trial.h); one that is wrong is replaced in the same way, and in the
/// end by a BSP tree of single polygons. Notes say so, and what no proof was found for.
OrderedModel ordered(models::polygons::PolygonModel model, const OrderOptions& options = {});

} // namespace octant::visuals::draworder
