#include "models/meshfile/level_chain.h"
#include "models/meshfile/mesh_file.h"
#include "sim/base/error.h"
#include "sim/base/file_status.h"
#include "sim/base/output_file.h"
#include "ui/base/figures_text.h"
#include "ui/base/memory.h"
#include "ui/commands/commands.h"
#include "ui/commands/read_option.h"
#include "ui/commands/simplify_work.h"
#include "ui/world/mesh_input.h"

#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <vector>

namespace octant::ui::commands {

namespace meshfile = models::meshfile;

namespace {

void refuse_faults(const SimplifyCommand& command) {
    const std::filesystem::path out = command.out;
    for (const std::string& input : {command.in, command.polygons}) {
        if (is_same_file(input, out)) {
            throw Error(fmt::format(
                "OUT: expected another file than the input, got '{}'", printable(command.out)));
        }
    }
    if (!command.error.empty()) {
        error_m_from(command.error, 1.0);
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
    if (paper_measure(command.method) && (command.chain || !command.error.empty())) {
        throw Error(fmt::format(
            "--method {}: expected --vertices or --faces alone, got {}",
            command.method,
            command.chain ? "--chain" : "--error"));
    }
    if (!command.polygons.empty() && !command.chain) {
        throw Error("--polygons: expected --chain with it, got none");
    }
    check_can_write(out);
}

void run(const SimplifyCommand& command) {
    refuse_faults(command);
    base::give_memory_back();
    base::Figures figures;
    bool is_reached = true;
    figures["in"] = command.in;
    figures["out"] = command.out;
    if (command.chain) {
        simplify_into_chain(command, figures);
    } else if (const auto measure = paper_measure(command.method)) {
        simplify_as_printed(command, *measure, figures);
    } else {
        is_reached = simplify_mesh(command, figures);
    }
    base::print_figures(figures, command.json);
    if (!is_reached) {
        throw CheckSaidNo();
    }
}

std::vector<Option> goal_options(SimplifyCommand& command) {
    return {
        required(text_option(
            "in",
            "IN",
            "mesh to simplify: " + world::built_in_meshes() +
                " or a file: .obj, .ply, .stl, .gltf, .glb, .ac, .wrl",
            command.in)),
        required(text_option("out", "OUT", "file to write, its ending says how", command.out)),
        read_option(
            {"vertices", "N", "go down to so many vertices [no goal]", 1, 2e9}, command.vertices),
        read_option(
            {"faces",
             "N",
             "go down to so many triangles; with --chain of the coarsest level [no goal]",
             1,
             2e9},
            command.faces),
        text_option(
            "--error",
            "E|P%",
            "go as far as the certified two-sided distance stays below, in file units or, as 0.1%, "
            "of the diagonal of the bounding box",
            command.error)};
}

void add_other_options(std::vector<Option>& table, SimplifyCommand& command) {
    table.insert(
        table.end(),
        {choice_option(
             "--method",
             "KIND",
             "surface (--effort 4) or fast (--effort 1); as printed in the 2005 paper: plane, "
             "triangle or bidirectional",
             {"surface", "fast", "plane", "triangle", "bidirectional"},
             command.method),
         read_option(
             {"effort",
              "0..9",
              "how long to optimize; each one more doubles the steps, 0 makes none [4]",
              0,
              9},
             command.effort),
         read_option(
             {"steps", "N", "so many steps of the optimization [those of --effort]", 0, 2e9},
             command.steps),
         read_option(
             {"max-seconds",
              "S",
              "end the optimization after this time; --steps then repeats the result [no limit]",
              0,
              1e6},
             command.max_seconds),
         read_option(
             {"colour-weight", "W", "what a colour difference of 1 counts, in diagonals", 0, 1000},
             command.colour_weight),
         read_option(
             {"threads", "N", "that work; change no result [all processors]", 1, 1024},
             command.threads),
         flag("--chain", "write levels of detail, halving, into OUT.chain", command.chain),
         flag(
             "--keep-seams-apart",
             "weld only vertices that agree to the bit, colours too",
             command.keep_seams_apart),
         flag(
             "--keep-shells",
             "let none vanish, also where a goal is out of reach then",
             command.keep_shells),
         text_option(
             "--polygons",
             "FILE.obj",
             "with --chain: polygons for its far end, instead of the last level",
             command.polygons),
         flag("--json", "results as JSON", command.json),
         flag("--quiet", "no progress, no notes", command.quiet)});
}

constexpr const char* simplify_footer =
    "error: certified two-sided distance (Hausdorff), rms: root mean square, in file units and as\n"
    "fractions of the diagonal.\n"
    "Exit code 1: the mesh is written, but the goal was out of reach.\n"
    "Keys of --json: in, out, faces_in_file, repairs, faces_before, vertices_before, faces,\n"
    "  vertices, method, steps (that the optimization tried), shells_gone, error,\n"
    "  error_of_diagonal, rms, rms_of_diagonal, colour_rms (length in RGB 0..1, where there are\n"
    "  colours), time_s, cpu_s (collapse, optimizer, certificate: processor time);\n"
    "  with --chain instead levels (faces, error, error_of_diagonal each), polygons,\n"
    "  polygons_error;\n"
    "  as printed also reading, contractions, counted_vertices, feet, feet_outside,\n"
    "  share_outside, error_sum_plane, error_sum_triangle, error_sum_bidirectional,\n"
    "  duplicate_faces, non_manifold_edges.\n"
    "Examples:\n"
    "  octant simplify bunny.ply small.obj --faces 1000\n"
    "  octant simplify scan.stl part.glb --error 0.1%\n"
    "  octant simplify scan.ply jet.chain --chain && octant fly turn --aircraft jet.chain";

} // namespace

Command simplify_command() {
    auto work = std::make_shared<SimplifyCommand>();
    Command command = {
        .name = "simplify",
        .summary = "Reduces triangles of a mesh and certifies how far the result is off",
        .options = goal_options(*work),
        .footer = simplify_footer,
        .run = [work] { run(*work); }};
    add_other_options(command.options, *work);
    return command;
}

} // namespace octant::ui::commands
