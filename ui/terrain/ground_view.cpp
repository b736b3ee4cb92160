#include "ui/terrain/ground_view.h"

#include "sim/base/column_reader.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"
#include "ui/base/progress.h"
#include "ui/settings/settings_check.h"
#include "ui/world/scene_ground.h"
#include "visuals/groundfile/ground_file.h"
#include "visuals/terrain/bisection_ground_builder.h"
#include "visuals/terrain/ground_query.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace octant::ui::terrain {

namespace scene = visuals::scene;
namespace terrain = visuals::terrain;

namespace {

/// The lens for which the paper's C is meant.
constexpr double reference_fov_rad = rad_from_deg(45.0);

double aspect_of(const glm::ivec2& size_px) { return static_cast<double>(size_px.x) / size_px.y; }

} // namespace

scene::Camera camera_of(const GroundViewOptions& options) {
    if (!options.eye_m || !options.look_m) { throw Error("expected --eye X,Y,Z and --look X,Y,Z, got not both"); }
    if (*options.eye_m == *options.look_m) { throw Error("--look: expected another point than --eye, got the same"); }
    scene::Camera camera = scene::camera_looking_at(*options.eye_m, *options.look_m);
    camera.vertical_fov_rad = rad_from_deg(options.fov_deg);
    return camera;
}

terrain::MeshView mesh_view(const scene::Camera& camera, const GroundViewOptions& options) {
    terrain::MeshView view;
    view.eye_m = camera.eye_m;
    view.frustum_normals = scene::frustum_normals(camera, aspect_of(options.size_px));
    view.magnification = std::max(1.0, std::tan(reference_fov_rad / 2.0) / std::tan(camera.vertical_fov_rad / 2.0));
    view.focal_px = scene::focal_px(camera, options.size_px.y);
    view.ahead = scene::view_direction(camera);
    view.corner_cos = scene::corner_cos(camera, aspect_of(options.size_px));
    view.earth_radius_m = options.earth_radius_m;
    return view;
}

terrain::PerspectiveView picture_view(const scene::Camera& camera, const glm::ivec2& size_px) {
    terrain::PerspectiveView view;
    view.eye_m = camera.eye_m;
    view.right = camera.view_to_world * glm::dvec3(1.0, 0.0, 0.0);
    view.up = camera.view_to_world * glm::dvec3(0.0, 1.0, 0.0);
    view.ahead = camera.view_to_world * glm::dvec3(0.0, 0.0, -1.0);
    view.focal_px = scene::focal_px(camera, size_px.y);
    view.half_width_px = size_px.x / 2.0;
    view.half_height_px = size_px.y / 2.0;
    return view;
}

terrain::GroundSamples LoadedGround::samples() const {
    return std::visit([](const auto& ground) { return terrain::GroundSamples(ground); }, ground_);
}

double LoadedGround::mean_radius_m() const {
    const models::heights::HeightField* const read = field();
    return ellipsoid_below(read != nullptr ? read->place : std::get<terrain::GroundTiles>(ground_).metadata().place)
        .mean_radius_m();
}

terrain::GroundTiles LoadedGround::tiles() const {
    const models::heights::HeightField* const read = field();
    return read != nullptr ? terrain::make_ground_tiles(*read) : std::get<terrain::GroundTiles>(ground_);
}

LoadedGround load_ground(const std::string& name_or_file, const models::heights::ImportOptions& options, bool quiet) {
    if (settings::is_imported_ground(name_or_file)) {
        return LoadedGround(visuals::groundfile::open_ground(name_or_file));
    }
    models::heights::HeightField field = world::load_height_field(name_or_file, options);
    for (const models::heights::MapNote& note : field.notes) { base::print_note(quiet, note.text); }
    return LoadedGround(std::move(field));
}

LoadedGround load_ground(GroundViewOptions& options, bool quiet) {
    LoadedGround ground = load_ground(options.terrain, options.files, quiet);
    options.earth_radius_m = options.curved ? ground.mean_radius_m() : 0.0;
    if (options.eye_m) {
        const auto low = world::low_eye_note(
            *options.eye_m, terrain::ground_height_m(ground.samples(), options.eye_m->x, options.eye_m->y));
        base::print_note(quiet || !low, low.value_or(""));
    }
    return ground;
}

std::vector<EyePoint> read_eye_points(const std::filesystem::path& file, const std::string& map) {
    ColumnReader table(TextScanner::of_file(file), ',');
    std::vector<EyePoint> points;
    while (table.next_row()) {
        const auto& fields = table.fields();
        if (fields.front() != map) { continue; }
        std::array<double, 5> numbers{};
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            const auto number = fields.size() == 6 ? finite_number(fields[k + 1]) : std::nullopt;
            if (!number) { table.refuse("map,x_m,y_m,agl_m,heading_deg,pitch_deg", in_quotes(table.row())); }
            numbers[k] = *number;
        }
        points.push_back({table.line_number(), numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]});
    }
    if (points.empty()) { throw_error_in(file, fmt::format("expected rows of map '{}', got none", printable(map))); }
    return points;
}

scene::Camera camera_at(const EyePoint& point, const visuals::terrain::GroundSamples& ground, double fov_deg) {
    const auto ground_m = visuals::terrain::ground_height_m(ground, point.x_m, point.y_m);
    if (!ground_m) {
        throw Error(fmt::format(
            "eye points, line {}: expected a place on the map, got {},{}", point.line, point.x_m, point.y_m));
    }
    const double heading_rad = rad_from_deg(point.heading_deg);
    const double pitch_rad = rad_from_deg(point.pitch_deg);
    const glm::dvec3 eye_m(point.x_m, point.y_m, *ground_m + point.agl_m);
    const glm::dvec3 ahead(
        std::sin(heading_rad) * std::cos(pitch_rad), std::cos(heading_rad) * std::cos(pitch_rad), std::sin(pitch_rad));
    scene::Camera camera = scene::camera_looking_at(eye_m, eye_m + ahead);
    camera.vertical_fov_rad = rad_from_deg(fov_deg);
    return camera;
}

} // namespace octant::ui::terrain
