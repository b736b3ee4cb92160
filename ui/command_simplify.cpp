#include "models/measure/mesh_distance.h"
#include "models/meshfile/level_chain.h"
#include "models/meshfile/mesh_file.h"
#include "models/meshfile/repair.h"
#include "models/obj_reader.h"
#include "models/simplify/simplify.h"
#include "sim/base/error.h"
#include "ui/chain_maker.h"
#include "ui/commands.h"
#include "ui/progress.h"
#include "ui/settings_options.h"
#include "ui/stopwatch.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>

namespace octant::ui {

namespace simplify = models::simplify;
namespace meshfile = models::meshfile;

namespace {

using Json = nlohmann::ordered_json;

struct SimplifyCommand {
    std::string in;
    std::string out;
    int vertices = 0; ///< 0: no goal
    int faces = 0;    ///< 0: no goal
    std::string error;
    std::string method = "surface";
    double colour_weight = 0.1;
    int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    bool chain = false;
    std::string polygons;
    std::string axes = "right,up,back";
    bool json = false;
    bool quiet = false;
};

/// "0.5" in the file's units or "0.1%" of the diagonal.
double error_m_from(const std::string& text, double diagonal_m) {
    const bool share = text.ends_with('%');
    const std::string number = share ? text.substr(0, text.size() - 1) : text;
    double value = 0.0;
    const auto [end, fault] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (fault != std::errc() || end != number.data() + number.size() || !(value > 0.0) ||
        !std::isfinite(value)) {
        throw Error(fmt::format(
            "--error: expected a number above 0 in file units, or with % of the diagonal, got '{}'",
            printable(text)));
    }
    return share ? value / 100.0 * diagonal_m : value;
}

void refuse_faults(const SimplifyCommand& command) {
    const std::filesystem::path out = command.out;
    std::error_code ignored;
    for (const std::string& input : {command.in, command.polygons}) {
        if (!input.empty() && (std::filesystem::weakly_canonical(input, ignored) ==
                                   std::filesystem::weakly_canonical(out, ignored) ||
                               std::filesystem::equivalent(input, out, ignored))) {
            throw Error(fmt::format(
                "OUT: expected another file than the input, got '{}'", printable(command.out)));
        }
    }
    if (command.chain != meshfile::is_chain_file(out)) {
        throw Error(fmt::format(
            "OUT: expected a name that ends in .chain with --chain, and another one without, got "
            "'{}'",
            printable(command.out)));
    }
    if (!command.chain && !meshfile::is_mesh_file(out)) {
        throw Error(fmt::format(
            "OUT: expected a name that ends in .obj, .ply, .stl, .gltf, .glb, .ac or .wrl, got "
            "'{}'",
            printable(command.out)));
    }
    const int goals = static_cast<int>(command.vertices > 0) + static_cast<int>(command.faces > 0) +
                      static_cast<int>(!command.error.empty());
    if (command.chain ? goals > 0 && command.faces == 0 : goals != 1) {
        throw Error(fmt::format(
            "expected {}, got {} goals",
            command.chain ? "--chain alone or with --faces of its coarsest level"
                          : "one of --vertices, --faces and --error",
            goals));
    }
    if (!command.polygons.empty() && !command.chain) {
        throw Error("--polygons: expected --chain with it, got none");
    }
}

simplify::SimplifyOptions options_of(const SimplifyCommand& command, double diagonal_m) {
    simplify::SimplifyOptions options;
    options.quality =
        command.method == "fast" ? simplify::Quality::Fast : simplify::Quality::Surface;
    if (command.vertices > 0) {
        options.goal.vertices = static_cast<std::size_t>(command.vertices);
    }
    if (command.faces > 0) {
        options.goal.faces = static_cast<std::size_t>(command.faces);
    }
    if (!command.error.empty()) {
        options.goal.error_m = error_m_from(command.error, diagonal_m);
    }
    options.colour_weight = command.colour_weight;
    options.threads = command.threads;
    return options;
}

models::TriangleMesh read_repaired(const SimplifyCommand& command, Json& figures) {
    models::TriangleMesh mesh = meshfile::read_mesh(command.in);
    figures["faces_in_file"] = mesh.triangles.size();
    meshfile::RepairedMesh repaired = meshfile::repaired(std::move(mesh));
    auto repairs = Json::array();
    for (const std::string& line : meshfile::in_words(repaired.counts)) {
        say(command.quiet, "repaired: " + line);
        repairs.push_back(line);
    }
    for (const std::string& note : repaired.mesh.notes) {
        say(command.quiet, "note: " + note);
    }
    figures["repairs"] = repairs;
    if (repaired.mesh.triangles.empty()) {
        error_in(command.in, "expected at least one triangle with an area, got none");
    }
    return std::move(repaired.mesh);
}

void add_distance(
    Json& figures,
    const models::TriangleMesh& original,
    const models::TriangleMesh& mesh,
    int threads) {
    const double diagonal_m = models::diagonal_m(original);
    const models::measure::MeshDistance distance = models::measure::distance(
        original, mesh, {.negligible_m = 1e-6 * diagonal_m, .threads = threads});
    figures["error"] = distance.most_hausdorff_m();
    figures["error_of_diagonal"] = distance.most_hausdorff_m() / diagonal_m;
    figures["rms"] = distance.rms_m();
    figures["rms_of_diagonal"] = distance.rms_m() / diagonal_m;
    if (!original.colours.empty()) {
        figures["colour_rms"] = distance.colour_rms();
    }
}

void make_mesh(const SimplifyCommand& command, Json& figures) {
    models::TriangleMesh original = read_repaired(command, figures);
    simplify::SimplifyOptions options = options_of(command, models::diagonal_m(original));
    figures["faces_before"] = original.triangles.size();
    figures["vertices_before"] = original.vertices_m.size();
    Progress progress("simplifying", 100, command.quiet, "percent");
    options.show_progress = [&](double share) { progress.show(static_cast<int>(100.0 * share)); };
    const Stopwatch watch;
    const simplify::Simplified result = simplify::simplified(std::move(original), options);
    const double time_s = watch.s();
    progress.finish();
    meshfile::write_mesh(command.out, result.mesh);
    figures["faces"] = result.mesh.triangles.size();
    figures["vertices"] = result.mesh.vertices_m.size();
    figures["method"] = command.method;
    if (!result.mesh.triangles.empty()) {
        add_distance(figures, result.sequence.original, result.mesh, command.threads);
    }
    figures["time_s"] = time_s;
    const bool short_of_faces =
        options.goal.faces && result.mesh.triangles.size() > *options.goal.faces;
    const bool short_of_vertices =
        options.goal.vertices && result.mesh.vertices_m.size() > *options.goal.vertices;
    if (short_of_faces || short_of_vertices) {
        say(command.quiet,
            "note: no edge can collapse any more without changing the kind of surface");
    }
}

void make_chain(const SimplifyCommand& command, Json& figures) {
    models::TriangleMesh original = read_repaired(command, figures);
    ChainOptions options;
    options.simplify = options_of(command, models::diagonal_m(original));
    options.axes = models::FileAxes::from_text(command.axes);
    if (command.faces > 0) {
        options.coarsest_faces = static_cast<std::size_t>(command.faces);
    }
    if (!command.polygons.empty()) {
        options.polygons = models::read_obj(command.polygons, options.axes);
    }
    Progress progress("making levels", 100, command.quiet, "percent");
    options.show_level = [&](std::size_t done, std::size_t of) {
        progress.show(static_cast<int>(100 * done / std::max<std::size_t>(of, 1)));
    };
    const Stopwatch watch;
    const meshfile::LevelChain chain = level_chain(std::move(original), options);
    const double time_s = watch.s();
    progress.finish();
    meshfile::write_chain(command.out, chain);
    const double diagonal_m = models::diagonal_m(chain.levels.front().mesh);
    auto levels = Json::array();
    for (const meshfile::ChainLevel& level : chain.levels) {
        levels.push_back(
            {{"faces", level.mesh.triangles.size()},
             {"error", level.error_m},
             {"error_of_diagonal", level.error_m / diagonal_m}});
    }
    figures["levels"] = levels;
    figures["polygons"] = chain.polygons ? chain.polygons->polygons.size() : 0;
    if (chain.polygons) {
        figures["polygons_error"] = chain.polygons_error_m;
    }
    figures["time_s"] = time_s;
}

void print(const Json& figures, bool json) {
    if (json) {
        std::fputs(fmt::format("{}\n", figures.dump(2)).c_str(), stdout);
        return;
    }
    for (const auto& [key, value] : figures.items()) {
        if (key == "repairs") {
            continue; // said already
        }
        if (key == "levels") {
            for (const auto& level : value) {
                std::fputs(
                    fmt::format(
                        "level of {} faces: error {:.4g}, {:.3g} of the diagonal\n",
                        level["faces"].get<std::size_t>(),
                        level["error"].get<double>(),
                        level["error_of_diagonal"].get<double>())
                        .c_str(),
                    stdout);
            }
            continue;
        }
        const std::string text = value.is_string() ? value.get<std::string>()
                                 : value.is_number_float()
                                     ? fmt::format("{:.4g}", value.get<double>())
                                     : value.dump();
        std::fputs(fmt::format("{:<20} {}\n", key, text).c_str(), stdout);
    }
}

void run(const SimplifyCommand& command) {
    refuse_faults(command);
    Json figures;
    figures["in"] = command.in;
    figures["out"] = command.out;
    if (command.chain) {
        make_chain(command, figures);
    } else {
        make_mesh(command, figures);
    }
    print(figures, command.json);
}

void add_goal_options(CLI::App& cli, SimplifyCommand& command) {
    cli.add_option("in", command.in, "mesh to simplify: .obj, .ply, .stl, .gltf, .glb, .ac, .wrl")
        ->type_name("IN")
        ->required();
    cli.add_option("out", command.out, "file to write, its ending says how")
        ->type_name("OUT")
        ->required();
    add_number_option(
        cli, {"vertices", "N", "go down to so many vertices", 1, 2e9}, command.vertices);
    add_number_option(
        cli,
        {"faces", "N", "go down to so many triangles; with --chain of the coarsest level", 1, 2e9},
        command.faces);
    cli.add_option("--error", command.error)
        ->description("go as far as the certified two-sided distance stays below, in file units "
                      "or, as 0.1%, of the diagonal of the bounding box")
        ->type_name("E|P%");
}

void add_other_options(CLI::App& cli, SimplifyCommand& command) {
    cli.add_option_function<std::string>(
           "--method",
           [&command](const std::string& text) {
               const std::vector<std::string_view> names = {"surface", "fast"};
               command.method = names[read_choice({"--method", "", ""}, text, names)];
           },
           "surface (distance to the original surface, both ways) or fast (quadrics)")
        ->type_name("KIND")
        ->default_str("surface");
    add_number_option(
        cli,
        {"colour-weight", "W", "what a colour difference of 1 counts, in diagonals", 0, 1000},
        command.colour_weight);
    add_number_option(
        cli, {"threads", "N", "threads to work on; changes no result", 1, 1024}, command.threads);
    cli.add_flag("--chain", command.chain, "write levels of detail, halving, into OUT.chain");
    cli.add_option("--polygons", command.polygons)
        ->description("with --chain: polygons for its far end, instead of the last level")
        ->type_name("FILE.obj");
    cli.add_option("--axes", command.axes, "where x, y and z of the files point, for polygons")
        ->type_name("X,Y,Z")
        ->capture_default_str();
    cli.add_flag("--json", command.json, "results as JSON");
    cli.add_flag("--quiet", command.quiet, "no progress, no notes");
}

} // namespace

void add_simplify_command(CLI::App& program) {
    auto command = std::make_shared<SimplifyCommand>();
    CLI::App* cli = program.add_subcommand(
        "simplify", "Reduces triangles of a mesh and certifies how far the result is off");
    add_goal_options(*cli, *command);
    add_other_options(*cli, *command);
    for (const char* option : {"--vertices", "--faces", "--colour-weight", "--threads"}) {
        cli->get_option(option)->group("Options");
    }
    cli->footer("error: certified two-sided distance (Hausdorff), rms: root mean square, in file "
                "units and as fractions of the diagonal.\n"
                "Examples:\n"
                "  octant simplify bunny.ply small.obj --faces 1000\n"
                "  octant simplify scan.stl part.glb --error 0.1%\n"
                "  octant simplify f15.obj f15.chain --chain");
    cli->callback([command] { run(*command); });
}

} // namespace octant::ui
