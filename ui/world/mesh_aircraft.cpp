#include "ui/world/mesh_aircraft.h"

#include "models/measure/mesh_distance.h"
#include "models/polygons/mesh_polygons.h"
#include "sim/base/file_status.h"
#include "ui/base/stopwatch.h"
#include "ui/world/aircraft_axes.h"
#include "ui/world/library_mesh.h"
#include "ui/world/mesh_loader.h"
#include "ui/world/refine_mesh_cache.h"
#include "ui/world/refine_mesh.h"
#include "ui/world/body_axes.h"
#include "visuals/refine/active_mesh.h"
#include "visuals/refine/progressive_file.h"
#include "visuals/refine/selective_refiner.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace octant::ui::world {

namespace meshfile = models::meshfile;
namespace measure = models::measure;
namespace refine = visuals::refine;
namespace planning = visuals::planning;

namespace {

/// Few enough polygons for a painting order.
constexpr std::size_t far_faces = 250;

std::shared_ptr<const refine::ProgressiveMesh>
turned(const refine::ProgressiveMesh& mesh, const models::polygons::FileAxes& axes) {
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
        if (front.face_count() + 2 >= far_faces) {
            break;
        }
        front.split(node);
    }
    return refine::active_mesh(front).mesh;
}

models::TriangleMesh finest_mesh(const refine::ProgressiveMesh& hierarchy) {
    models::TriangleMesh mesh;
    for (std::uint32_t leaf = 0; leaf < hierarchy.leaf_count(); ++leaf) {
        mesh.vertices_m.push_back(
            hierarchy.parts().origin_m + glm::dvec3(hierarchy.position_m(leaf)));
    }
    mesh.triangles.assign(hierarchy.faces().begin(), hierarchy.faces().end());
    return mesh;
}

/// Tells where nose and top were found.
void add_note(MeshAircraft& aircraft, const AircraftAxes& axes, const std::filesystem::path& file) {
    if (std::string note = axes_note(axes, file); !note.empty()) {
        aircraft.notes.push_back(std::move(note));
    }
}

/// A hierarchy from its file, or made of a mesh; what turns or is clear beside it goes to
/// `aircraft`, in axes of the file.
RefineMesh hierarchy_in(
    const std::filesystem::path& file, const std::filesystem::path& cache, MeshAircraft& aircraft) {
    const RefineMeshOptions input{.file = file.string(), .base = 0, .quiet = true};
    if (refine::is_progressive_file(file)) {
        return read_refine_mesh(input);
    }
    const meshfile::ReadOptions options{.pictures = true, .backs = true};
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

MeshAircraft from_hierarchy(
    const std::filesystem::path& file,
    const std::string& setting,
    const std::filesystem::path& cache) {
    const base::Stopwatch watch;
    MeshAircraft aircraft;
    RefineMesh input = hierarchy_in(file, cache, aircraft);
    const AircraftAxes axes = aircraft_axes(setting, file, finest_mesh(*input.mesh));
    aircraft.notes = std::move(input.notes);
    add_note(aircraft, axes, file);
    aircraft.hierarchy = turned(*input.mesh, axes.axes);
    const models::TriangleMesh far = far_mesh(aircraft.hierarchy);
    measure::DistanceOptions loosely;
    loosely.tightness = 1.4;
    loosely.samples = 0;
    aircraft.polygons_error_m =
        measure::distance(finest_mesh(*aircraft.hierarchy), far, loosely).max_hausdorff_m();
    aircraft.polygons = models::polygons::polygons_from_mesh(far);
    for (meshfile::RotatingPart& part : aircraft.turning) {
        rotate_part_to_body(part, axes.axes);
    }
    rotate_mesh_to_body(aircraft.clear.mesh, axes.axes);
    aircraft.polygons_error_m = std::max(
        {aircraft.polygons_error_m,
         add_far_parts(aircraft.turning, aircraft.polygons),
         add_far_transparent(aircraft.clear.mesh, aircraft.polygons)});
    if (!aircraft.turning.empty()) {
        aircraft.notes.push_back(
            fmt::format("{}: {} parts turn in flight", file.string(), aircraft.turning.size()));
    }
    aircraft.notes.push_back(fmt::format(
        "{}: {} triangles made ready to be refined in {:.1f} s",
        file.string(),
        aircraft.hierarchy->face_count(),
        watch.s()));
    return aircraft;
}

/// Levels that are no better than the polygons are never drawn.
MeshAircraft from_chain(const std::filesystem::path& file, const std::string& setting) {
    meshfile::LevelChain chain = meshfile::read_chain(file);
    const AircraftAxes found = aircraft_axes(setting, file, chain.levels.front().mesh);
    const models::polygons::FileAxes& axes = found.axes;
    MeshAircraft aircraft;
    add_note(aircraft, found, file);
    aircraft.polygons = chain.polygons ? std::move(*chain.polygons)
                                       : models::polygons::polygons_from_mesh(chain.levels.back().mesh);
    aircraft.polygons_error_m =
        chain.polygons ? chain.polygons_error_m : chain.levels.back().error_m;
    for (glm::dvec3& vertex_m : aircraft.polygons.vertices_m) {
        vertex_m = axes.body_from_file(vertex_m);
    }
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

MeshAircraft read_mesh_aircraft(
    const std::filesystem::path& file,
    const std::string& axes,
    const std::filesystem::path& cache) {
    return meshfile::is_chain_file(file) ? from_chain(file, axes)
                                         : from_hierarchy(file, axes, cache);
}

void add_meshes(planning::AircraftModel& model, const MeshAircraft& aircraft) {
    if (aircraft.hierarchy) {
        planning::add_progressive(model, aircraft.hierarchy, aircraft.polygons_error_m);
        std::vector<planning::TurningPartMesh> parts;
        for (const meshfile::RotatingPart& part : aircraft.turning) {
            parts.push_back({&part.mesh, static_cast<std::uint32_t>(parts.size())});
        }
        planning::add_turning_parts(model, parts);
        if (!aircraft.clear.mesh.triangles.empty()) {
            planning::add_transparent(model, aircraft.clear.mesh, aircraft.clear.opacity);
        }
        return;
    }
    std::vector<planning::MeshSource> sources;
    for (const meshfile::ChainLevel& level : aircraft.levels) {
        sources.push_back({&level.mesh, level.error_m});
    }
    planning::add_levels(model, sources, aircraft.polygons_error_m);
}

} // namespace octant::ui::world
