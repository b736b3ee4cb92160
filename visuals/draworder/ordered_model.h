#pragma once

#include "models/polygons/polygon_model.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/octant_order.h"
#include "visuals/draworder/order_method.h"
#include "visuals/draworder/order_ray_test.h"
#include "visuals/draworder/search_budget.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace octant::visuals::draworder {

struct OrderOptions {
    OrderMethod method = OrderMethod::Exact;
    /// Exact: about how long the search may take on one core; 0: polygons are split at once. It is counted in work, not
    /// in time, so that the same model gives the same order everywhere.
    double seconds = 20.0;
    /// Exact: called with the share of it that is spent, 0 to 1; may be empty.
    SearchBudget::Progress progress = {};
};

/// A model with its painting orders, in body axes.
struct OrderedModel {
    /// The model, with polygons split where no order exists otherwise; its parents are the polygons they are pieces of.
    models::polygons::PolygonModel model;
    DrawOrder order;
    /// By cell of the order; empty where `found_by` is Parts or TreeAndSplitPolygons.
    std::vector<OrderCell> cells = {};
    glm::dvec3 centre_m{0.0}; ///< Paper, Cells: where the octants meet.
    /// Paper, Cells: the orders hold for |x|+|y|+|z| >= this, from centre_m.
    double min_distance_m = 0.0;
    int splits = 0;                      ///< How many polygons were added by splitting.
    int cyclic_cells = 0;                ///< Paper: the number of octants with broken cycles; else 0.
    std::vector<std::string> notes = {}; ///< Messages to the user; often none.
    OrderSource found_by = OrderSource::Tree;
    RayTestResult ray_test{}; ///< Not for OrderMethod::Paper.
};

/// Finds the painting orders of a model. Meant for loading: it may take seconds.
///
/// Every model gets an order. Where the search for cells is given up, the cells that were found are kept and polygons
/// are split in the others, where they hide one another in a cycle. Where no cell was found, or the model is too large
/// for a search, polygons are split everywhere; one that turns is replaced by the solid that it sweeps and never split.
/// Every order but that of OrderMethod::Paper is tested by rays before it is returned, and proved pair by pair for a
/// fiftieth of the seconds (order_ray_test.h). A wrong order is replaced by splitting polygons. Notes say which method
/// was used, how many pairs are unproved and how many rays were wrong.
OrderedModel ordered(models::polygons::PolygonModel model, const OrderOptions& options = {});

/// Whether a model has transparent polygons (models::is_transparent).
bool has_transparent_polygons(const models::polygons::PolygonModel& model);

/// An order for a model that is drawn by depth: first all opaque polygons in file order, without those that a later one
/// repeats (models::polygons::distinct_polygons), then the transparent ones as `order_of` sorts them, to be blended
/// over the opaque ones. `order_of` gets the model of the transparent polygons alone.
OrderedModel opaque_first(const models::polygons::PolygonModel& model,
    const std::function<OrderedModel(models::polygons::PolygonModel)>& order_of);

struct CellSearchResult;

/// How ordered_by() finds the lists of a model; as made here, as OrderMethod::Exact does.
struct OrderSearch {
    /// Divides the eye space of a planar model into cells with lists (view_space_tree.h). `max_splits` says how many
    /// polygons may be split before another order is better. Throws SearchGivenUp. Empty: best_tree().
    std::function<CellSearchResult(
        const models::polygons::PolygonModel& planar, SearchBudget& budget, const std::function<int()>& max_splits)>
        find = {};
    OrderSource source = OrderSource::Tree; ///< Of an order whose cells were all found.
    bool keeps_axes = false; ///< Searches in the axes of the model, not in axes that turn with its shape.
    /// The lists hold for eyes of |x| + |y| + |z| >= so many radii from the origin of the cells' planes.
    double min_distance_radii = 0.0;
    /// The order for those eyes alone, which is proved; empty where the lists hold for every eye.
    std::function<DrawOrder(const OrderedModel&)> proved_order = {};
};

/// ordered() by another search, for studies; `options.method` does not count.
OrderedModel ordered_by(models::polygons::PolygonModel model, const OrderOptions& options, const OrderSearch& search);

} // namespace octant::visuals::draworder
