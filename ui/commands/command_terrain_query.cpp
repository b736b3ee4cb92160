#include "models/heights/height_source.h"
#include "models/heights/map_inputs.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/commands/command_terrain_parts.h"
#include "ui/commands/terrain_options.h"
#include "ui/commands/value_option.h"
#include "ui/terrain/loaded_ground.h"
#include "ui/terrain/mesh_maker.h"
#include "ui/terrain/terrain_query.h"
#include "visuals/terrain/ground_query.h"
#include "visuals/terrain/mesh_measurement.h"

#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <vector>

namespace octant::ui::commands {

namespace {

struct QueryOptions {
    ui::terrain::GroundViewOptions view;
    ui::terrain::GroundMeshOptions mesh;
    std::vector<std::string> at;
    std::string points;
    std::vector<std::string> source;
    std::optional<glm::dvec3> from_m;
    std::optional<glm::dvec3> to_m;
    bool flat = false;
    bool as_drawn = false;
    bool json = false;
};

std::vector<ui::terrain::QueryPoint> query_points(const QueryOptions& options) {
    std::vector<ui::terrain::QueryPoint> points;
    for (const std::string& text : options.at) {
        const auto point = ui::terrain::point_from_text(text);
        if (!point) { throw Error(fmt::format("--at: expected X,Y or X,Y,Z, got '{}'", printable(text))); }
        points.push_back(*point);
    }
    if (!options.points.empty()) {
        const std::vector<ui::terrain::QueryPoint> more = ui::terrain::read_points(options.points);
        points.insert(points.end(), more.begin(), more.end());
    }
    return points;
}

/// Answers from the files that a ground was made of.
std::vector<ui::terrain::QueryPointResult> query_source(const QueryOptions& options,
    const visuals::terrain::GroundSamples& ground, const std::vector<ui::terrain::QueryPoint>& points) {
    const models::heights::HeightSource source(models::heights::map_inputs(options.source), options.view.files);
    if (!source.system() || source.columns() != ground.columns() || source.rows() != ground.rows() ||
        source.spacing_m() != ground.spacing_m()) {
        throw Error(fmt::format("--source: expected the maps, with a coordinate system, that {} is made of, got others",
            options.view.terrain));
    }
    std::vector<ui::terrain::QueryPointResult> answers;
    for (const ui::terrain::QueryPoint& point : points) {
        answers.push_back({point, source.height_at(point.x_m, point.y_m)});
    }
    return answers;
}

void query(QueryOptions options) {
    if (options.from_m.has_value() != options.to_m.has_value()) {
        throw Error("expected --from X,Y,Z and --to X,Y,Z, got only one of them");
    }
    const std::vector<ui::terrain::QueryPoint> points = query_points(options);
    if (points.empty() && !options.from_m) { throw Error("expected --at, --points or --from and --to, got none"); }
    const terrain::LoadedGround ground = terrain::load_ground(options.view);
    const visuals::terrain::GroundSamples samples = ground.samples();
    ui::terrain::QueryResults answers;
    if (options.as_drawn) {
        const visuals::scene::Camera camera = ui::terrain::camera_of(options.view);
        const auto maker = ui::terrain::make_mesh_maker(ground, options.mesh);
        const visuals::terrain::MeshView view = ui::terrain::mesh_view(camera, options.view);
        ui::terrain::DrawnMesh drawn{{}, camera.eye_m, view.earth_radius_m};
        drawn.surface.set_mesh(ui::terrain::mesh_from_options(*maker, view, options.mesh), camera.eye_m);
        answers.points = ui::terrain::drawn_heights_at(drawn, points);
        if (options.from_m) { answers.sight = ui::terrain::drawn_line_of_sight(drawn, *options.from_m, *options.to_m); }
    } else {
        answers.points = options.source.empty() ? ui::terrain::ground_heights_at(samples, points)
                                                : query_source(options, samples, points);
        if (options.from_m) {
            answers.sight = ui::terrain::line_of_sight_answer(
                samples, *options.from_m, *options.to_m, options.flat ? 0.0 : ground.mean_radius_m());
        }
    }
    std::fputs(ui::terrain::query_text(answers, options.json).c_str(), stdout);
}

std::vector<Option> options_of(QueryOptions& options) {
    constexpr double far_m = 1e7;
    std::vector<Option> table;
    add_terrain_options(table, options.view);
    table.insert(table.end(),
        {list_option(
             "--at", "X,Y[,Z]", "ground height there; with Z also the height above it", Arity::OneOrMore, options.at),
            text_option("--points", "FILE", "the same for each line of a CSV file x,y[,z]", options.points),
            list_option("--source", "FILE",
                "heights of points from these maps, of which the terrain is made, between their own "
                "samples",
                Arity::OneOrMore, options.source),
            value_option({"from", "X,Y,Z", "where a line of sight begins", -far_m, far_m}, options.from_m),
            value_option({"to", "X,Y,Z", "where it ends", -far_m, far_m}, options.to_m),
            flag("--flat",
                "lines of sight over a flat earth; else it curves, R = 6371 km (on the Moon 1737 km, "
                "and so on)",
                options.flat),
            flag("--as-drawn", "ask the mesh that is drawn from --eye, not the full field", options.as_drawn)});
    add_view_options(table, options.view);
    add_mesh_options(table, options.mesh);
    add_detail_options(table, options.mesh);
    table.push_back(flag("--json", "as JSON; else CSV", options.json));
    return table;
}

} // namespace

Command terrain_query_command() {
    auto options = std::make_shared<QueryOptions>();
    return {.name = "query",
        .summary = "Height of the ground, height above it and lines of sight, at full resolution",
        .options = options_of(*options),
        .footer = "Metres, x east, y north of the map centre, z up from datum. The ground between four "
                  "samples is bilinear; the mesh's is flat triangles. How far the samples of a resampled "
                  "map lie "
                  "from it says octant terrain info; --source asks the map itself.\n"
                  "Example:\n  octant terrain query canyon --at 1200,-800\n  octant terrain query canyon "
                  "--from 0,0,900 --to 5000,3000,250 --json",
        .run = [options] { query(*options); }};
}

} // namespace octant::ui::commands
