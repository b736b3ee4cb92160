#include "ui/world/mesh_aircraft.h"

#include "models/measure/mesh_distance.h"
#include "models/meshfile/mesh_file.h"
#include "models/repair/repair.h"
#include "models/simplify/simplify.h"
#include "models/smooth_normals.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/stopwatch.h"
#include "ui/world/aircraft_frame.h"
#include "ui/world/mesh_loader.h"
#include "visuals/refine/active_mesh.h"
#include "visuals/refine/progressive_file.h"
#include "visuals/refine/selective_refiner.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <span>
#include <string_view>
#include <utility>

namespace octant::ui::world {

namespace fs = std::filesystem;
namespace measure = models::measure;
namespace meshfile = models::meshfile;
namespace planning = visuals::planning;
namespace refine = visuals::refine;
using models::meshfile::RotatingPart;
using models::polygons::PolygonModel;

namespace {

/// Triangles far away of all turning parts together, and at least of each.
constexpr std::size_t far_faces_of_parts = 120;
constexpr std::size_t min_far_faces = 12;
constexpr std::size_t far_faces_of_transparent = 60;

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
    models::polygons::append_polygons(to, models::polygons::polygons_from_mesh(far), part);
    return max_distance_m(whole, far);
}

/// Turns a mesh from its file's axes into body axes: a rotation, so that no triangle turns over.
void rotate_mesh_to_body(models::TriangleMesh& mesh, const models::polygons::FileAxes& axes) {
    for (glm::dvec3& vertex_m : mesh.vertices_m) { vertex_m = axes.body_from_file(vertex_m); }
    for (glm::vec3& normal : mesh.normals) { normal = glm::vec3(axes.body_from_file(glm::dvec3(normal))); }
}

bool turns_by_time(const RotatingPart& part) { return part.about.turns_per_s != 0.0; }

/// Adds parts that turn to the polygons that stand in for an aircraft far away: a pivot for each, in their order, and
/// as few triangles as a part far away needs. Parts that only controls move stand there as at rest. Body axes. Returns
/// the largest certified distance, in metres, between a part at rest and its polygons.
double add_far_parts(std::span<const RotatingPart> parts, PolygonModel& polygons) {
    models::TriangleMesh at_rest;
    const auto turning = static_cast<std::size_t>(std::ranges::count_if(parts, &turns_by_time));
    double error_m = 0.0;
    for (const RotatingPart& part : parts) {
        if (!turns_by_time(part)) {
            if (models::is_shown_at_rest(part.moves)) { meshfile::join_mesh(at_rest, part.mesh, {}); }
            continue;
        }
        const auto number = static_cast<std::uint32_t>(polygons.parts.size());
        polygons.parts.push_back(fmt::format("turning-{}", number));
        polygons.pivots.push_back({number, part.about.point_m, part.about.direction, part.about.turns_per_s});
        const std::size_t faces = std::max(min_far_faces, far_faces_of_parts / turning);
        error_m = std::max(error_m, append_far(part.mesh, faces, number, polygons));
    }
    if (!at_rest.triangles.empty()) {
        error_m = std::max(error_m, append_far(at_rest, far_faces_of_parts, 0, polygons));
    }
    return error_m;
}

/// Few enough polygons for a painting order.
constexpr std::size_t far_faces = 250;

refine::PackedNormal turned_normal(const refine::PackedNormal& normal, const models::polygons::FileAxes& axes) {
    return refine::packed(glm::vec3(axes.body_from_file(glm::dvec3(unpacked(normal)))));
}

/// In body axes about an origin, and as large as `scale` makes it.
std::shared_ptr<const refine::ProgressiveMesh> turned(const refine::ProgressiveMesh& mesh,
    const models::polygons::FileAxes& axes, const glm::dvec3& origin, double scale) {
    refine::ProgressiveMeshData parts = mesh.full_data();
    parts.origin_m -= origin;
    if (scale != 1.0) {
        parts.origin_m *= scale;
        for (glm::vec3& position_m : parts.positions_m) { position_m *= static_cast<float>(scale); }
        for (refine::VertexSplit& split : parts.splits) { split.error_m *= static_cast<float>(scale); }
    }
    parts.origin_m = axes.body_from_file(parts.origin_m);
    for (glm::vec3& position_m : parts.positions_m) {
        position_m = glm::vec3(axes.body_from_file(glm::dvec3(position_m)));
    }
    for (refine::PackedNormal& normal : parts.normals) { normal = turned_normal(normal, axes); }
    return std::make_shared<const refine::ProgressiveMesh>(std::move(parts));
}

/// Normals at creases, in body axes.
std::shared_ptr<const refine::MeshCreases> turned(
    const std::shared_ptr<const refine::MeshCreases>& creases, const models::polygons::FileAxes& axes) {
    if (!creases) { return nullptr; }
    refine::MeshCreases turned = *creases;
    for (refine::CornerNormals& normals : turned.corner_normals) {
        for (refine::PackedNormal& normal : normals) { normal = turned_normal(normal, axes); }
    }
    return std::make_shared<const refine::MeshCreases>(std::move(turned));
}

/// Gives a mesh without normals those of a surface that is smooth but for edges sharper than the crease angle.
void add_missing_normals(models::TriangleMesh& mesh) {
    if (!mesh.corner_normals.empty()) { return; }
    mesh.corner_normals.assign(
        mesh.triangles.size(), {models::invalid_index, models::invalid_index, models::invalid_index});
    constexpr models::Smoothing smooth{models::Smoothing::flat + 1, static_cast<float>(models::default_crease_rad)};
    models::add_smooth_normals(mesh, std::vector(mesh.triangles.size(), smooth));
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

/// All of a model as one mesh, for its axes and its size.
models::TriangleMesh whole_of(const meshfile::RotatingModel& model) {
    models::TriangleMesh whole = model.body;
    for (const RotatingPart& part : model.parts) {
        if (models::is_shown_at_rest(part.moves)) { meshfile::join_mesh(whole, part.mesh, {}); }
    }
    meshfile::join_mesh(whole, model.clear, {});
    return whole;
}

/// The triangles of a mesh as polygons, with their materials, normals and texture coordinates. Colours of vertices
/// become one of each triangle.
PolygonModel glass_of(const models::TriangleMesh& mesh) {
    if (mesh.triangles.empty()) { return {}; }
    models::TriangleMesh plain = mesh;
    if (plain.materials.empty()) {
        plain.materials.push_back({.name = "glass"});
        plain.triangle_materials.assign(plain.triangles.size(), 0);
    }
    PolygonModel glass;
    glass.vertices_m = plain.vertices_m;
    glass.materials = plain.materials;
    glass.parts = {"glass"};
    std::map<std::array<int, 4>, std::uint32_t> coloured; // by material and colour in steps
    for (std::size_t t = 0; t < plain.triangles.size(); ++t) {
        std::uint32_t material = plain.triangle_materials[t];
        if (!plain.colours.empty() && plain.materials[material].texture.picture == nullptr) {
            const glm::vec3 colour = models::mean_colour(plain, t);
            const glm::ivec3 step(colour * 31.0F + 0.5F);
            const auto [at, is_new] = coloured.try_emplace({static_cast<int>(material), step.x, step.y, step.z},
                static_cast<std::uint32_t>(glass.materials.size()));
            if (is_new) {
                glass.materials.push_back(plain.materials[material]);
                glass.materials.back().colour = colour;
            }
            material = at->second;
        }
        glass.polygons.push_back({static_cast<std::uint32_t>(glass.corner_vertices.size()), 3, material, 0});
        for (std::size_t k = 0; k < 3; ++k) {
            glass.corner_vertices.push_back(plain.triangles[t][k]);
            if (!plain.normals.empty()) { glass.corner_normals.push_back(plain.normals[plain.corner_normals[t][k]]); }
            if (plain.texture_coordinates.empty()) { continue; }
            const std::uint32_t place = plain.corner_texture_coordinates[t][k];
            constexpr float none = std::numeric_limits<float>::quiet_NaN();
            glass.corner_texture_coordinates.push_back(
                place == models::invalid_index ? glm::vec2(none) : plain.texture_coordinates[place]);
        }
    }
    return glass;
}

/// What is flown of a mesh's file, in axes and unit of the file.
struct FileHierarchy {
    RefineMesh mesh;
    models::TriangleMesh clear; ///< transparent surfaces
    AircraftAxes axes;
    models::BoundingBox bounds;
};

/// A hierarchy from its file, or made of a mesh. Turning parts go to `turning`.
FileHierarchy hierarchy_in(const fs::path& file, const AircraftFrameSettings& frame, const fs::path& cache,
    std::shared_ptr<meshfile::TextureStore> textures, std::vector<RotatingPart>& turning) {
    const RefineMeshOptions input{.file = file.string(), .base = 0, .quiet = true};
    FileHierarchy result;
    if (refine::is_progressive_file(file)) {
        result.mesh = read_refine_mesh(input);
        models::TriangleMesh whole = refine::finest_mesh(*result.mesh.mesh);
        result.axes = aircraft_axes(frame.axes, file, whole);
        result.bounds = models::bounds_of(whole);
        result.clear = meshfile::take_transparent(whole);
        return result;
    }
    const meshfile::ReadOptions options{.pictures = true, .textures = std::move(textures), .backs = true};
    meshfile::RotatingModel model = load_rotating_model(input.file, options);
    const models::TriangleMesh whole = whole_of(model);
    result.axes = aircraft_axes(frame.axes, file, whole);
    result.bounds = models::bounds_of(whole);
    turning = std::move(model.parts);
    result.clear = std::move(model.clear);
    add_missing_normals(model.body);
    result.mesh = cache.empty() ? make_refine_mesh(input, std::move(model.body))
                                : cached_refine_mesh(cache, input, std::move(model.body));
    return result;
}

void note_frame(const AircraftAxes& axes, const models::BoundingBox& bounds, double scale, const fs::path& file,
    std::vector<std::string>& notes) {
    for (const auto& note : {axes_note(axes, file), size_note((bounds.max_m - bounds.min_m) * scale, scale, file)}) {
        if (note) { notes.push_back(*note); }
    }
}

void note_moving_parts(MeshAircraft& aircraft, const fs::path& file) {
    const auto turning = std::ranges::count_if(aircraft.turning, &turns_by_time);
    const auto moving =
        std::ranges::count_if(aircraft.turning, [](const RotatingPart& part) { return !part.moves.empty(); });
    if (turning > 0) { aircraft.notes.push_back(fmt::format("{}: {} parts turn in flight", file.string(), turning)); }
    if (moving > 0) {
        aircraft.notes.push_back(
            fmt::format("{}: {} parts move as the motion has it: surfaces, flaps, gear", file.string(), moving));
    }
}

MeshAircraft from_hierarchy(const fs::path& file, const AircraftFrameSettings& frame, const fs::path& cache,
    std::shared_ptr<meshfile::TextureStore> textures) {
    const Stopwatch watch;
    MeshAircraft aircraft;
    FileHierarchy input = hierarchy_in(file, frame, cache, std::move(textures), aircraft.turning);
    const models::polygons::FileAxes& axes = input.axes.axes;
    aircraft.notes = std::move(input.mesh.notes);
    note_frame(input.axes, input.bounds, frame.scale, file, aircraft.notes);
    const glm::dvec3 origin = flown_origin(file, input.bounds);
    if (const auto note = origin_note(origin, file)) { aircraft.notes.push_back(*note); }
    aircraft.hierarchy = turned(*input.mesh.mesh, axes, origin, frame.scale); // its nodes keep their numbers
    aircraft.creases = turned(input.mesh.creases, axes);
    aircraft.textures = std::move(input.mesh.textures);
    models::TriangleMesh far = far_mesh(aircraft.hierarchy);
    models::TriangleMesh finest = refine::finest_mesh(*aircraft.hierarchy);
    for (models::TriangleMesh* mesh : {&far, &finest}) { meshfile::take_transparent(*mesh); } // glass is apart
    for (models::Material& material : far.materials) { material.opacity = 1.0F; }
    aircraft.polygons_error_m = max_distance_m(finest, far);
    aircraft.polygons = models::polygons::polygons_from_mesh(far);
    for (RotatingPart& part : aircraft.turning) {
        move_mesh(part.mesh, origin, frame.scale);
        rotate_mesh_to_body(part.mesh, axes);
        part.about.point_m = frame.scale * axes.body_from_file(part.about.point_m - origin);
        part.about.direction = axes.body_from_file(part.about.direction);
        for (models::PartMove& move : part.moves) {
            move.point_m = frame.scale * axes.body_from_file(move.point_m - origin);
            move.direction = axes.body_from_file(move.direction);
            for (glm::dvec2& amount : move.amounts) {
                amount.y *= move.kind == models::PartMove::Kind::Shift ? frame.scale : 1.0;
            }
        }
    }
    move_mesh(input.clear, origin, frame.scale);
    rotate_mesh_to_body(input.clear, axes);
    aircraft.polygons_error_m = std::max({aircraft.polygons_error_m, add_far_parts(aircraft.turning, aircraft.polygons),
        append_far(input.clear, far_faces_of_transparent, 0, aircraft.polygons)});
    aircraft.glass = glass_of(input.clear);
    note_moving_parts(aircraft, file);
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
                models::set_picture(material, textures.picture_of(material.picture, *material.picture_bytes));
            } catch (const Error& fault) {
                const std::string note = fmt::format("{}; its surfaces have their material's colour", fault.what());
                if (std::ranges::find(notes, note) == notes.end()) { notes.push_back(note); }
            }
        }
    }
}

/// Levels with an error above that of the polygons are left out.
MeshAircraft from_chain(
    const fs::path& file, const AircraftFrameSettings& frame, const std::shared_ptr<meshfile::TextureStore>& textures) {
    meshfile::LevelChain chain = meshfile::read_chain(file);
    const AircraftAxes found = aircraft_axes(frame.axes, file, chain.levels.front().mesh);
    const models::polygons::FileAxes& axes = found.axes;
    MeshAircraft aircraft;
    note_frame(found, models::bounds_of(chain.levels.front().mesh), frame.scale, file, aircraft.notes);
    if (textures) { take_textures(chain, *textures, aircraft.notes); }
    aircraft.polygons =
        chain.polygons ? std::move(*chain.polygons) : models::polygons::polygons_from_mesh(chain.levels.back().mesh);
    aircraft.polygons_error_m = frame.scale * (chain.polygons ? chain.polygons_error_m : chain.levels.back().error_m);
    for (glm::dvec3& vertex_m : aircraft.polygons.vertices_m) {
        vertex_m = frame.scale * axes.body_from_file(vertex_m);
    }
    for (models::polygons::Pivot& pivot : aircraft.polygons.pivots) {
        pivot.point_m = frame.scale * axes.body_from_file(pivot.point_m);
        pivot.axis = axes.body_from_file(pivot.axis);
    }
    for (meshfile::ChainLevel& level : chain.levels) {
        const bool is_finest = &level == &chain.levels.front();
        level.error_m *= frame.scale;
        if (level.error_m >= aircraft.polygons_error_m && !is_finest) { continue; }
        scale_mesh(level.mesh, frame.scale);
        rotate_mesh_to_body(level.mesh, axes);
        const models::TriangleMesh clear = meshfile::take_transparent(level.mesh);
        if (is_finest) { aircraft.glass = glass_of(clear); }
        if (level.error_m < aircraft.polygons_error_m) { aircraft.levels.push_back(std::move(level)); }
    }
    return aircraft;
}

} // namespace

MeshAircraft read_mesh_aircraft(const fs::path& file, const AircraftFrameSettings& frame, const fs::path& cache,
    std::shared_ptr<meshfile::TextureStore> textures) {
    return meshfile::is_chain_file(file) ? from_chain(file, frame, textures)
                                         : from_hierarchy(file, frame, cache, std::move(textures));
}

void add_meshes(planning::AircraftModel& model, const MeshAircraft& aircraft) {
    if (aircraft.hierarchy) {
        planning::add_progressive(model, aircraft.hierarchy, aircraft.polygons_error_m, aircraft.textures);
        model.creases = aircraft.creases;
        std::vector<planning::MovingPartMesh> parts;
        std::uint32_t pivots = 0;
        for (const RotatingPart& part : aircraft.turning) {
            parts.push_back({&part.mesh, turns_by_time(part) ? std::optional(pivots++) : std::nullopt, part.moves});
        }
        planning::add_moving_parts(model, parts);
        return;
    }
    std::vector<planning::MeshSource> sources;
    for (const meshfile::ChainLevel& level : aircraft.levels) { sources.push_back({&level.mesh, level.error_m}); }
    planning::add_levels(model, sources, aircraft.polygons_error_m);
}

} // namespace octant::ui::world
