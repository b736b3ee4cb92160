#include "ui/commands/draw_order_options.h"

#include "sim/base/error.h"
#include "sim/base/file_status.h"
#include "ui/base/data_files.h"
#include "ui/commands/value_option.h"
#include "ui/settings/settings_text.h"

#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace octant::ui::commands {

using visuals::draworder::OrderMethod;

namespace {

/// Throws Error where one file would be written over another, or over the model.
void check_not_overwriting(const DrawOrderOptions& options) {
    const std::array<std::pair<const char*, std::string>, 3> written{
        {{"--export", options.export_file},
         {"--export-model", options.export_model},
         {"--certificate", options.certificate}}};
    for (std::size_t i = 0; i < written.size(); ++i) {
        const auto& [name, file] = written[i];
        for (std::size_t other = i + 1; other < written.size(); ++other) {
            if (is_same_file(file, written[other].second)) {
                throw Error(fmt::format(
                    "{}: expected another file than {}, got '{}' for both",
                    name,
                    written[other].first,
                    printable(file)));
            }
        }
        if (is_same_file(file, options.model) && path_exists(options.model)) {
            throw Error(fmt::format(
                "{}: expected another file than the model, got '{}'", name, printable(file)));
        }
    }
}

/// Throws Error for options that do not go together.
void check_exclusive(const DrawOrderOptions& options) {
    if (options.model.empty() == options.verify.empty()) {
        throw Error(
            options.model.empty()
                ? "expected a model, or --verify with a certificate, got neither"
                : "--verify: expected no model beside a certificate, which holds its own, got '" +
                      printable(options.model) + "'");
    }
    if (options.certificate.empty()) {
        return;
    }
    if (!options.check_file.empty()) {
        throw Error(
            "--certificate: expected orders that this command finds, got those of --check '" +
            printable(options.check_file) + "'");
    }
    if (options.order.method == OrderMethod::Paper) {
        throw Error(
            "--certificate: expected --method tree, bsp or cells, which are right for all eyes or "
            "all from a distance on, got --method paper");
    }
}

void add_order_options(std::vector<Option>& table, DrawOrderOptions& options) {
    table.insert(
        table.end(),
        {text_option(
             "model",
             "NAME|FILE",
             fmt::format("{}, torus or an OBJ file", fmt::join(base::built_in_models, ", ")),
             options.model),
         text_option("--axes", "X,Y,Z", "where x, y and z of an OBJ file point", options.axes),
         value_option(
             {"method",
              "KIND",
              "paper (8 octants as printed), cells (octants divided further, exact from a distance "
              "on), tree (planes over eye space, exact everywhere) or bsp (polygons divided)"},
             options.order.method),
         value_option(
             {"order-seconds",
              "SECONDS",
              "cells, tree: about so long is searched; then polygons are divided as by bsp",
              0.001,
              3600},
             options.order.seconds),
         text_option(
             "--order-cache",
             "DIR",
             "keep the orders in this folder, and read them where the same model is ordered again",
             options.cache),
         value_option(
             {"min-distance", "RADII", "cells: exact for eyes |x|+|y|+|z| away, in radii", 1, 1000},
             options.order.min_distance_radii)});
}

void add_result_options(std::vector<Option>& table, DrawOrderOptions& options) {
    table.insert(
        table.end(),
        {flag("--table", "show every cell and its list, P1 the first polygon", options.table),
         text_option("--export", "FILE", "write the orders as text", options.export_file),
         text_option(
             "--export-model",
             "FILE.obj",
             "write the polygons, split where they had to be, that the orders speak of",
             options.export_model),
         text_option(
             "--certificate",
             "FILE",
             "write for each pair of polygons what proves that it is painted right; not of paper",
             options.certificate),
         text_option(
             "--verify",
             "FILE",
             "check a certificate without rounding, in place of all else",
             options.verify),
         {.name = "--check",
          .form = "[FILE]",
          .meaning = "certify and try with rays: the orders of FILE for this model, without FILE "
                     "those just found",
          .arity = Arity::Optional,
          .read =
              [&options](const Words& words) {
                  options.check = true;
                  options.check_file = words.front();
              }},
         with_shown_default(
             fmt::format("{}", default_rays),
             value_option(
                 {"rays", "N", "try with so many rays, also without --check; 0 = none", 0, 1e9},
                 options.rays)),
         flag("--json", "results as JSON", options.json),
         flag("--quiet", "no progress, no notes", options.quiet)});
}

} // namespace

void add_draw_order_options(std::vector<Option>& table, DrawOrderOptions& options) {
    add_order_options(table, options);
    add_result_options(table, options);
}

void check_draw_order_options(const DrawOrderOptions& options) {
    check_exclusive(options);
    if (!options.verify.empty()) {
        return;
    }
    check_not_overwriting(options);
    if (!options.export_model.empty() && !options.export_model.ends_with(".obj")) {
        throw Error(fmt::format(
            "--export-model: expected a file name that ends in .obj, got '{}'",
            printable(options.export_model)));
    }
}

} // namespace octant::ui::commands
