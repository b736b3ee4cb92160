#include "models/polygons/obj_writer.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "ui/base/figures_text.h"
#include "ui/base/progress.h"
#include "ui/base/stopwatch.h"
#include "ui/commands/commands.h"
#include "ui/commands/settings_options.h"
#include "ui/world/order_input.h"
#include "visuals/draworder/order_check.h"
#include "visuals/draworder/order_table.h"
#include "visuals/draworder/order_text.h"
#include "visuals/draworder/separation.h"

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace octant::ui::commands {

namespace draworder = visuals::draworder;

namespace {

using Json = nlohmann::ordered_json;

struct DrawOrderOptions {
    std::string model;
    std::string axes = "right,up,back";
    draworder::OrderOptions order;
    bool table = false;
    std::string export_file;
    std::string export_model;
    bool check = false;
    std::string check_file; ///< empty: what was computed
    int rays = 200000;      ///< 0: none
    bool json = false;
    bool quiet = false;
};

/// The orders that are shown, exported and checked, and the model that they speak of.
struct Work {
    models::polygons::PolygonModel model;
    models::polygons::FileAxes axes;
    draworder::CellOrders orders;
};

std::string cell_name(const Work& work, std::size_t cell) {
    const std::string& path = work.orders.cells[cell].path;
    return path.empty() ? fmt::format("{}", cell + 1) : draworder::path_in_file(path, work.axes);
}

Json figures_of(const draworder::OrderedModel& ordered, std::size_t polygons) {
    const world::PlaneTests tests = world::plane_tests(ordered);
    Json figures;
    figures["polygons"] = polygons;
    figures["polygons_after_splitting"] = ordered.model.polygons.size();
    figures["splits"] = ordered.splits;
    figures["cells"] = ordered.order.cell_count();
    figures["lists"] = ordered.order.list_count();
    figures["cyclic_cells"] = ordered.cyclic_cells;
    figures["plane_tests_most"] = tests.most;
    figures["plane_tests_mean"] = tests.mean;
    figures["min_distance_m"] = ordered.min_distance_m;
    return figures;
}

/// Finds the orders, or reads them.
Work prepared(const DrawOrderOptions& options, Json& figures) {
    world::OrderInput input = world::read_order_input(options.model, options.axes);
    for (const std::string& note : input.model.notes) {
        base::say(options.quiet, "note: " + note);
    }
    figures["model"] = input.model.name;
    if (!options.check_file.empty()) {
        const std::size_t faces = input.model.polygons.size();
        Work work{std::move(input.model), input.axes, {}};
        work.orders = draworder::read_order_file(options.check_file, faces, work.axes);
        figures["orders"] = options.check_file;
        figures["polygons"] = faces;
        figures["cells"] = work.orders.cells.size();
        return work;
    }
    constexpr std::array names = {"paper", "cells", "tree"};
    figures["method"] = names[static_cast<std::size_t>(options.order.method)];
    const std::size_t polygons = input.model.polygons.size();
    const base::Stopwatch watch;
    draworder::OrderedModel ordered = draworder::ordered(std::move(input.model), options.order);
    const double build_ms = watch.ms();
    figures.update(figures_of(ordered, polygons));
    figures["build_ms"] = build_ms;
    for (const std::string& note : ordered.notes) {
        base::say(options.quiet, "note: " + note);
    }
    figures["notes"] = ordered.notes;
    draworder::CellOrders orders = draworder::cell_orders(ordered);
    return {std::move(ordered.model), input.axes, std::move(orders)};
}

/// Throws Error where one file would be written over another, or over the model.
void refuse_overwriting(const DrawOrderOptions& options) {
    const auto same = [](const std::string& a, const std::string& b) {
        return !a.empty() && !b.empty() &&
               std::filesystem::weakly_canonical(a) == std::filesystem::weakly_canonical(b);
    };
    if (same(options.export_file, options.export_model)) {
        throw Error(fmt::format(
            "--export: expected another file than --export-model, got '{}' for both",
            printable(options.export_file)));
    }
    for (const std::string& written : {options.export_file, options.export_model}) {
        if (same(written, options.model) && std::filesystem::exists(options.model)) {
            throw Error(fmt::format(
                "--export, --export-model: expected another file than the model, got '{}'",
                printable(written)));
        }
    }
}

void export_files(const Work& work, const DrawOrderOptions& options) {
    if (!options.export_model.empty()) {
        models::polygons::write_obj(options.export_model, work.model, work.axes);
        base::say(options.quiet, "model: " + options.export_model);
    }
    if (options.export_file.empty()) {
        return;
    }
    draworder::CellOrders orders = work.orders;
    for (draworder::ListedCell& cell : orders.cells) {
        if (cell.directions.empty()) {
            cell.planes = draworder::without_redundant(cell.planes);
        }
    }
    write_file(options.export_file, draworder::order_text(orders, work.axes));
    base::say(options.quiet, "orders: " + options.export_file);
}

std::string doubt_in_words(const Work& work, const draworder::Doubt& doubt) {
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
bool certified(const Work& work, const DrawOrderOptions& options, Json& figures) {
    base::Progress progress(
        "checking cells", static_cast<int>(work.orders.cells.size()), options.quiet, "cells");
    const draworder::OrderCheck check =
        draworder::certify(work.model, work.orders, [&](std::size_t done, std::size_t) {
            progress.show(static_cast<int>(done));
        });
    progress.finish();
    figures["pairs"] = check.pairs;
    figures["pairs_certified_by_planes"] = check.by_plane;
    figures["pairs_certified_by_programmes"] = check.by_programme;
    figures["pairs_not_certified"] = check.pairs_open;
    figures["unlisted"] = check.unlisted;
    figures["unlisted_not_certified"] = check.unlisted_open;
    auto doubts = Json::array();
    for (const draworder::Doubt& doubt : check.doubts) {
        doubts.push_back(doubt_in_words(work, doubt));
    }
    figures["doubts"] = doubts;
    return check.good();
}

/// Adds to the figures; false when a ray sees a wrong polygon or an eye has no cell.
bool rays_are_right(const Work& work, int rays, Json& figures) {
    const draworder::RayCount count = world::cast_rays(work.model, work.orders, rays);
    figures["eyes"] = count.eyes;
    figures["eyes_without_cell"] = count.eyes_in_gap;
    figures["rays_that_hit"] = count.hits;
    figures["rays_wrong"] = count.wrong;
    figures["wrong_share"] = count.wrong_share();
    return count.wrong == 0 && count.eyes_in_gap == 0;
}

void print_table(const std::vector<draworder::OrderRow>& rows) {
    for (const draworder::OrderRow& row : rows) {
        const std::string cell =
            row.region.empty() ? row.cell : fmt::format("{}  [{}]", row.cell, row.region);
        std::fputs(fmt::format("{}\t{}\n", cell, row.list).c_str(), stdout);
    }
}

void print_results(const Work& work, const DrawOrderOptions& options, Json figures) {
    const auto rows = options.table ? draworder::order_table(work.model, work.orders, work.axes)
                                    : std::vector<draworder::OrderRow>{};
    if (options.json) {
        for (const draworder::OrderRow& row : rows) {
            figures["table"].push_back(
                {{"cell", row.cell}, {"region", row.region}, {"order", row.list}});
        }
        base::print_figures(figures, true);
        return;
    }
    figures.erase("notes"); // said already
    print_table(rows);
    if (!options.table || options.check || options.rays > 0) {
        base::print_figures(figures, false);
    }
}

void draw_order(const DrawOrderOptions& options) {
    refuse_overwriting(options);
    if (!options.export_model.empty() && !options.export_model.ends_with(".obj")) {
        throw Error(fmt::format(
            "--export-model: expected a file name that ends in .obj, got '{}'",
            printable(options.export_model)));
    }
    Json figures;
    const Work work = prepared(options, figures);
    export_files(work, options);
    bool good = true;
    if (options.check) {
        good = certified(work, options, figures);
    }
    if (options.rays > 0) {
        good = rays_are_right(work, options.rays, figures) && good;
    }
    if (options.check || options.rays > 0) {
        figures["right"] = good;
    }
    print_results(work, options, figures);
    if (!good) {
        throw CheckSaidNo();
    }
}

void add_order_options(CLI::App& command, DrawOrderOptions& options) {
    command.add_option("model", options.model, "f15, 500md, concave, torus or an OBJ file")
        ->type_name("NAME|FILE")
        ->required();
    command.add_option("--axes", options.axes, "where x, y and z of an OBJ file point")
        ->type_name("X,Y,Z")
        ->capture_default_str();
    command
        .add_option_function<std::string>(
            "--method",
            [&options](const std::string& text) {
                options.order.method = static_cast<draworder::Method>(
                    settings::read_choice({"--method", "", ""}, text, {"paper", "cells", "tree"}));
            },
            "paper (8 octants as printed), cells (octants divided further, exact from a distance "
            "on) or tree (planes over eye space, exact everywhere)")
        ->type_name("KIND")
        ->default_str("tree");
    add_number_option(
        command,
        {"min-distance", "RADII", "cells: exact for eyes |x|+|y|+|z| away, in radii", 1, 1000},
        options.order.min_distance_radii);
}

void add_result_options(CLI::App& command, DrawOrderOptions& options) {
    command.add_flag(
        "--table", options.table, "show every cell and its list, P1 the first polygon");
    command.add_option("--export", options.export_file, "write the orders as text")
        ->type_name("FILE");
    command
        .add_option(
            "--export-model",
            options.export_model,
            "write the polygons, split where they had to be, that the orders speak of")
        ->type_name("FILE.obj");
    command.add_option("--check", options.check_file)
        ->description("certify and try with rays: the orders of FILE for this model, without FILE "
                      "those just found")
        ->type_name("[FILE]")
        ->expected(0, 1);
    add_number_option(
        command,
        {"rays", "N", "try with so many rays, also without --check; 0 = none", 0, 1e9},
        options.rays);
    command.add_flag("--json", options.json, "results as JSON");
    command.add_flag("--quiet", options.quiet, "no progress, no notes");
}

} // namespace

void add_draw_order_command(CLI::App& program) {
    auto options = std::make_shared<DrawOrderOptions>();
    CLI::App* command = program.add_subcommand(
        "draw-order", "Finds, shows, exports and checks the painting orders of a model");
    add_order_options(*command, *options);
    add_result_options(*command, *options);
    command->footer(
        "Exit code 1: a check said no. A file of orders speaks of the model that --export-model "
        "writes, in the axes of that file.\n"
        "Examples:\n"
        "  octant draw-order concave --method paper --table\n"
        "  octant draw-order f15 --export f15-orders.txt --export-model f15-split.obj\n"
        "  octant draw-order f15-split.obj --check f15-orders.txt");
    command->callback([options, command] {
        options->check = command->count("--check") > 0;
        if (!options->check && command->count("--rays") == 0) {
            options->rays = 0;
        }
        draw_order(*options);
    });
}

} // namespace octant::ui::commands
