#include "ui/studies/draw_order/study_draw_order.h"

#include "sim/base/random_generator.h"
#include "sim/base/stopwatch.h"
#include "ui/base/progress.h"
#include "ui/report/html_text.h"
#include "ui/settings/settings_text.h"
#include "ui/studies/draw_order/surface_race.h"
#include "ui/world/order_model.h"
#include "visuals/draworder/octant_order.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/orderfile/order_check.h"
#include "visuals/orderfile/order_text.h"
#include "visuals/orderfile/random_ray_test.h"
#include "visuals/orderstudy/bsp_tree.h"
#include "visuals/orderstudy/divided_octants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::studies::draw_order {

namespace {

/// A model ordered in every way.
struct OrderedByEachMethod {
    std::string name;
    std::size_t polygons = 0;                                  ///< before splitting
    std::array<visuals::draworder::OrderedModel, 3> by_method; ///< paper, cells, tree
    std::array<double, 3> build_ms{};
};

namespace draworder = visuals::draworder;
namespace orderfile = visuals::orderfile;
namespace orderstudy = visuals::orderstudy;

constexpr std::array methods = {"paper", "cells", "tree"};
constexpr std::size_t tree_method = 2;

using List = std::vector<std::uint32_t>;

/// A row of table 4 as printed, polygons from 1, and which polygon must come before which.
struct PrintedRow {
    std::string octant;
    List list;
    std::uint32_t first = 0; ///< 0: no precedence is needed
    List later;
};

const std::array printed_rows = {PrintedRow{"+++", {1, 7, 2, 8, 3, 4}, 0, {}},
    PrintedRow{"++-", {1, 9, 2, 10, 3, 4}, 0, {}}, PrintedRow{"+-+", {2, 7, 8, 6, 4}, 2, {4, 6, 8}},
    PrintedRow{"+--", {2, 9, 10, 6, 4}, 2, {4, 6, 10}}, PrintedRow{"-++", {8, 3, 7, 1, 5}, 3, {1, 5, 7}},
    PrintedRow{"-+-", {10, 3, 9, 1, 5}, 3, {1, 5, 9}}, PrintedRow{"--+", {8, 7, 6, 5}, 0, {}},
    PrintedRow{"---", {10, 9, 6, 5}, 0, {}}};

/// Polygons of the printed rows counted from 0.
List zero_based(List list) {
    for (std::uint32_t& polygon : list) { --polygon; }
    return list;
}

bool same_polygons(List a, List b) {
    std::ranges::sort(a);
    std::ranges::sort(b);
    return a == b;
}

std::string precedences_in_words(const PrintedRow& row) {
    return row.later.empty()
               ? "none"
               : fmt::format("P{} before {}", row.first, orderfile::list_description(zero_based(row.later)));
}

bool keeps_precedences(const List& list, const PrintedRow& row) {
    return std::ranges::all_of(row.later, [&](std::uint32_t later) {
        return std::ranges::find(list, row.first - 1) < std::ranges::find(list, later - 1);
    });
}

const char* yes_or_no(bool yes) { return yes ? "yes" : "no"; }

struct Distances {
    const char* name;
    double min_radii;
    double max_radii;
};

constexpr std::array distances = {
    Distances{"2 to 20 R", 2.0, 20.0}, Distances{"1 to 2 R", 1.0, 2.0}, Distances{"0.05 to 1 R", 0.05, 1.0}};

/// Rays from these distances, shared out over angles of the turning parts.
orderfile::RayTestCounts ray_count_of(
    const models::polygons::PolygonModel& model, const draworder::DrawOrder& order, const Distances& range) {
    constexpr std::array angles_rad = {0.0, 0.7, 2.1, 4.4};
    orderfile::RayTestCounts count;
    for (const double angle_rad : angles_rad) {
        count += orderfile::count_wrong_rays(model, order,
            {.eyes = 2000,
                .rays_per_eye = 25,
                .min_distance_radii = range.min_radii,
                .max_distance_radii = range.max_radii,
                .turn_rad = angle_rad});
    }
    return count;
}

/// What finding the painting order of one frame costs, and how long the orders are.
struct FrameCost {
    double bsp_ns = 0.0;
    double cell_ns = 0.0;
    double bsp_painted = 0.0; ///< polygons an eye
    double cell_painted = 0.0;
};

/// Medians over batches of eyes, the two in turn, so that both see the same machine.
FrameCost frame_cost(const orderstudy::BspTree& bsp, const draworder::OrderedModel& ordered) {
    constexpr int batches = 401;
    constexpr int eyes = 500;
    RandomGenerator dice(1989);
    const double radius_m = models::polygons::radius_m(ordered.model);
    std::vector<glm::dvec3> eyes_m;
    for (int i = 0; i < eyes; ++i) { eyes_m.push_back(dice.direction() * (radius_m * dice.between(0.5, 10.0))); }
    List painted;
    std::vector<int> to_do;
    draworder::DrawOrder::Walk walk;
    std::size_t by_bsp = 0;
    std::size_t by_cell = 0;
    std::vector<double> bsp_ns;
    std::vector<double> cell_ns;
    for (int batch = 0; batch < batches; ++batch) {
        Stopwatch watch;
        for (const glm::dvec3& eye_m : eyes_m) {
            painted.clear();
            orderstudy::append_painted(bsp, eye_m, painted, to_do);
            by_bsp += painted.size();
        }
        bsp_ns.push_back(watch.lap_ms() * 1e6 / eyes);
        for (const glm::dvec3& eye_m : eyes_m) {
            for (const auto& range : ordered.order.ranges_of(eye_m, walk)) { by_cell += range.count; }
        }
        cell_ns.push_back(watch.lap_ms() * 1e6 / eyes);
    }
    constexpr double looks = static_cast<double>(batches) * eyes;
    return {median_of(bsp_ns), median_of(cell_ns), static_cast<double>(by_bsp) / looks,
        static_cast<double>(by_cell) / looks};
}

OrderedByEachMethod order_by_each_method(const std::string& name) {
    const world::OrderModel input = world::load_order_model(name, "right,up,back");
    std::array<double, 3> build_ms{};
    Stopwatch watch;
    draworder::OrderedModel paper = draworder::ordered(input.model, {.method = draworder::OrderMethod::Paper});
    build_ms[0] = watch.lap_ms();
    draworder::OrderedModel cells = orderstudy::ordered_by_cells(input.model);
    build_ms[1] = watch.lap_ms();
    draworder::OrderedModel tree = draworder::ordered(input.model);
    build_ms[2] = watch.lap_ms();
    return {name, input.model.polygons.size(), {std::move(paper), std::move(cells), std::move(tree)}, build_ms};
}

/// The eight orders that the paper prints for its example object, ours beside, and whether the
/// polygons are the same and those that must come first do.
report::ResultTable paper_order_table() {
    const world::OrderModel input = world::load_order_model("concave", "right,up,back");
    const auto orders =
        orderfile::cell_orders(draworder::ordered(input.model, {.method = draworder::OrderMethod::Paper}));
    report::ResultTable table{"Table 4: painting orders of the paper's example object"};
    for (const PrintedRow& row : printed_rows) {
        for (const orderfile::ListedCell& cell : orders.cells) {
            if (draworder::path_in_file(cell.path, input.axes) != row.octant) { continue; }
            const List printed = zero_based(row.list);
            table.add({{"viewing direction", row.octant}, {"paper", orderfile::list_description(printed)},
                {"ours", orderfile::list_description(cell.list)},
                {"same polygons", yes_or_no(same_polygons(cell.list, printed))},
                {"precedences that the object needs", precedences_in_words(row)},
                {"ours keeps them", yes_or_no(keeps_precedences(cell.list, row))},
                {"paper keeps them", yes_or_no(keeps_precedences(printed, row))}});
        }
    }
    table.note = "Ours by the paper's steps as printed. Where no precedence is needed any sequence "
                 "of the same polygons paints the same picture, and the text of the paper does not "
                 "say which one to take.";
    return table;
}

/// Cells, lists, splits, plane tests and building time of each method, and whether the certificate
/// (order_check.h) holds.
report::ResultTable method_table(std::span<const OrderedByEachMethod> models) {
    report::ResultTable table{"What each way of ordering needs"};
    for (const OrderedByEachMethod& model : models) {
        for (std::size_t i = 0; i < methods.size(); ++i) {
            const draworder::OrderedModel& ordered = model.by_method[i];
            const world::PlaneTests tests = world::plane_tests(ordered);
            const auto check = orderfile::check_order(ordered.model, orderfile::cell_orders(ordered));
            table.add({{"model", model.name}, {"method", methods[i]}, {"polygons", ordered.model.polygons.size()},
                {"splits", ordered.splits}, {"cells", ordered.order.cell_count()},
                {"lists", ordered.order.list_count()}, {"plane tests a frame, most", tests.most},
                {"plane tests a frame, mean", "{:.2f}", tests.mean}, {"building, ms", "{:.1f}", model.build_ms[i]},
                {"pairs", check.pairs}, {"pairs not certified", check.pairs_unproved + check.unlisted_unproved}});
        }
    }
    table.note =
        "paper: 8 octants as printed. cells: octants divided further, for eyes with |x| + "
        "|y| + |z| of at least 2 R. tree: planes over eye space, for every eye (--order-method exact). R is the "
        "model's radius. A pair is certified when a plane proves that no eye of the cell "
        "sees the one painted first before the other; turning parts at every angle.";
    return table;
}

/// Shares of rays that see a wrong polygon, in percent, by method and distance; file order without
/// back faces beside them.
report::ResultTable wrong_pixel_table(std::span<const OrderedByEachMethod> models) {
    report::ResultTable table{"Pixels painted wrongly, in percent of the pixels that show the model"};
    for (const OrderedByEachMethod& model : models) {
        for (const Distances& range : distances) {
            const auto count_of = [&](std::size_t method) {
                const draworder::OrderedModel& ordered = model.by_method[method];
                return ray_count_of(ordered.model, ordered.order, range);
            };
            const models::polygons::PolygonModel& whole = model.by_method[0].model;
            const auto tree = count_of(tree_method);
            const auto percent = [](const orderfile::RayTestCounts& count) { return 100.0 * count.wrong_share(); };
            table.add({{"model", model.name}, {"eyes", range.name}, {"rays", tree.hits},
                {"paper", "{:.3f}", percent(count_of(0))}, {"cells", "{:.3f}", percent(count_of(1))},
                {"tree", "{:.3f}", percent(tree)},
                {"back faces removed only", "{:.3f}",
                    percent(ray_count_of(whole, draworder::file_order(whole), range))}});
        }
    }
    table.note = "Rays from random eyes in perspective, turning parts at four angles. Orders by "
                 "cells are made for eyes beyond 2 R, those as printed speak of no distance. Eyes "
                 "within R may lie inside the model and look in all directions.";
    return table;
}

/// Splits, nodes and time a frame of a BSP tree against finding a cell of the tree of planes.
report::ResultTable bsp_table(std::span<const OrderedByEachMethod> models) {
    report::ResultTable table{"A BSP tree against the tree of planes over eye space"};
    for (const OrderedByEachMethod& model : models) {
        const draworder::OrderedModel& ordered = model.by_method[tree_method];
        const orderstudy::BspTree bsp = orderstudy::bsp_tree(model.by_method[0].model);
        const FrameCost cost = frame_cost(bsp, ordered);
        table.add({{"model", model.name}, {"polygons", model.polygons}, {"BSP splits", bsp.splits},
            {"polygons after splitting", bsp.model.polygons.size()},
            {"BSP nodes = plane tests a frame", bsp.nodes.size()}, {"BSP depth", bsp.depth},
            {"tree plane tests a frame, mean", "{:.2f}", world::plane_tests(ordered).mean},
            {"tree splits", ordered.splits}, {"BSP walk, ns", "{:.0f}", cost.bsp_ns},
            {"cell lookup, ns", "{:.1f}", cost.cell_ns}, {"BSP / lookup", "{:.1f}", cost.bsp_ns / cost.cell_ns},
            {"BSP polygons painted", "{:.1f}", cost.bsp_painted},
            {"tree polygons listed", "{:.1f}", cost.cell_painted}});
    }
    table.note = "The BSP tree takes the planes of the polygons, those first that split fewest; it "
                 "holds turning parts at one angle only and leaves out back faces on its walk. The "
                 "cell lookup finds a range of a ready index buffer. Times are medians of 401 "
                 "batches of 500 eyes, both in turn.";
    return table;
}

namespace scene = visuals::scene;

/// Frames a second of each aircraft alone, as printed.
struct PaperRow {
    const char* aircraft;
    double back_face_fps;
    double depth_buffer_fps;
    double octant_fps; ///< 100 frames in 3.3 and 3.5 s
};

// E. K. Kim, J. A. Park, C. Song, J. H. Kim, "Hidden-Surface Removal in 3D Graphics for Real Time
// Animation", 1989: table 1; octant order: section IV and table 5.
constexpr std::array paper_rows = {PaperRow{"f15", 30.0, 5.0, 100.0 / 3.3}, PaperRow{"500md", 29.0, 4.0, 100.0 / 3.5}};

/// An aircraft on an orbit around it, without sky and ground.
TimedFlight race_alone(const char* aircraft, bool quiet) {
    constexpr int frames = 200;
    settings::RunSettings settings;
    settings.path.aircraft = {aircraft};
    settings.path.terrain = "none";
    settings.view.kind = scene::View::Orbit;
    settings.air.sky = false;
    settings.time.rate_hz = 5.0;
    return race(settings, frames, quiet);
}

report::ResultTable speed_table(bool quiet) {
    report::ResultTable table{"Table 1: frames a second, the aircraft alone"};
    for (const PaperRow& row : paper_rows) {
        const TimedFlight raced = race_alone(row.aircraft, quiet);
        table.add({{"aircraft", row.aircraft}, {"paper: back faces only", "{:.0f}", row.back_face_fps},
            {"paper: z-buffer", "{:.0f}", row.depth_buffer_fps}, {"paper: octant order", "{:.0f}", row.octant_fps},
            {"ours: back faces only", "{:.0f}", 1000.0 / raced.median(gl_back_faces)},
            {"ours: depth buffer", "{:.0f}", 1000.0 / raced.median(gl_depth_buffer)},
            {"ours: octant order", "{:.0f}", 1000.0 / raced.median(gl_octant)},
            {"octant / back faces", "{:.2f}", over_octant(raced, gl_back_faces)},
            {"octant / depth buffer", "{:.2f}", over_octant(raced, gl_depth_buffer)}});
    }
    table.note = "Ours: an orbit at 1280x720, medians of whole frames; the three ways draw every "
                 "frame in turn. More aircraft and ground: octant study hidden-surface.";
    return table;
}

} // namespace

void study_draw_order(const base::StudyOutput& output) {
    Study study(output);
    std::vector<OrderedByEachMethod> models;
    for (const char* name : {"f15", "500md", "concave"}) {
        base::print_note(output.quiet, fmt::format("ordering {} by octants, cells and tree", name));
        models.push_back(order_by_each_method(name));
    }
    const auto add = [&](const char* file, report::ResultTable table) {
        base::print_note(output.quiet, fmt::format("{}: {}", file, table.title));
        study.add(file, std::move(table));
    };
    add("table-1", speed_table(output.quiet));
    add("table-4", paper_order_table());
    add("methods", method_table(models));
    add("wrong-pixels", wrong_pixel_table(models));
    add("bsp", bsp_table(models));
    study.finish("draw-order");
}

} // namespace octant::ui::studies::draw_order
