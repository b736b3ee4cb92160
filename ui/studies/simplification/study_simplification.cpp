#include "ui/studies/simplification/study_simplification.h"

#include "sim/base/output_file.h"
#include "ui/base/progress.h"
#include "ui/report/table_text.h"
#include "ui/studies/simplification/peer_program.h"
#include "ui/studies/simplification/simplification_runs.h"
#include "ui/studies/simplification/simplification_tables.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <iterator>
#include <string>
#include <utility>

namespace octant::ui::studies::simplification {

namespace {

struct StudyMeshes {
    std::vector<StudyMesh> meshes;
    std::string left_out; ///< in words; empty = nothing
};

StudyMeshes meshes_of(const SimplificationStudyOptions& options) {
    StudyMeshes all;
    if (options.bunny) {
        all.meshes.push_back(bunny_from(*options.bunny));
    } else {
        all.left_out = "Left out: the bunny, which is not ours to ship; give the Stanford "
                       "repository's bun_zipper.ply by --bunny.\n\n";
    }
    std::vector<StudyMesh> built_in = built_in_mesh_names();
    std::move(built_in.begin(), built_in.end(), std::back_inserter(all.meshes));
    for (const std::filesystem::path& file : options.meshes) {
        all.meshes.push_back(study_mesh_from(file));
    }
    return all;
}

/// The paper's goal, or as far as the bunny goes.
std::size_t paper_goal(const StudyMesh& mesh) {
    constexpr double bunny_share = 2000.0 / 35947.0;
    if (mesh.name == "bunny") {
        return paper_bunny_vertices;
    }
    if (mesh.name == "globe") {
        return paper_globe_vertices;
    }
    return static_cast<std::size_t>(
        bunny_share * static_cast<double>(mesh.original.vertices_m.size()));
}

std::vector<ColourReading> colour_readings(const StudyMesh& mesh) {
    if (mesh.original.colours.empty()) {
        return {ColourReading::None};
    }
    return {ColourReading::None, ColourReading::Distance, ColourReading::DistanceAndLength};
}

std::vector<PaperRun> all_paper_runs(const std::vector<StudyMesh>& meshes, bool quiet) {
    constexpr int measures = 3;
    int total = 0;
    for (const StudyMesh& mesh : meshes) {
        total += measures * static_cast<int>(colour_readings(mesh).size());
    }
    base::Progress progress("the paper's simplifier", total, quiet, "results");
    int done = 0;
    std::vector<PaperRun> runs;
    for (const StudyMesh& mesh : meshes) {
        const OnResult tick = [&] { progress.show(++done, mesh.name); };
        for (const ColourReading colour : colour_readings(mesh)) {
            auto of_mesh = paper_runs(mesh, paper_goal(mesh), colour, tick);
            std::move(of_mesh.begin(), of_mesh.end(), std::back_inserter(runs));
        }
    }
    return runs;
}

std::vector<std::size_t> goals_for(const StudyMesh& mesh, const std::vector<std::size_t>& wanted) {
    if (!wanted.empty()) {
        return wanted;
    }
    std::vector<std::size_t> goals;
    for (const double share : {0.15, 0.05, 0.025}) {
        goals.push_back(
            static_cast<std::size_t>(share * static_cast<double>(mesh.clean.triangles.size())));
    }
    return goals;
}

QualityOptions quality_options(const SimplificationStudyOptions& options) {
    QualityOptions quality;
    if (const auto program = options.peers ? options.peers : find_peer_program()) {
        quality.program = *program;
        quality.folder = options.out;
        quality.peers = methods_of_peer(*program, options.out);
    }
    return quality;
}

/// Coloured meshes twice: for their shape alone by every method, with colour by those that know it.
std::vector<QualityRun> all_quality_runs(
    const std::vector<StudyMesh>& meshes,
    const SimplificationStudyOptions& options,
    const QualityOptions& quality) {
    int total = 0;
    for (const StudyMesh& mesh : meshes) {
        const int goals = static_cast<int>(goals_for(mesh, options.faces).size());
        const bool coloured = !mesh.clean.colours.empty();
        total += goals * (quality_methods(quality) + (coloured ? quality_methods({}) : 0));
    }
    base::Progress progress("every method", total, options.quiet, "results");
    int done = 0;
    std::vector<QualityRun> runs;
    const auto add = [&](const StudyMesh& mesh, const QualityOptions& with) {
        const OnResult tick = [&] { progress.show(++done, mesh.name); };
        auto of_mesh = quality_runs(mesh, goals_for(mesh, options.faces), with, tick);
        std::move(of_mesh.begin(), of_mesh.end(), std::back_inserter(runs));
    };
    for (const StudyMesh& mesh : meshes) {
        add(uncoloured(mesh), quality);
        if (!mesh.clean.colours.empty()) {
            StudyMesh coloured = mesh;
            coloured.name += ", coloured";
            add(coloured, {});
        }
    }
    return runs;
}

/// Tables by the names of their files.
using FiledTables = std::vector<std::pair<std::string, report::HtmlTable>>;

void write_and_print(
    const FiledTables& filed,
    const std::string& opening,
    const std::string& figure,
    const SimplificationStudyOptions& options) {
    std::string markdown = opening;
    std::vector<report::HtmlTable> tables;
    for (const auto& [file, table] : filed) {
        write_file(options.out / (file + ".csv"), report::csv_of(table));
        markdown += report::markdown_of(table) + "\n";
        tables.push_back(table);
    }
    std::fputs((options.json ? report::json_of(tables) : markdown).c_str(), stdout);
    if (!figure.empty()) {
        write_file(options.out / "rms.png", figure);
        markdown += "![rms.png](rms.png)\n\nRMS distance to the original over the number of "
                    "faces.\n";
    }
    write_file(options.out / "simplification.md", markdown);
    base::print_note(
        options.quiet,
        fmt::format("tables: {0}/simplification.md and one .csv each", options.out.string()));
}

} // namespace

void study_simplification(const SimplificationStudyOptions& options) {
    const StudyMeshes given = meshes_of(options);
    make_folder(options.out);
    const QualityOptions quality = options.paper_only ? QualityOptions() : quality_options(options);
    const std::vector<PaperRun> paper = all_paper_runs(given.meshes, options.quiet);
    FiledTables tables;
    tables.emplace_back("table-1", feet_table(paper));
    tables.emplace_back("table-2", paper_error_table(paper));
    std::string figure;
    if (!options.paper_only) {
        const std::vector<QualityRun> runs = all_quality_runs(given.meshes, options, quality);
        tables.emplace_back("quality", quality_table(runs, !quality.peers.empty()));
        figure = quality_figure(runs);
        if (figure.empty()) {
            base::print_note(
                options.quiet,
                "rms.png not made: it takes gnuplot and more than one number of faces");
        }
    }
    write_and_print(tables, paper_reading_text() + given.left_out, figure, options);
}

} // namespace octant::ui::studies::simplification
