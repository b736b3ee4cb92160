#include "ui/studies/refinement/study_refinement.h"

#include "models/procedural/procedural_terrain.h"
#include "models/simplify/simplify.h"
#include "sim/base/output_file.h"
#include "ui/base/progress.h"
#include "ui/report/table_text.h"
#include "ui/studies/refinement/refinement_pictures.h"
#include "ui/studies/refinement/refinement_tables.h"
#include "ui/world/refine_mesh.h"

#include <cstdio>
#include <fmt/format.h>
#include <utility>

namespace octant::ui::studies::refinement {

namespace {

namespace refine = visuals::refine;

/// Two triangles between four samples each.
models::TriangleMesh mesh_of(const models::heights::HeightField& field) {
    models::TriangleMesh mesh;
    mesh.name = field.name;
    const auto columns = static_cast<std::uint32_t>(field.columns());
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            mesh.vertices_m.push_back(field.sample_m(column, row));
            if (row + 1 < field.rows() && column + 1 < field.columns()) {
                const auto at = static_cast<std::uint32_t>(mesh.vertices_m.size() - 1);
                mesh.triangles.push_back({at, at + 1, at + columns + 1});
                mesh.triangles.push_back({at, at + columns + 1, at + columns});
            }
        }
    }
    return mesh;
}

RefinedModel made_ground(int base) {
    models::procedural::ProceduralTerrainOptions made;
    made.size = 129;
    models::TriangleMesh mesh = mesh_of(models::procedural::procedural_hills(made));
    mesh.name = "hills";
    models::simplify::SimplifyOptions options;
    options.length_share = 0.03;
    options.goal.vertices = static_cast<std::size_t>(base);
    return std::make_shared<const refine::ProgressiveMesh>(
        models::simplify::fast_sequence(std::move(mesh), options));
}

std::vector<RefinedModel> read_models(const RefinementStudyOptions& options) {
    std::vector<RefinedModel> models;
    for (const std::string& file : options.meshes) {
        world::RefineMeshOptions input;
        input.file = file;
        input.base = static_cast<std::size_t>(options.base);
        input.quiet = options.quiet;
        models.push_back(world::load_refine_mesh(input).mesh);
    }
    if (models.empty()) {
        models.push_back(made_ground(options.base));
    }
    return models;
}

} // namespace

void study_refinement(const RefinementStudyOptions& options) {
    const std::vector<RefinedModel> models = read_models(options);
    make_folder(options.out);
    std::vector<report::HtmlTable> tables;
    std::string markdown;
    const auto add = [&](const char* file, report::HtmlTable table) {
        write_file(options.out / (std::string(file) + ".csv"), report::csv_of(table));
        markdown += report::markdown_of(table) + "\n";
        tables.push_back(std::move(table));
        base::print_note(options.quiet, fmt::format("done: {}", file));
    };
    add("forced-splits", forced_splits_table(models));
    add("refinement-path", refinement_path_table(models, options.frames));
    add("refinement-speed", refinement_speed_table(models));
    // The made ground has z up, mesh files y.
    markdown +=
        write_refinement_pictures(models.back(), !options.meshes.empty(), options.out) + "\n";
    base::print_note(options.quiet, "done: pictures");
    write_file(options.out / "refinement.md", markdown);
    std::fputs((options.json ? report::json_of(tables) : markdown).c_str(), stdout);
}

} // namespace octant::ui::studies::refinement
