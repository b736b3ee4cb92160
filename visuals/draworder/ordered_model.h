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
    Clusters, ///< Where they hide one another in cycles.
    Single    ///< Until each stands alone: a BSP tree.
};

/// A model ordered by dividing its polygons, and the pieces that they were cut into.
struct BspOrder {
    models::polygons::PolygonModel model;
    DrawOrder order;
    int splits = 0; ///< How many polygons were added by cutting.
    std::vector<std::string> notes;
};

/// Orders any model for every eye by splitting its polygons (visuals/bsp), without a search. A turning polygon is
/// replaced by the solid that it sweeps and never cut, so that the order holds at every angle. Notes name turning parts
/// that no plane separates from others.
BspOrder bsp_order(models::polygons::PolygonModel model, BspLeaves way = BspLeaves::Clusters);

/// A tree of view splits; some of its cells have no list yet.
struct IncompleteOrder {
    std::vector<DrawOrder::Node> nodes; ///< As DrawOrder takes them; at least one.
    std::vector<std::vector<std::uint32_t>> lists;
    /// For each cell without a list the sets of polygons that are painted one after the other; empty for others.
    std::vector<std::vector<std::vector<std::uint32_t>>> incomplete_cells;
    /// For each polygon of the model its plane, in body axes: slivers are not asked for theirs.
    std::vector<Plane> planes;
};

/// Completes the cells without a list by splitting their polygons. Only polygons that occlude one another in a cycle
/// for the eyes of the cell are split, and the lists that were found get the pieces that are cut.
BspOrder complete_order(models::polygons::PolygonModel model, IncompleteOrder order);

struct OrderOptions {
    OrderMethod method = OrderMethod::Tree;
    /// Cells, Tree: about how long the search may take on one core. It is counted in work, not in time, so that the
    /// same model gives the same order everywhere.
    double seconds = 20.0;
    /// Cells, Tree: called with the share of it that is spent, 0 to 1; may be empty.
    SearchBudget::Progress progress = {};
    double min_distance_radii = 2.0; ///< Cells: exact for eyes with |x|+|y|+|z| >= this many radii.
    PaperOrderOptions paper;         ///< For OrderMethod::Paper.
};

/// The method that gave an order in the end.
enum class OrderSource {
    Paper, ///< Octants as printed.
    Cells, ///< Octants divided further.
    Tree,  ///< Cells of a tree of planes over eye space.
    Parts, ///< Polygons divided where they hide one another in cycles.
    Bsp,   ///< Polygons divided until each stands alone.
    /// Cells of a tree as far as the search came, polygons divided in the others.
    TreeAndSplitPolygons
};

/// A model with its painting orders, in body axes.
struct OrderedModel {
    /// The model, with polygons split where no order exists otherwise; its parents are the polygons they are pieces of.
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
    RayTestResult ray_test{}; ///< Not for OrderMethod::Paper.
};

/// Finds the painting orders of a model. Meant for loading: it may take seconds.
///
/// Every model gets an order. Where the search for cells is given up, the cells that were found are kept and polygons
/// are split in the others (complete_order). Where no cell was found, or the model is too large for a search, polygons
/// are split everywhere (bsp_order). Every order but that of OrderMethod::Paper is tested by rays before it is
/// returned, and proved pair by pair for a fiftieth of the seconds (order_ray_test.h). A wrong order is replaced by
/// splitting polygons, and a wrong result of that by a BSP tree of single polygons. Notes say which method was used and
/// how many pairs are unproved.
OrderedModel ordered(models::polygons::PolygonModel model, const OrderOptions& options = {});

} // namespace octant::visuals::draworder
