#include "ui/world/mesh_aircraft.h"

#include "models/measure/mesh_distance.h"
#include "models/meshfile/mesh_file.h"
#include "models/polygons/file_axes.h"
#include "models/repair/repair.h"
#include "models/simplify/simplify.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/stopwatch.h"
#include "ui/world/mesh_loader.h"
#include "visuals/refine/active_mesh.h"
#include "visuals/refine/progressive_file.h"
#include "visuals/refine/selective_refiner.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <span>
#include <string_view>
#include <utility>

namespace octant::ui::world {

namespace fs = std::filesystem;
using models::polygons::FileAxes;
using AxesSource = AircraftAxes::AxesSource;

namespace {

constexpr std::string_view automatic = "auto";

/// Which axis of a file a direction in body axes lies along, such as "-x".
std::string axis_along(const FileAxes& axes, const glm::dvec3& in_body) {
    constexpr std::string_view letters = "xyz";
    const glm::dvec3 in_file = axes.file_from_body(in_body);
    std::string text;
    for (int k = 0; k < 3; ++k) {
        if (in_file[k] != 0.0) {
            text += in_file[k] > 0.0 ? '+' : '-';
            text += letters[static_cast<std::size_t>(k)];
        }
    }
    return text;
}

glm::dvec3 up_in_file(const FileAxes& axes) { return axes.file_from_body({0.0, 0.0, -1.0}); }

std::string_view source_of(AxesSource source) {
    switch (source) {
    case AxesSource::Given:
        return "as --axes says";
    case AxesSource::Format:
        return "as files of this format have it";
    case AxesSource::Guess:
        return "guessed from the shape";
    case AxesSource::Default:
        break;
    }
    return "taken for granted, the shape does not say";
}

} // namespace

AircraftAxes aircraft_axes(const std::string& setting, const fs::path& file, const models::TriangleMesh& mesh) {
    if (setting != automatic) { return {FileAxes::from_text(setting), AxesSource::Given}; }
    if (const auto axes = models::meshfile::axes_of_format(file)) { return {*axes, AxesSource::Format}; }
    const auto default_axes = models::meshfile::default_axes_of_format(file);
    const auto guessed = models::polygons::guess_axes(mesh);
    if (guessed && (!default_axes || up_in_file(*guessed) == up_in_file(*default_axes))) {
        return {*guessed, AxesSource::Guess};
    }
    return {default_axes.value_or(FileAxes()), AxesSource::Default};
}

void check_axes(const std::string& setting) {
    if (setting != automatic) { FileAxes::from_text(setting); }
}

std::string axes_text(const AircraftAxes& axes) {
    return fmt::format("nose towards {}, up {}: {}", axis_along(axes.axes, {1.0, 0.0, 0.0}),
        axis_along(axes.axes, {0.0, 0.0, -1.0}), source_of(axes.source));
}

void note_axes(const AircraftAxes& axes, const fs::path& file, std::vector<std::string>& notes) {
    if (axes.source == AxesSource::Guess || axes.source == AxesSource::Default) {
        notes.push_back(fmt::format("{}: {}; --axes to change", file.filename().string(), axes_text(axes)));
    }
}

namespace fs = std::filesystem;
namespace measure = models::measure;
namespace meshfile = models::meshfile;
namespace planning = visuals::planning;
namespace refine = visuals::refine;
using models::meshfile::RotatingPart;
using models::polygons::Polygon;
using models::polygons::PolygonModel;

namespace {

/// Triangles far away of all turning parts together, and at least of each.
constexpr std::size_t far_faces_of_parts = 120;
constexpr std::size_t min_far_faces = 12;
constexpr std::size_t far_faces_of_transparent = 60;

void append(PolygonModel& to, const PolygonModel& from, std::uint32_t part) {
    const auto first_vertex = static_cast<std::uint32_t>(to.vertices_m.size());
    const auto first_corner = static_cast<std::uint32_t>(to.corner_vertices.size());
    const auto first_material = static_cast<std::uint32_t>(to.materials.size());
    to.vertices_m.insert(to.vertices_m.end(), from.vertices_m.begin(), from.vertices_m.end());
    to.materials.insert(to.materials.end(), from.materials.begin(), from.materials.end());
    for (const std::uint32_t vertex : from.corner_vertices) { to.corner_vertices.push_back(first_vertex + vertex); }
    for (Polygon polygon : from.polygons) {
        polygon.first_corner += first_corner;
        polygon.material += first_material;
        polygon.part = part;
        to.polygons.push_back(polygon);
    }
}

/// The certified distance of two meshes, found quickly.
double max_distance_m(const models::TriangleMesh& a, const models::TriangleMesh& b) {
    measure::DistanceOptions options;
    options.tightness = 1.4;
    options.samples = 0;
    return measure::distance(a, b, options).max_hausdorff_m();
}

/// Adds a mesh to a part, simplified to so many triangles. Returns their certified distance.
double append_far(const models::TriangleMesh& mesh, std::size_t faces, std::uint32_t part, PolygonModel& to) {
    const models::TriangleMesh whole = models::repair::repaired(mesh).mesh;
    if (whole.triangles.empty()) { return 0.0; }
    models::simplify::SimplifyOptions options;
    options.goal.faces = faces;
    const models::TriangleMesh far = models::simplify::simplified(whole, options).mesh;
    append(to, models::polygons::polygons_from_mesh(far), part);
    return max_distance_m(whole, far);
}

/// Turns a mesh from its file's axes into body axes: a rotation, so that no triangle turns over.
void rotate_mesh_to_body(models::TriangleMesh& mesh, const models::polygons::FileAxes& axes) {
    for (glm::dvec3& vertex_m : mesh.vertices_m) { vertex_m = axes.body_from_file(vertex_m); }
    for (glm::vec3& normal : mesh.normals) { normal = glm::vec3(axes.body_from_file(glm::dvec3(normal))); }
}

/// Adds parts that turn to the polygons that stand in for an aircraft far away: a pivot for each, in their order, and
/// as few triangles as a part far away needs. Body axes. Returns the largest certified distance, in metres, between a
/// part and its polygons.
double add_far_parts(std::span<const RotatingPart> parts, PolygonModel& polygons) {
    double error_m = 0.0;
    for (const RotatingPart& part : parts) {
        const auto number = static_cast<std::uint32_t>(polygons.parts.size());
        polygons.parts.push_back(fmt::format("turning-{}", number));
        polygons.pivots.push_back({number, part.about.point_m, part.about.direction, part.about.turns_per_s});
        const std::size_t faces = std::max(min_far_faces, far_faces_of_parts / parts.size());
        error_m = std::max(error_m, append_far(part.mesh, faces, number, polygons));
    }
    return error_m;
}

/// Few enough polygons for a painting order.
constexpr std::size_t far_faces = 250;

std::shared_ptr<const refine::ProgressiveMesh> turned(
    const refine::ProgressiveMesh& mesh, const models::polygons::FileAxes& axes) {
    refine::ProgressiveMeshData parts = mesh.full_data();
    parts.origin_m = axes.body_from_file(parts.origin_m);
    for (glm::vec3& position_m : parts.positions_m) {
        position_m = glm::vec3(axes.body_from_file(glm::dvec3(position_m)));
    }
    for (refine::PackedNormal& normal : parts.normals) {
        normal = refine::packed(glm::vec3(axes.body_from_file(glm::dvec3(unpacked(normal)))));
    }
    return std::make_shared<const refine::ProgressiveMesh>(std::move(parts));
}

/// The hierarchy's mesh after as many of its coarsest splits as far polygons allow.
models::TriangleMesh far_mesh(const std::shared_ptr<const refine::ProgressiveMesh>& hierarchy) {
    refine::SelectiveRefiner front(hierarchy);
    for (const std::uint32_t node : hierarchy->coarsest_first()) {
        if (front.face_count() + 2 >= far_faces) { break; }
        front.split(node);
    }
    return refine::active_mesh(front).mesh;
}

models::TriangleMesh finest_mesh(const refine::ProgressiveMesh& hierarchy) {
    models::TriangleMesh mesh;
    for (std::uint32_t leaf = 0; leaf < hierarchy.leaf_count(); ++leaf) {
        mesh.vertices_m.push_back(hierarchy.parts().origin_m + glm::dvec3(hierarchy.position_m(leaf)));
    }
    mesh.triangles.assign(hierarchy.faces().begin(), hierarchy.faces().end());
    return mesh;
}

/// A hierarchy from its file, or made of a mesh. Turning parts and transparent surfaces go to `aircraft`. All in axes
/// of the file.
RefineMesh hierarchy_in(const fs::path& file, const fs::path& cache, std::shared_ptr<meshfile::TextureStore> textures,
    MeshAircraft& aircraft) {
    const RefineMeshOptions input{.file = file.string(), .base = 0, .quiet = true};
    if (refine::is_progressive_file(file)) { return read_refine_mesh(input); }
    const meshfile::ReadOptions options{.pictures = true, .textures = std::move(textures), .backs = true};
    meshfile::RotatingModel model;
    if (path_exists(file) && !is_library_file(file) && meshfile::is_mesh_file(file)) {
        model = meshfile::read_rotating_model(file, options);
        aircraft.turning = std::move(model.parts);
        aircraft.clear = std::move(model.clear);
    } else {
        model.body = load_mesh(input.file, options);
    }
    return cache.empty() ? make_refine_mesh(input, std::move(model.body))
                         : cached_refine_mesh(cache, input, std::move(model.body));
}

MeshAircraft from_hierarchy(const fs::path& file, const std::string& setting, const fs::path& cache,
    std::shared_ptr<meshfile::TextureStore> textures) {
    const Stopwatch watch;
    MeshAircraft aircraft;
    RefineMesh input = hierarchy_in(file, cache, std::move(textures), aircraft);
    const AircraftAxes axes = aircraft_axes(setting, file, finest_mesh(*input.mesh));
    aircraft.notes = std::move(input.notes);
    note_axes(axes, file, aircraft.notes);
    aircraft.hierarchy = turned(*input.mesh, axes.axes); // its nodes keep their numbers
    aircraft.textures = std::move(input.textures);
    const models::TriangleMesh far = far_mesh(aircraft.hierarchy);
    aircraft.polygons_error_m = max_distance_m(finest_mesh(*aircraft.hierarchy), far);
    aircraft.polygons = models::polygons::polygons_from_mesh(far);
    for (RotatingPart& part : aircraft.turning) {
        rotate_mesh_to_body(part.mesh, axes.axes);
        part.about.point_m = axes.axes.body_from_file(part.about.point_m);
        part.about.direction = axes.axes.body_from_file(part.about.direction);
    }
    rotate_mesh_to_body(aircraft.clear.mesh, axes.axes);
    // Transparent surfaces are opaque there: far away nothing is seen through them.
    aircraft.polygons_error_m = std::max({aircraft.polygons_error_m, add_far_parts(aircraft.turning, aircraft.polygons),
        append_far(aircraft.clear.mesh, far_faces_of_transparent, 0, aircraft.polygons)});
    if (!aircraft.turning.empty()) {
        aircraft.notes.push_back(fmt::format("{}: {} parts turn in flight", file.string(), aircraft.turning.size()));
    }
    aircraft.notes.push_back(fmt::format("{}: {} triangles made ready to be refined in {:.1f} s", file.string(),
        aircraft.hierarchy->face_count(), watch.s()));
    return aircraft;
}

/// Decodes the pictures that a chain holds.
void take_textures(meshfile::LevelChain& chain, meshfile::TextureStore& textures, std::vector<std::string>& notes) {
    for (meshfile::ChainLevel& level : chain.levels) {
        for (models::Material& material : level.mesh.materials) {
            if (!material.picture_bytes) { continue; }
            try {
                material.texture.picture = textures.picture_of(material.picture, *material.picture_bytes);
                material.texture.alpha =
                    material.texture.picture->is_opaque ? models::TextureAlpha::Opaque : models::TextureAlpha::Mask;
            } catch (const Error& fault) {
                const std::string note = fmt::format("{}; its surfaces have their material's colour", fault.what());
                if (std::ranges::find(notes, note) == notes.end()) { notes.push_back(note); }
            }
        }
    }
}

/// Levels with an error above that of the polygons are left out.
MeshAircraft from_chain(
    const fs::path& file, const std::string& setting, const std::shared_ptr<meshfile::TextureStore>& textures) {
    meshfile::LevelChain chain = meshfile::read_chain(file);
    const AircraftAxes found = aircraft_axes(setting, file, chain.levels.front().mesh);
    const models::polygons::FileAxes& axes = found.axes;
    MeshAircraft aircraft;
    note_axes(found, file, aircraft.notes);
    if (textures) { take_textures(chain, *textures, aircraft.notes); }
    aircraft.polygons =
        chain.polygons ? std::move(*chain.polygons) : models::polygons::polygons_from_mesh(chain.levels.back().mesh);
    aircraft.polygons_error_m = chain.polygons ? chain.polygons_error_m : chain.levels.back().error_m;
    for (glm::dvec3& vertex_m : aircraft.polygons.vertices_m) { vertex_m = axes.body_from_file(vertex_m); }
    for (models::polygons::Pivot& pivot : aircraft.polygons.pivots) {
        pivot.point_m = axes.body_from_file(pivot.point_m);
        pivot.axis = axes.body_from_file(pivot.axis);
    }
    for (meshfile::ChainLevel& level : chain.levels) {
        if (level.error_m < aircraft.polygons_error_m) {
            rotate_mesh_to_body(level.mesh, axes);
            aircraft.levels.push_back(std::move(level));
        }
    }
    return aircraft;
}

} // namespace

MeshAircraft read_mesh_aircraft(const fs::path& file, const std::string& axes, const fs::path& cache,
    std::shared_ptr<meshfile::TextureStore> textures) {
    return meshfile::is_chain_file(file) ? from_chain(file, axes, textures)
                                         : from_hierarchy(file, axes, cache, std::move(textures));
}

void add_meshes(planning::AircraftModel& model, const MeshAircraft& aircraft) {
    if (aircraft.hierarchy) {
        planning::add_progressive(model, aircraft.hierarchy, aircraft.polygons_error_m, aircraft.textures);
        std::vector<planning::TurningPartMesh> parts;
        for (const RotatingPart& part : aircraft.turning) {
            parts.push_back({&part.mesh, static_cast<std::uint32_t>(parts.size())});
        }
        planning::add_turning_parts(model, parts);
        if (!aircraft.clear.mesh.triangles.empty()) {
            planning::add_transparent(model, aircraft.clear.mesh, aircraft.clear.opacity);
        }
        return;
    }
    std::vector<planning::MeshSource> sources;
    for (const meshfile::ChainLevel& level : aircraft.levels) { sources.push_back({&level.mesh, level.error_m}); }
    planning::add_levels(model, sources, aircraft.polygons_error_m);
}

} // namespace octant::ui::world
