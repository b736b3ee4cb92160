#include "models/meshfile/level_chain.h"
#include "models/meshfile/mesh_file.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "ui/base/json_value.h"
#include "ui/command_line/setting_option.h"
#include "ui/commands/commands.h"
#include "ui/commands/simplify_run.h"
#include "ui/world/mesh_loader.h"

#include <filesystem>
#include <fmt/format.h>
#include <malloc.h>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::commands {

using namespace command_line;

namespace meshfile = models::meshfile;

namespace {

void check_output(const SimplifyArguments& command, const std::string& name) {
    const std::filesystem::path out = name;
    for (const std::string& input : command.files) {
        if (&input != &command.files.back() && is_same_file(input, out)) {
            throw Error(fmt::format("OUT: expected another file than the input, got '{}'", printable(name)));
        }
    }
    if (is_same_file(command.polygons, out)) {
        throw Error(fmt::format("OUT: expected another file than the input, got '{}'", printable(name)));
    }
    if (command.chain != meshfile::is_chain_file(out)) {
        throw Error(fmt::format("OUT: expected a name that ends in .chain with --chain, and another one without, got "
                                "'{}'",
            printable(name)));
    }
    if (!command.chain && !meshfile::is_writable_mesh_file(out)) {
        throw Error(fmt::format("OUT: expected a name that ends in .obj, .ply, .stl, .gltf, .glb, .ac or .wrl, got "
                                "'{}'",
            printable(name)));
    }
    check_can_write(out);
}

/// An option of the command line and whether it was given.
struct NamedFlag {
    std::string_view name;
    bool is_given;
};

/// Throws Error where an option stands with one of others that would have no effect or contradict it.
void check_exclusive(std::string_view option, const std::vector<NamedFlag>& others) {
    for (const NamedFlag& other : others) {
        if (other.is_given) { throw Error(fmt::format("{}: expected no {} with it, got both", option, other.name)); }
    }
}

/// Sets what the files are, by the options that say what is made of them.
void assign_files(SimplifyArguments& command) {
    const std::size_t count = command.files.size();
    command.in = command.files.front();
    if (command.shared_border) {
        if (count < 2 || command.out_dir.empty()) {
            throw Error(fmt::format("--shared-border: expected two meshes or more and --out-dir, got {} and {}", count,
                command.out_dir.empty() ? "none" : "one"));
        }
        return;
    }
    if (!command.out_dir.empty()) { throw Error("--out-dir: expected --shared-border with it, got none"); }
    if (count == 1 && !command.chart.empty()) {
        check_exclusive("--chart without OUT", {{"--faces", command.faces > 0}, {"--vertices", command.vertices > 0},
                                                   {"--error", !command.error.empty()}, {"--chain", command.chain}});
        return;
    }
    if (count != 2) { throw Error(fmt::format("expected IN and OUT, got {} files", count)); }
    command.out = command.files.back();
    check_output(command, command.out);
}

void check_chart_options(const SimplifyArguments& command) {
    if (!command.chart.ends_with(".html")) {
        throw Error(fmt::format("--chart: expected a name that ends in .html, got '{}'", printable(command.chart)));
    }
    std::vector<std::string> others = command.files; // OUT, too
    others.push_back(command.polygons);
    for (const std::string& other : others) {
        if (is_same_file(other, command.chart)) {
            throw Error(fmt::format("--chart: expected another file than '{}', got the same", printable(other)));
        }
    }
    check_can_write(command.chart);
}

/// The outputs of --shared-border: the inputs' names in another folder. The folder is made, so that it is known before
/// the work that all can be written.
void check_folder_options(const SimplifyArguments& command) {
    std::set<std::filesystem::path> names;
    for (const std::string& file : command.files) {
        const std::filesystem::path name = std::filesystem::path(file).filename();
        if (is_same_file(file, std::filesystem::path(command.out_dir) / name)) {
            throw Error(fmt::format("--out-dir: expected another folder than that of '{}'", printable(file)));
        }
        if (!meshfile::is_writable_mesh_file(name)) {
            throw Error(fmt::format("--shared-border: expected meshes that can be written again, such as .obj or .ply, "
                                    "got '{}'",
                printable(file)));
        }
        if (!names.insert(name).second) {
            throw Error(fmt::format(
                "--shared-border: expected files of different names, got '{}' twice", printable(name.string())));
        }
    }
    make_folder(command.out_dir);
    for (const std::filesystem::path& name : names) { check_can_write(command.out_dir / name); }
}

void check_goals(const SimplifyArguments& command) {
    if (!command.error.empty()) { error_m_from(command.error, 1.0); }
    const int goals = static_cast<int>(command.vertices > 0) + static_cast<int>(command.faces > 0) +
                      static_cast<int>(!command.error.empty());
    if (command.out.empty() && !command.shared_border) {
        return; // A chart alone has none.
    }
    if (command.chain ? goals > 0 && command.faces == 0 : goals != 1) {
        throw Error(fmt::format("expected {}, got {} goals",
            command.chain ? "--chain alone or with --faces of its coarsest level"
                          : "one of --vertices, --faces and --error",
            goals));
    }
    if (paper_measure(command.method) && (command.chain || !command.error.empty())) {
        throw Error(fmt::format("--method {}: expected --vertices or --faces alone, got {}", command.method,
            command.chain ? "--chain" : "--error"));
    }
}

/// Options that have no effect in one of the ways to simplify.
void check_unused_options(const SimplifyArguments& command) {
    const NamedFlag uv_error{"--uv-error", command.uv_error > 0.0};
    const NamedFlag normal_error{"--attribute-error normal", command.normal_error > 0.0};
    const NamedFlag colour_error{"--attribute-error colour", command.colour_error > 0.0};
    const NamedFlag effort{"--effort", command.effort >= 0};
    const NamedFlag steps{"--steps", command.steps >= 0};
    const NamedFlag max_seconds{"--max-seconds", command.max_seconds > 0.0};
    const NamedFlag chart{"--chart", !command.chart.empty()};
    const NamedFlag shared_border{"--shared-border", command.shared_border};
    if (paper_measure(command.method)) {
        check_exclusive("--method " + command.method,
            {uv_error, normal_error, colour_error, effort, steps, max_seconds, chart, shared_border,
                {"--keep-shells", command.keep_shells}, {"--keep-topology", command.keep_topology},
                {"--keep-seams-apart", command.keep_seams_apart}, {"--lock-border", command.lock_border}});
    } else if (!command.method.empty()) {
        check_exclusive("--method " + command.method, {effort, steps});
    }
    if (command.chain) {
        check_exclusive("--chain", {uv_error, normal_error, colour_error, shared_border, max_seconds});
    }
    if (chart.is_given) { check_exclusive("--chart", {shared_border, max_seconds}); }
    if (max_seconds.is_given) { check_exclusive("--max-seconds", {steps}); }
    // With several tries the effort limits each of them.
    const bool has_several_tries = !command.error.empty() || has_attribute_bound(command);
    if (effort.is_given && !has_several_tries) { check_exclusive("--effort", {steps, max_seconds}); }
}

void check_simplify_options(SimplifyArguments& command) {
    assign_files(command);
    check_goals(command);
    check_unused_options(command);
    if (!command.polygons.empty() && !command.chain) { throw Error("--polygons: expected --chain with it, got none"); }
    if (!command.chart.empty()) { check_chart_options(command); }
    if (command.shared_border) { check_folder_options(command); }
}

/// Gives freed memory back to the system at once, where main keeps it for the next picture
/// (visuals/gl/platform_tuning.h): large arrays follow one another here. Does nothing on C libraries other than glibc.
void release_free_memory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
    mallopt(M_TRIM_THRESHOLD, 1 << 20);
    mallopt(M_TOP_PAD, 1 << 17);
#endif
}

void run(SimplifyArguments command) {
    check_simplify_options(command);
    release_free_memory();
    base::JsonValue results;
    if (!command.shared_border) { results["in"] = command.in; }
    if (!command.out.empty()) { results["out"] = command.out; }
    const bool is_reached =
        command.shared_border ? simplify_with_shared_borders(command, results) : simplify_one(command, results);
    base::print_value(results, command.json);
    if (!is_reached) { throw CheckFailed(); }
}

/// Options of one group, with its heading in help.
void add_group(std::vector<Option>& table, std::string_view heading, std::vector<Option> options) {
    for (Option& option : options) {
        option.heading = heading;
        table.push_back(std::move(option));
    }
}

std::vector<Option> goal_options(SimplifyArguments& command) {
    std::vector<Option> table{required(list_option("files", "IN OUT",
        "mesh to simplify: " + world::built_in_mesh_names() +
            " or a file: .obj, .ply, .stl, .off, .gltf, .glb, .ac, .wrl; and the file to write, "
            "whose ending says how. With --shared-border only meshes; with --chart OUT may be "
            "left out",
        Arity::OneOrMore, command.files))};
    add_group(table, "Goal (one of them)",
        {value_option(
             {"faces", "N", "target number of triangles; with --chain: of the coarsest level [no goal]", 1, 2e9},
             command.faces),
            value_option({"vertices", "N", "target number of vertices [no goal]", 1, 2e9}, command.vertices),
            text_option("--error", "E|P%",
                "as few triangles as possible within this two-sided distance: in file units, or as a percentage of the "
                "bounding box diagonal, such as 0.1%",
                command.error)});
    return table;
}

void add_bound_options(std::vector<Option>& table, SimplifyArguments& command) {
    const std::string heading = "Attribute error bounds";
    add_group(table, heading,
        {value_option({"uv-error", "U", "largest error of texture coordinates; 1 = the width of the texture [no bound]",
                          1e-9, 1e9},
            command.uv_error)});
    add_family(table,
        {.name = "--attribute-error", .form = "KEY=VALUE,...", .meaning = "other attributes:", .heading = heading},
        {{"normal", value_option({"normal-error", "DEGREES", "largest error of normals [no bound]", 0.01, 180},
                        command.normal_error)},
            {"colour", value_option({"colour-error", "SHARE",
                                        "largest error of colours: a distance in RGB, each 0..1 [no bound]", 1e-4, 2},
                           command.colour_error)},
            {"colour-weight", value_option({"colour-weight", "W",
                                               "distance that a colour difference of 1 is worth, in bounding box "
                                               "diagonals [0.015; methods of the paper 0.1]",
                                               0, 1000},
                                  command.colour_weight)}});
}

void add_constraint_options(std::vector<Option>& table, SimplifyArguments& command) {
    add_group(table, "Constraints",
        {flag("--keep-shells",
             "keep at least one triangle of every connected part, even if the goal is then out of reach",
             command.keep_shells),
            flag("--keep-topology",
                "keep all parts, holes and handles, even if the goal is then out of reach; implied by --chain",
                command.keep_topology),
            hidden(flag("--keep-seams-apart", "weld only vertices whose positions and colours are identical",
                command.keep_seams_apart)),
            flag("--lock-border",
                "do not move vertices of open borders, even if the goal is then out of reach; implies --keep-topology",
                command.lock_border),
            flag("--shared-border",
                "simplify several meshes together, so that no gap opens along their common borders; goals apply to all "
                "meshes together",
                command.shared_border),
            text_option("--out-dir", "DIR",
                "with --shared-border: output folder; output files have the names of the input files",
                command.out_dir)});
}

void add_work_options(std::vector<Option>& table, SimplifyArguments& command) {
    add_group(table, "Effort",
        {value_option({"effort", "0..9",
                          "optimization effort: each level doubles the number of steps; 5 and above use more sample "
                          "points; 0 = no optimization [4]",
                          0, 9},
             command.effort),
            value_option({"max-seconds", "S",
                             "time limit of the optimization; a note gives the --steps value that repeats the result. "
                             "Collapses and the certificate are not limited [no limit]",
                             1e-3, 1e6},
                command.max_seconds),
            value_option({"steps", "N",
                             "number of optimization steps, summed over all attempts where --error or a bound needs "
                             "several; with --chain and --chart: for each level [given by --effort]",
                             0, 2e9},
                command.steps),
            choice_option("--method", "KIND",
                "surface (--effort 4) or fast (--effort 1); as printed in the 2005 paper: plane, "
                "triangle or bidirectional [surface]",
                {"surface", "fast", "plane", "triangle", "bidirectional"}, command.method),
            threads_option(command.threads)});
    add_group(table, "Output",
        with_output_options(command,
            {text_option("--chart", "FILE.html",
                 "write a page that plots error against number of faces for a series of levels, with the command that "
                 "makes each level",
                 command.chart),
                flag("--chain", "write levels of detail, each with half the triangles, to OUT.chain", command.chain),
                text_option("--polygons", "FILE.obj", "with --chain: polygon model to use instead of the last level",
                    command.polygons)}));
}

constexpr const char* simplify_footer =
    "Examples:\n"
    "  octant simplify bunny.ply small.obj --faces 1000\n"
    "  octant simplify scan.stl part.glb --error 0.1%\n"
    "  octant simplify house.obj far.obj --error 0.05 --uv-error 0.01\n"
    "  octant simplify west.obj east.obj --shared-border --out-dir small --error 0.5\n"
    "  octant simplify gasket.stl small.stl --faces 500 --keep-topology\n"
    "  octant simplify bunny.ply --chart bunny.html\n"
    "  octant simplify scan.ply jet.chain --chain && octant fly turn --aircraft jet.chain\n"
    "Texture coordinates, normals, colours and materials stay, also along seams. Notes say what a\n"
    "file has that is not read, and what OUT's format does not hold.\n"
    "Exit code 1: the mesh is written, but a goal or a bound was out of reach.\n"
    "Results: error is the largest distance between the surfaces, both ways, certified for the\n"
    "written file; rms the root mean square; in file units and as fractions of the diagonal.\n"
    "Keys of --json: in, out, faces_in_file, repairs, faces_before, vertices_before, faces,\n"
    "  vertices, method (or effort), steps (of all tries together), shells_gone, holes_closed,\n"
    "  handles_cut, error, error_of_diagonal, rms, rms_of_diagonal, colour_rms, colour_error "
    "(lengths in RGB 0..1),\n"
    "  uv_error, uv_rms, normal_error, normal_rms (degrees; each where there are such "
    "attributes),\n"
    "  time_s, cpu_s (collapse, optimizer, certificate: processor time);\n"
    "  with --shared-border files (in, out, faces, vertices, error and so on each);\n"
    "  with --chart also chart, levels;\n"
    "  with --chain instead levels (faces, error, error_of_diagonal each), polygons,\n"
    "  polygons_error;\n"
    "  as printed also reading, contractions, counted_vertices, feet, feet_outside,\n"
    "  share_outside, error_sum_plane, error_sum_triangle, error_sum_bidirectional,\n"
    "  duplicate_faces, non_manifold_edges.";

} // namespace

Command simplify_command() {
    auto work = std::make_shared<SimplifyArguments>();
    Command command = {.name = "simplify",
        .summary = "Simplifies a mesh and certifies the error of the result",
        .options = goal_options(*work),
        .footer = simplify_footer,
        .run = [work] { run(*work); }};
    add_bound_options(command.options, *work);
    add_constraint_options(command.options, *work);
    add_work_options(command.options, *work);
    return command;
}

} // namespace octant::ui::commands
