#include "models/polygons/file_axes.h"
#include "models/polygons/obj_writer.h"
#include "models/polygons/polygon_model.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/stopwatch.h"
#include "ui/base/data_files.h"
#include "ui/base/json_value.h"
#include "ui/base/progress.h"
#include "ui/command_line/command_line.h"
#include "ui/command_line/setting_option.h"
#include "ui/commands/commands.h"
#include "ui/settings/settings.h"
#include "ui/settings/settings_text.h"
#include "ui/world/aircraft_loader.h"
#include "ui/world/order_model.h"
#include "visuals/certificate/order_certificate.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/draworder/octant_order.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/ordercache/order_cache.h"
#include "visuals/orderfile/order_check.h"
#include "visuals/orderfile/order_text.h"
#include "visuals/orderstudy/divided_octants.h"
#include "visuals/verify/certificate.h"
#include "visuals/verify/verify.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::commands {

using namespace command_line;

namespace {

namespace fs = std::filesystem;

/// Shows progress in percent, once the work has taken a second. Measures its time.
class PercentProgress {
public:
    PercentProgress(const std::string& what, bool quiet, const std::string& unit = "%")
        : progress_(what, 100, quiet, unit) {}

    void show(double share) {
        if (watch_.ms() > 1000.0) { progress_.show(static_cast<int>(100.0 * share)); }
    }

    /// Ends the display; the milliseconds since the beginning.
    double finish() {
        const double ms = watch_.ms();
        progress_.finish();
        return ms;
    }

private:
    Stopwatch watch_;
    base::Progress progress_;
};

constexpr int default_rays = 200000; ///< of a check

struct DrawOrderOptions : base::OutputOptions {
    std::string model;
    std::string axes = "right,up,back";
    std::string method = "exact"; ///< one of method_names
    visuals::draworder::OrderOptions order;
    double min_distance_radii = 2.0; ///< of cells
    std::string cache{settings::no_order_cache};
    bool table = false;
    std::string export_file;
    std::string export_model;
    std::string certificate; ///< the file to which the proof is written
    std::string verify;      ///< a proof to check; then nothing else is done
    bool check = false;
    std::string check_file;  ///< the order to check; empty: the one that was computed
    std::optional<int> rays; ///< how many the order is tried by; 0: no trial
};

/// cells and bsp are those of the studies (visuals/orderstudy).
const std::vector<std::string_view> method_names{"paper", "exact", "cells", "bsp", "tree"};
constexpr std::size_t old_name_of_exact = 4;

Option method_option(std::string& method) {
    return {.name = "--method",
        .form = "KIND",
        .meaning = "exact (for every eye) or paper (8 octants as printed); of the studies also cells (octants "
                   "subdivided; exact beyond a minimum distance) and bsp (polygons split, no search)",
        .read =
            [&method](const Words& words) {
                const settings::FieldInfo info{.name = "--method", .form = "KIND", .meaning = ""};
                const std::size_t choice = settings::read_choice(info, words.front(), method_names);
                method = choice == old_name_of_exact ? "exact" : method_names[choice];
            },
        .shown_default = method,
        .note =
            [](const Words& words) {
                return words.front() == method_names[old_name_of_exact]
                           ? settings::old_name_note("--method", words.front(), "the old name of exact")
                           : std::string();
            }};
}

/// Throws Error where one file would be written over another, or over the model.
void check_not_overwriting(const DrawOrderOptions& options) {
    const std::array<std::pair<const char*, std::string>, 3> written{{{"--export", options.export_file},
        {"--export-model", options.export_model}, {"--certificate", options.certificate}}};
    for (std::size_t i = 0; i < written.size(); ++i) {
        const auto& [name, file] = written[i];
        for (std::size_t other = i + 1; other < written.size(); ++other) {
            if (is_same_file(file, written[other].second)) {
                throw Error(fmt::format("{}: expected another file than {}, got '{}' for both", name,
                    written[other].first, printable(file)));
            }
        }
        if (is_same_file(file, options.model) && path_exists(options.model)) {
            throw Error(fmt::format("{}: expected another file than the model, got '{}'", name, printable(file)));
        }
    }
}

/// Throws Error for options that do not go together.
void check_exclusive(const DrawOrderOptions& options) {
    if (options.model.empty() && options.verify.empty()) { throw Error("expected a model, got none"); }
    if (options.certificate.empty()) { return; }
    if (!options.check_file.empty()) {
        throw Error("--certificate: expected orders that this command finds, got those of --check '" +
                    printable(options.check_file) + "'");
    }
    if (options.method == "paper") {
        throw Error("--certificate: expected --method exact, bsp or cells, which are right for all eyes or "
                    "all from a distance on, got --method paper");
    }
}

void add_order_options(std::vector<Option>& table, DrawOrderOptions& options) {
    table.insert(table.end(),
        {text_option("model", "NAME|FILE",
             fmt::format("{}, torus or a model in a file", fmt::join(base::built_in_models, ", ")), options.model),
            text_option("--axes", "X,Y,Z", "where x, y and z of a file point", options.axes),
            method_option(options.method),
            hidden(value_option({"order-seconds", "SECONDS",
                                    "approximate time limit of the search; then polygons are split", 0.001, 3600},
                options.order.seconds)),
            text_option("--order-cache", "DIR",
                "cache of painting orders: a folder, user (octant/orders in the user cache) or none", options.cache),
            value_option(
                {"min-distance", "RADII",
                    "cells: orders are exact for eyes with |x|+|y|+|z| of at least this many model radii", 1, 1000},
                options.min_distance_radii)});
}

void add_result_options(std::vector<Option>& table, DrawOrderOptions& options) {
    table.insert(table.end(),
        {flag("--table", "print every cell and its polygon list; P1 is the first polygon", options.table),
            text_option("--export", "FILE", "output file of the painting orders, as text", options.export_file),
            text_option("--export-model", "FILE.obj",
                "output file of the polygons that the orders refer to, after splitting", options.export_model),
            text_option("--certificate", "FILE",
                "output file of a certificate that proves the order of every pair of polygons; not for --method paper",
                options.certificate),
            hidden(text_option("--verify", "FILE", "old name of octant verify FILE", options.verify)),
            {.name = "--check",
                .form = "[FILE]",
                .meaning =
                    "certify the orders of FILE for this model, or the orders just found, and test them with rays",
                .arity = Arity::Optional,
                .read =
                    [&options](const Words& words) {
                        options.check = true;
                        options.check_file = words.front();
                    }},
            with_shown_default(fmt::format("{}", default_rays),
                value_option(
                    {"rays", "N", "number of test rays, also without --check; 0 = none", 0, 1e9}, options.rays))});
    table = with_output_options(options, std::move(table));
}

void add_draw_order_options(std::vector<Option>& table, DrawOrderOptions& options) {
    add_order_options(table, options);
    add_result_options(table, options);
}

/// Throws Error for options that do not go together, and where one file would be written over
/// another or over the model.
void check_draw_order_options(const DrawOrderOptions& options) {
    check_exclusive(options);
    if (!options.verify.empty()) { return; }
    check_not_overwriting(options);
    if (!options.export_model.empty() && !options.export_model.ends_with(".obj")) {
        throw Error(fmt::format(
            "--export-model: expected a file name that ends in .obj, got '{}'", printable(options.export_model)));
    }
}

namespace proofs = visuals::verify;

using visuals::certificate::CertifiedOrder;

/// Writes a certificate into a file and adds to the figures; false where it would take more than `max_bytes`, and is
/// not written.
bool is_certificate_written(
    const fs::path& file, const CertifiedOrder& proved, std::uint64_t max_bytes, bool quiet, base::JsonValue& results) {
    PercentProgress percents("seeking proofs", quiet);
    const auto written =
        visuals::certificate::write_order_certificate(file, proved, max_bytes, [&](std::size_t done, std::size_t all) {
            percents.show(static_cast<double>(done) / static_cast<double>(all));
        });
    results["certificate_ms"] = percents.finish();
    results["certificate_unproved"] = written.unproved;
    results["certificate_bytes"] = written.bytes;
    return !written.is_too_long;
}

/// Checks a certificate without rounding and adds to the figures; whether it proves all.
bool all_proofs_hold(const fs::path& certificate, PercentProgress& percents, base::JsonValue& results) {
    const std::string file = "certificate";
    const auto verdict = proofs::verify(proofs::CertificateReader(certificate), [&](std::size_t done, std::size_t all) {
        percents.show(static_cast<double>(done) / static_cast<double>(all));
    });
    results["tolerance_sizes"] = verdict.tolerance_sizes;
    results["pairs"] = verdict.pairs;
    results["pairs_by_partings"] = verdict.by_node_planes;
    results["claims_by_polygons"] = verdict.statements.by_polygons;
    results["claims_by_sums"] = verdict.statements.by_sums;
    results["claims_never_seen"] = verdict.statements.never_both_visible;
    results["unlisted"] = verdict.unlisted;
    results["unproved"] = verdict.unproved;
    results["every_eye"] = verdict.covers_every_eye;
    if (verdict.first_unproved) { results["first_unproved"] = fmt::format("{}:{}", file, *verdict.first_unproved); }
    if (verdict.failure) {
        results["refused"] = fmt::format("{}:{}: {}", file, verdict.failure->line, verdict.failure->what);
    }
    results["verify_ms"] = percents.finish();
    results["proved"] = verdict.proved();
    return verdict.proved();
}

/// Certificates that take more bytes for each pair of the model's polygons, of which about half overlap from some eye,
/// are not written: the order has too many lists.
constexpr double max_bytes_of_a_pair = 40.0;
/// What the polygons themselves take in small models.
constexpr double bytes_of_a_polygon = 200.0;

std::uint64_t max_certificate_bytes(std::size_t polygons) {
    const auto count = static_cast<double>(polygons);
    return static_cast<std::uint64_t>(bytes_of_a_polygon * count + max_bytes_of_a_pair * 0.5 * count * (count - 1.0));
}

constexpr std::uint64_t any_length = std::numeric_limits<std::uint64_t>::max();

/// Seeks the proofs of an order and checks them without rounding, without a file; adds to the
/// figures. False where something is not proved.
bool order_is_proved(const CertifiedOrder& proved, bool quiet, base::JsonValue& results) {
    if (proved.model.polygons.empty()) { return true; }
    const base::TemporaryFolder folder;
    const fs::path file = folder.path() / "certificate";
    is_certificate_written(file, proved, any_length, quiet, results);
    PercentProgress percents("verifying", quiet);
    return all_proofs_hold(file, percents, results);
}

} // namespace

namespace draworder = visuals::draworder;
namespace ordercache = visuals::ordercache;
namespace orderfile = visuals::orderfile;
namespace orderstudy = visuals::orderstudy;

namespace {

using base::JsonValue;

/// The orders that are shown, exported and checked, and the model that they speak of.
struct PreparedOrder {
    models::polygons::PolygonModel model;
    models::polygons::FileAxes axes;
    orderfile::CellOrders orders;
    std::optional<draworder::DrawOrder> order; ///< as it is proved; nothing for cells that were read
    visuals::certificate::CertifiedModel bound_to;
    std::size_t polygons_of_file = 0;

    CertifiedOrder to_certify() const { return {model, *order, axes, bound_to}; }
};

std::string cell_name(const PreparedOrder& work, std::size_t cell) {
    const std::string& path = work.orders.cells[cell].path;
    return path.empty() ? fmt::format("{}", cell + 1) : draworder::path_in_file(path, work.axes);
}

void add_order_results(JsonValue& results, const draworder::OrderedModel& ordered, std::size_t polygons) {
    const world::PlaneTests tests = world::plane_tests(ordered);
    results["polygons"] = polygons;
    results["polygons_after_splitting"] = ordered.model.polygons.size();
    results["splits"] = ordered.splits;
    results["drawn_by"] = settings::text_of(ordered.found_by);
    const bool has_cells = ordered.order.has_one_cell_per_eye();
    results[has_cells ? "cells" : "parts"] = ordered.order.cell_count();
    results["lists"] = ordered.order.list_count();
    results["cyclic_cells"] = ordered.cyclic_cells;
    results["plane_tests_most"] = tests.most;
    results["plane_tests_mean"] = tests.mean;
    results["min_distance_m"] = ordered.min_distance_m;
    results["rays_tried"] = ordered.ray_test.rays;
    results["rays_tried_wrong"] = ordered.ray_test.wrong;
    results["proof_is_whole"] = ordered.ray_test.is_proof_complete;
    results["proof_open"] = ordered.ray_test.unproved;
}

/// How many cells a file of orders has, or parts.
void add_size(JsonValue& results, const orderfile::CellOrders& orders) {
    if (orders.parts) {
        results["parts"] = orders.parts->cell_count();
    } else {
        results["cells"] = orders.cells.size();
    }
}

/// Finds the orders of a model, or reads them from the cache, which holds those of paper and exact only.
ordercache::CachedOrder find_or_read_orders(
    models::polygons::PolygonModel model, const DrawOrderOptions& options, draworder::OrderOptions order) {
    if (options.method == "cells") {
        return {.ordered = orderstudy::ordered_by_cells(std::move(model), order, options.min_distance_radii),
            .file = {},
            .notes = {}};
    }
    if (options.method == "bsp") {
        return {.ordered = orderstudy::ordered_by_splitting(std::move(model), order), .file = {}, .notes = {}};
    }
    order.method = options.method == "paper" ? draworder::OrderMethod::Paper : draworder::OrderMethod::Exact;
    if (const auto folder = world::order_cache_folder(options.cache)) {
        return ordercache::cached_order(*folder, std::move(model), order);
    }
    return {.ordered = draworder::ordered(std::move(model), order), .file = {}, .notes = {}};
}

/// The order as it can be proved: of octants that hold from a distance on, nothing is claimed for
/// nearer eyes.
draworder::DrawOrder order_to_prove(const draworder::OrderedModel& ordered) {
    return ordered.found_by == draworder::OrderSource::Cells
               ? orderstudy::with_min_distance(ordered.order, ordered.centre_m, ordered.min_distance_m)
               : ordered.order;
}

/// Finds the orders, or reads those that are to be checked.
PreparedOrder prepare_order(const DrawOrderOptions& options, JsonValue& results) {
    world::OrderModel input = world::load_order_model(options.model, options.axes);
    for (const std::string& note : input.model.notes) { base::print_note(options.quiet, "note: " + note); }
    results["model"] = input.model.name;
    visuals::certificate::CertifiedModel bound_to{
        input.model.name, visuals::certificate::model_hash(input.model, input.axes)};
    results["model_hash"] = bound_to.hash;
    if (!options.check_file.empty()) {
        const std::size_t faces = input.model.polygons.size();
        PreparedOrder work{std::move(input.model), input.axes, {}, {}, std::move(bound_to), faces};
        work.orders = orderfile::read_order_file(options.check_file, faces, work.axes);
        if (work.orders.parts) {
            work.order = work.orders.parts;
            work.model.parents = work.orders.parents;
        }
        results["orders"] = options.check_file;
        results["polygons"] = faces;
        add_size(results, work.orders);
        return work;
    }
    results["method"] = options.method;
    const std::size_t polygons = input.model.polygons.size();
    draworder::OrderOptions order = options.order;
    PercentProgress percents("searching for cells", options.quiet, "% of the budget");
    order.progress = [&](double share) { percents.show(share); };
    ordercache::CachedOrder cached = find_or_read_orders(std::move(input.model), options, order);
    draworder::OrderedModel& ordered = cached.ordered;
    const double build_ms = percents.finish();
    for (const std::string& note : cached.notes) { base::print_note(options.quiet, "note: " + note); }
    add_order_results(results, ordered, polygons);
    if (options.cache != settings::no_order_cache) { results["from_cache"] = cached.was_cached; }
    results["build_ms"] = build_ms;
    for (const std::string& note : ordered.notes) { base::print_note(options.quiet, "note: " + note); }
    if (options.json) {
        results["notes"] = ordered.notes; // else they are said
    }
    orderfile::CellOrders orders = orderfile::cell_orders(ordered);
    draworder::DrawOrder proved = order_to_prove(ordered);
    return {std::move(ordered.model), input.axes, std::move(orders), std::move(proved), std::move(bound_to), polygons};
}

void export_files(const PreparedOrder& work, const DrawOrderOptions& options) {
    if (!options.export_model.empty()) {
        models::polygons::write_obj(options.export_model, work.model, work.axes);
        base::print_note(options.quiet, "model: " + options.export_model);
    }
    if (options.export_file.empty()) { return; }
    orderfile::CellOrders orders = work.orders;
    for (orderfile::ListedCell& cell : orders.cells) {
        if (cell.directions.empty()) { cell.planes = orderfile::without_redundant(cell.planes); }
    }
    write_file(options.export_file, orderfile::order_text(orders, work.axes));
    base::print_note(options.quiet, "orders: " + options.export_file);
}

std::string unproved_pair_text(const PreparedOrder& work, const orderfile::UnprovedPair& doubt) {
    const std::string cell = cell_name(work, doubt.cell);
    if (doubt.first == doubt.later) {
        return fmt::format("cell {}: P{} is not listed and may face an eye", cell, doubt.first + 1);
    }
    return fmt::format(
        "cell {}: P{} is painted before P{} and may hide part of it", cell, doubt.first + 1, doubt.later + 1);
}

/// Adds to the figures; false when something could not be certified.
bool write_and_check_certificate(const PreparedOrder& work, const DrawOrderOptions& options, JsonValue& results) {
    base::Progress progress("checking cells", static_cast<int>(work.orders.cells.size()), options.quiet, "cells");
    const orderfile::OrderCheck check = orderfile::check_order(
        work.model, work.orders, [&](std::size_t done, std::size_t) { progress.show(static_cast<int>(done)); });
    progress.finish();
    results["pairs"] = check.pairs;
    results["pairs_certified_by_planes"] = check.by_plane;
    results["pairs_certified_by_programmes"] = check.by_linear_program;
    results["pairs_not_certified"] = check.pairs_unproved;
    results["unlisted"] = check.unlisted;
    results["unlisted_not_certified"] = check.unlisted_unproved;
    auto first_unproved = JsonValue::list({});
    for (const orderfile::UnprovedPair& doubt : check.first_unproved) {
        first_unproved.push_back(unproved_pair_text(work, doubt));
    }
    results["doubts"] = first_unproved;
    return check.good();
}

/// Adds to the figures; false when a ray sees a wrong polygon or an eye has no cell.
bool ray_test_passes(const PreparedOrder& work, int rays, JsonValue& results) {
    const orderfile::RayTestCounts count = world::cast_rays(work.model, work.orders, rays);
    results["eyes"] = count.eyes;
    results["eyes_without_cell"] = count.eyes_without_cell;
    results["rays_that_hit"] = count.hits;
    results["rays_wrong"] = count.wrong;
    results["wrong_share"] = count.wrong_share();
    return count.wrong == 0 && count.eyes_without_cell == 0;
}

void print_table(const std::vector<orderfile::OrderRow>& rows) {
    for (const orderfile::OrderRow& row : rows) {
        const std::string cell = row.region.empty() ? row.cell : fmt::format("{}  [{}]", row.cell, row.region);
        std::fputs(fmt::format("{}\t{}\n", cell, row.list).c_str(), stdout);
    }
}

void print_results(const PreparedOrder& work, const DrawOrderOptions& options, bool checked, JsonValue results) {
    const auto rows =
        options.table ? orderfile::order_table(work.model, work.orders, work.axes) : std::vector<orderfile::OrderRow>{};
    if (options.json) {
        for (const orderfile::OrderRow& row : rows) {
            results["table"].push_back({{"cell", row.cell}, {"region", row.region}, {"order", row.list}});
        }
        base::print_value(results, true);
        return;
    }
    print_table(rows);
    if (!options.table || checked) { base::print_value(results, false); }
}

/// Throws Error where a certificate is of other polygons than those of the model.
void require_same_model(const DrawOrderOptions& options) {
    const world::OrderModel input = world::load_order_model(options.model, options.axes);
    const std::string hash = visuals::certificate::model_hash(input.model, input.axes);
    const proofs::CertificateReader reader(std::filesystem::path(options.verify));
    if (const proofs::Certificate& of = reader.certificate(); of.model_hash != hash) {
        throw_error_in(options.verify,
            fmt::format("expected a certificate of {}, whose polygons have the hash {}, got one of {} with {}",
                printable(options.model), hash, printable(of.model), of.model_hash));
    }
}

/// Writes the certificate of an order, and adds to the figures what it leaves unproved. Where it would be too long,
/// polygons are split by planes instead, which `work` then is about.
void write_certificate(const DrawOrderOptions& options, PreparedOrder& work, JsonValue& results) {
    if (work.model.polygons.empty()) { throw Error("--certificate: expected polygons that can be seen, got none"); }
    const std::uint64_t max_bytes =
        options.method == "exact" ? max_certificate_bytes(work.polygons_of_file) : any_length;
    if (!is_certificate_written(options.certificate, work.to_certify(), max_bytes, options.quiet, results)) {
        base::print_note(options.quiet, fmt::format("note: a certificate of this order would take more than {} bytes: "
                                                    "polygons are split by planes instead, as with --method bsp",
                                            max_bytes));
        DrawOrderOptions by_planes = options;
        by_planes.method = "bsp";
        by_planes.quiet = true;
        work = prepare_order(by_planes, results);
        is_certificate_written(options.certificate, work.to_certify(), any_length, options.quiet, results);
    }
    base::print_note(options.quiet, "certificate: " + options.certificate);
}

void draw_order(const DrawOrderOptions& options) {
    check_draw_order_options(options);
    if (!options.verify.empty()) {
        if (options.model.empty()) {
            base::print_note(options.quiet, "note: draw-order --verify is now octant verify");
        } else {
            require_same_model(options);
        }
        replace_by_program({"octant-verify", options.verify, options.json ? "--json" : "--quiet"});
    }
    world::order_cache_folder(options.cache); // refused before the work
    JsonValue results;
    PreparedOrder work = prepare_order(options, results);
    if (!options.certificate.empty()) { write_certificate(options, work, results); }
    export_files(work, options);
    bool good = true;
    if (options.check && work.orders.parts) {
        good = order_is_proved(work.to_certify(), options.quiet, results);
    } else if (options.check) {
        good = write_and_check_certificate(work, options, results);
    }
    const int rays = options.rays.value_or(options.check ? default_rays : 0);
    if (rays > 0) { good = ray_test_passes(work, rays, results) && good; }
    const bool checked = options.check || rays > 0;
    if (checked) { results["right"] = good; }
    print_results(work, options, checked, std::move(results));
    if (!good) { throw CheckFailed(); }
}

} // namespace

Command draw_order_command() {
    auto options = std::make_shared<DrawOrderOptions>();
    Command command = {.name = "draw-order",
        .summary = "Finds, shows, exports and checks the painting orders of a model",
        .footer = "Exit code 1: a check failed. A file of orders refers to the polygons written by --export-model, in "
                  "the\naxes of that file.\nExamples:\n  octant draw-order concave --method paper --table\n  octant "
                  "draw-order f15 --export f15-orders.txt --export-model f15-split.obj\n  octant draw-order "
                  "f15-split.obj --check f15-orders.txt\n  octant draw-order torus --order-cache orders\n  octant "
                  "draw-order f15 --certificate f15-proof.txt\n  octant verify f15-proof.txt",
        .run = [options] { draw_order(*options); }};
    add_draw_order_options(command.options, *options);
    return command;
}

} // namespace octant::ui::commands
