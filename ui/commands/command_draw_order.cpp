#include "models/polygons/obj_writer.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "ui/base/figures_text.h"
#include "ui/base/progress.h"
#include "ui/commands/certificate_work.h"
#include "ui/commands/commands.h"
#include "ui/commands/draw_order_options.h"
#include "ui/commands/percents.h"
#include "ui/settings/settings_text.h"
#include "ui/world/order_input.h"
#include "visuals/draworder/eyes_beyond.h"
#include "visuals/draworder/octant_path.h"
#include "visuals/ordercache/order_cache.h"
#include "visuals/orderfile/order_check.h"
#include "visuals/orderfile/order_table.h"
#include "visuals/orderfile/order_text.h"
#include "visuals/separation/separation.h"

#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::commands {

namespace separation = visuals::separation;
namespace draworder = visuals::draworder;
namespace ordercache = visuals::ordercache;
namespace orderfile = visuals::orderfile;

namespace {

using base::Figures;

/// The orders that are shown, exported and checked, and the model that they speak of.
struct Work {
    models::polygons::PolygonModel model;
    models::polygons::FileAxes axes;
    orderfile::CellOrders orders;
    std::optional<draworder::DrawOrder>
        order; ///< as it is proved; nothing for cells that were read
};

std::string cell_name(const Work& work, std::size_t cell) {
    const std::string& path = work.orders.cells[cell].path;
    return path.empty() ? fmt::format("{}", cell + 1) : draworder::path_in_file(path, work.axes);
}

void add_figures(Figures& figures, const draworder::OrderedModel& ordered, std::size_t polygons) {
    const world::PlaneTests tests = world::plane_tests(ordered);
    figures["polygons"] = polygons;
    figures["polygons_after_splitting"] = ordered.model.polygons.size();
    figures["splits"] = ordered.splits;
    figures["drawn_by"] = settings::text_of(ordered.drawn_by);
    const bool has_cells = ordered.order.one_cell_an_eye();
    figures[has_cells ? "cells" : "parts"] = ordered.order.cell_count();
    figures["lists"] = ordered.order.list_count();
    figures["cyclic_cells"] = ordered.cyclic_cells;
    figures["plane_tests_most"] = tests.most;
    figures["plane_tests_mean"] = tests.mean;
    figures["min_distance_m"] = ordered.min_distance_m;
    figures["rays_tried"] = ordered.trial.rays;
    figures["rays_tried_wrong"] = ordered.trial.wrong;
    figures["proof_is_whole"] = ordered.trial.is_proof_whole;
    figures["proof_open"] = ordered.trial.unproved;
}

/// How many cells a file of orders has, or parts.
void add_size(Figures& figures, const orderfile::CellOrders& orders) {
    if (orders.parts) {
        figures["parts"] = orders.parts->cell_count();
    } else {
        figures["cells"] = orders.cells.size();
    }
}

/// Finds the orders of a model, or reads them from the cache.
ordercache::CachedOrder found(
    models::polygons::PolygonModel model,
    const std::optional<std::string>& cache,
    const draworder::OrderOptions& options) {
    if (cache) {
        return ordercache::cached_order(*cache, std::move(model), options);
    }
    return {.ordered = draworder::ordered(std::move(model), options), .file = {}, .notes = {}};
}

/// The order as it can be proved: of octants that hold from a distance on, nothing is claimed for
/// nearer eyes.
draworder::DrawOrder provable(const draworder::OrderedModel& ordered) {
    return ordered.drawn_by == draworder::DrawnBy::Cells
               ? draworder::eyes_beyond(ordered.order, ordered.centre_m, ordered.min_distance_m)
               : ordered.order;
}

/// Finds the orders, or reads those that are to be checked.
Work prepared(const DrawOrderOptions& options, Figures& figures) {
    world::OrderInput input = world::read_order_input(options.model, options.axes);
    for (const std::string& note : input.model.notes) {
        base::say(options.quiet, "note: " + note);
    }
    figures["model"] = input.model.name;
    if (!options.check_file.empty()) {
        const std::size_t faces = input.model.polygons.size();
        Work work{std::move(input.model), input.axes, {}, {}};
        work.orders = orderfile::read_order_file(options.check_file, faces, work.axes);
        if (work.orders.parts) {
            work.order = work.orders.parts;
            work.model.parents = work.orders.parents;
        }
        figures["orders"] = options.check_file;
        figures["polygons"] = faces;
        add_size(figures, work.orders);
        return work;
    }
    figures["method"] = settings::text_of(options.order.method);
    const std::size_t polygons = input.model.polygons.size();
    draworder::OrderOptions order = options.order;
    Percents percents("searching for cells", options.quiet, "% of the budget");
    order.progress = [&](double share) { percents.show(share); };
    ordercache::CachedOrder cached = found(std::move(input.model), options.cache, order);
    draworder::OrderedModel& ordered = cached.ordered;
    const double build_ms = percents.finish();
    for (const std::string& note : cached.notes) {
        base::say(options.quiet, "note: " + note);
    }
    add_figures(figures, ordered, polygons);
    if (options.cache) {
        figures["from_cache"] = cached.was_kept;
    }
    figures["build_ms"] = build_ms;
    for (const std::string& note : ordered.notes) {
        base::say(options.quiet, "note: " + note);
    }
    if (options.json) {
        figures["notes"] = ordered.notes; // else they are said
    }
    orderfile::CellOrders orders = orderfile::cell_orders(ordered);
    draworder::DrawOrder proved = provable(ordered);
    return {std::move(ordered.model), input.axes, std::move(orders), std::move(proved)};
}

void export_files(const Work& work, const DrawOrderOptions& options) {
    if (!options.export_model.empty()) {
        models::polygons::write_obj(options.export_model, work.model, work.axes);
        base::say(options.quiet, "model: " + options.export_model);
    }
    if (options.export_file.empty()) {
        return;
    }
    orderfile::CellOrders orders = work.orders;
    for (orderfile::ListedCell& cell : orders.cells) {
        if (cell.directions.empty()) {
            cell.planes = separation::without_redundant(cell.planes);
        }
    }
    write_file(options.export_file, orderfile::order_text(orders, work.axes));
    base::say(options.quiet, "orders: " + options.export_file);
}

std::string doubt_in_words(const Work& work, const orderfile::Doubt& doubt) {
    const std::string cell = cell_name(work, doubt.cell);
    if (doubt.first == doubt.later) {
        return fmt::format("cell {}: P{} is not listed and may face an eye", cell, doubt.first + 1);
    }
    return fmt::format(
        "cell {}: P{} is painted before P{} and may hide part of it",
        cell,
        doubt.first + 1,
        doubt.later + 1);
}

/// Adds to the figures; false when something could not be certified.
bool certified(const Work& work, const DrawOrderOptions& options, Figures& figures) {
    base::Progress progress(
        "checking cells", static_cast<int>(work.orders.cells.size()), options.quiet, "cells");
    const orderfile::OrderCheck check =
        orderfile::check_order(work.model, work.orders, [&](std::size_t done, std::size_t) {
            progress.show(static_cast<int>(done));
        });
    progress.finish();
    figures["pairs"] = check.pairs;
    figures["pairs_certified_by_planes"] = check.by_plane;
    figures["pairs_certified_by_programmes"] = check.by_programme;
    figures["pairs_not_certified"] = check.pairs_open;
    figures["unlisted"] = check.unlisted;
    figures["unlisted_not_certified"] = check.unlisted_open;
    auto doubts = Figures::list({});
    for (const orderfile::Doubt& doubt : check.doubts) {
        doubts.push_back(doubt_in_words(work, doubt));
    }
    figures["doubts"] = doubts;
    return check.good();
}

/// Adds to the figures; false when a ray sees a wrong polygon or an eye has no cell.
bool rays_are_right(const Work& work, int rays, Figures& figures) {
    const orderfile::RayCount count = world::cast_rays(work.model, work.orders, rays);
    figures["eyes"] = count.eyes;
    figures["eyes_without_cell"] = count.eyes_in_gap;
    figures["rays_that_hit"] = count.hits;
    figures["rays_wrong"] = count.wrong;
    figures["wrong_share"] = count.wrong_share();
    return count.wrong == 0 && count.eyes_in_gap == 0;
}

void print_table(const std::vector<orderfile::OrderRow>& rows) {
    for (const orderfile::OrderRow& row : rows) {
        const std::string cell =
            row.region.empty() ? row.cell : fmt::format("{}  [{}]", row.cell, row.region);
        std::fputs(fmt::format("{}\t{}\n", cell, row.list).c_str(), stdout);
    }
}

void print_results(
    const Work& work, const DrawOrderOptions& options, bool checked, Figures figures) {
    const auto rows = options.table ? orderfile::order_table(work.model, work.orders, work.axes)
                                    : std::vector<orderfile::OrderRow>{};
    if (options.json) {
        for (const orderfile::OrderRow& row : rows) {
            figures["table"].push_back(
                {{"cell", row.cell}, {"region", row.region}, {"order", row.list}});
        }
        base::print_figures(figures, true);
        return;
    }
    print_table(rows);
    if (!options.table || checked) {
        base::print_figures(figures, false);
    }
}

void verify(const DrawOrderOptions& options) {
    Figures figures;
    const bool good = verified(options.verify, options.quiet, figures);
    base::print_figures(figures, options.json);
    if (!good) {
        throw CheckSaidNo();
    }
}

void draw_order(const DrawOrderOptions& options) {
    refuse_impossible(options);
    if (!options.verify.empty()) {
        verify(options);
        return;
    }
    if (options.cache) {
        ordercache::make_cache_folder(*options.cache);
    }
    Figures figures;
    const Work work = prepared(options, figures);
    export_files(work, options);
    if (!options.certificate.empty()) {
        write_certificate(
            options.certificate, {work.model, *work.order, work.axes}, options.quiet, figures);
    }
    bool good = true;
    if (options.check && work.orders.parts) {
        good = is_proved({work.model, *work.order, work.axes}, options.quiet, figures);
    } else if (options.check) {
        good = certified(work, options, figures);
    }
    const int rays = options.rays.value_or(options.check ? usual_rays : 0);
    if (rays > 0) {
        good = rays_are_right(work, rays, figures) && good;
    }
    const bool checked = options.check || rays > 0;
    if (checked) {
        figures["right"] = good;
    }
    print_results(work, options, checked, std::move(figures));
    if (!good) {
        throw CheckSaidNo();
    }
}

} // namespace

Command draw_order_command() {
    auto options = std::make_shared<DrawOrderOptions>();
    Command command = {
        .name = "draw-order",
        .summary = "Finds, shows, exports and checks the painting orders of a model",
        .footer = "Exit code 1: a check said no. A file of orders speaks of the model that "
                  "--export-model "
                  "writes, in the axes of that file.\n"
                  "Examples:\n"
                  "  octant draw-order concave --method paper --table\n"
                  "  octant draw-order f15 --export f15-orders.txt --export-model f15-split.obj\n"
                  "  octant draw-order f15-split.obj --check f15-orders.txt\n"
                  "  octant draw-order torus --order-cache orders\n"
                  "  octant draw-order f15 --certificate f15-proof.txt\n"
                  "  octant draw-order --verify f15-proof.txt",
        .run = [options] { draw_order(*options); }};
    add_draw_order_options(command.options, *options);
    return command;
}

} // namespace octant::ui::commands
