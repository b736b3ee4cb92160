#include "ui/world/aircraft_loader.h"

#include "models/measure/mesh_distance.h"
#include "models/meshfile/mesh_file.h"
#include "models/polygons/file_axes.h"
#include "models/polygons/obj_reader.h"
#include "models/polygons/polygon_model.h"
#include "models/repair/repair.h"
#include "models/simplify/simplify.h"
#include "sim/aircraft_kind.h"
#include "sim/base/binary_file.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/stopwatch.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"
#include "ui/base/data_files.h"
#include "ui/settings/settings.h"
#include "ui/world/input_files.h"
#include "ui/world/mesh_loader.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/ordercache/order_cache.h"
#include "visuals/planning/aircraft_model.h"
#include "visuals/refine/active_mesh.h"
#include "visuals/refine/progressive_file.h"
#include "visuals/refine/selective_refiner.h"
#include "visuals/shading/vertex_normals.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace octant::ui::world {

namespace draworder = visuals::draworder;
namespace fs = std::filesystem;
namespace measure = models::measure;
namespace meshfile = models::meshfile;
namespace ordercache = visuals::ordercache;
namespace planning = visuals::planning;
namespace refine = visuals::refine;
namespace scene = visuals::scene;
namespace shading = visuals::shading;
using models::meshfile::RotatingPart;
using models::polygons::FileAxes;
using models::polygons::Polygon;
using models::polygons::PolygonModel;
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

namespace {

/// Tells where nose and top were found, unless the setting or the format says it.
void note_axes(const AircraftAxes& axes, const fs::path& file, std::vector<std::string>& notes) {
    if (axes.source == AxesSource::Guess || axes.source == AxesSource::Default) {
        notes.push_back(fmt::format("{}: {}; --axes to change", file.filename().string(), axes_text(axes)));
    }
}

/// Raised whenever make_refine_mesh() gives any mesh another hierarchy, or its file another layout: what was cached
/// before is then made anew.
constexpr unsigned refine_mesh_cache_version = 4;

template <class Item>
void add_list(Hash& hash, const std::vector<Item>& list) {
    hash.add_word(list.size());
    hash.add(std::as_bytes(std::span(list)));
}

/// Another number for each seed.
std::uint64_t hash_of(const models::TriangleMesh& mesh, std::uint64_t seed) {
    Hash hash;
    hash.add_word(seed);
    hash.add_word(refine_mesh_cache_version);
    add_list(hash, mesh.vertices_m);
    add_list(hash, mesh.colours);
    add_list(hash, mesh.triangles);
    add_list(hash, mesh.normals);
    add_list(hash, mesh.corner_normals);
    add_list(hash, mesh.triangle_materials);
    for (const models::Material& material : mesh.materials) { hash.add(std::as_bytes(std::span(&material.colour, 1))); }
    return hash.value();
}

} // namespace

fs::path refine_mesh_cache_file(const fs::path& folder, const models::TriangleMesh& mesh) {
    return folder / fmt::format("{:016x}{:016x}.mesh", hash_of(mesh, 1), hash_of(mesh, 2));
}

RefineMesh cached_refine_mesh(const fs::path& folder, const RefineMeshOptions& input, models::TriangleMesh mesh) {
    const fs::path file = refine_mesh_cache_file(folder, mesh);
    const std::string key = file.stem().string();
    const CacheFile cache{.cache = "order cache",
        .file = file,
        .kind = {.content = "a prepared mesh", .signature = "octrefin", .version = refine_mesh_cache_version},
        .key = key};
    const auto decode = [&](BinaryReader& in) {
        RefineMesh prepared;
        prepared.repairs.resize(in.take_count(sizeof(std::uint64_t), "a number of repairs"));
        for (std::string& line : prepared.repairs) { line = in.take_text(); }
        prepared.mesh = std::make_shared<const refine::ProgressiveMesh>(refine::progressive_mesh(in.take_text(), file));
        return prepared;
    };
    std::vector<std::string> notes;
    if (auto prepared = read_cache(cache, decode, notes)) {
        prepared->notes = std::move(mesh.notes);
        note_repairs(input, *prepared);
        return std::move(*prepared);
    }
    RefineMesh made = make_refine_mesh(input, std::move(mesh));
    BinaryWriter out;
    out.put(std::uint64_t{made.repairs.size()});
    for (const std::string& line : made.repairs) { out.put_text(line); }
    out.put_text(refine::progressive_bytes(*made.mesh));
    write_cache(cache, out.bytes(), notes);
    made.notes.insert(made.notes.end(), notes.begin(), notes.end());
    return made;
}

namespace {

/// An aircraft that comes as a mesh, in body axes: either levels of detail or a hierarchy, and polygons for far away.
struct MeshAircraft {
    /// Levels of detail, the finest first; none where there is a hierarchy.
    std::vector<models::meshfile::ChainLevel> levels;
    /// Null where there are levels.
    std::shared_ptr<const visuals::refine::ProgressiveMesh> hierarchy;
    /// What turns beside the hierarchy; its pivots are those of the polygons.
    std::vector<RotatingPart> turning;
    /// Surfaces that are seen through, which the hierarchy leaves out; often none.
    models::meshfile::TransparentSurfaces clear;
    /// What is drawn of it far away.
    PolygonModel polygons;
    /// No point of the polygons is farther than this from the mesh, nor of the mesh from them.
    double polygons_error_m = 0.0;
    std::vector<std::string> notes;
};

/// Triangles of all parts together, and of one at least.
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

/// A hierarchy from its file, or made of a mesh; what turns or is clear beside it goes to `aircraft`, in axes of the
/// file.
RefineMesh hierarchy_in(const fs::path& file, const fs::path& cache, MeshAircraft& aircraft) {
    const RefineMeshOptions input{.file = file.string(), .base = 0, .quiet = true};
    if (refine::is_progressive_file(file)) { return read_refine_mesh(input); }
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

MeshAircraft from_hierarchy(const fs::path& file, const std::string& setting, const fs::path& cache) {
    const Stopwatch watch;
    MeshAircraft aircraft;
    RefineMesh input = hierarchy_in(file, cache, aircraft);
    const AircraftAxes axes = aircraft_axes(setting, file, finest_mesh(*input.mesh));
    aircraft.notes = std::move(input.notes);
    note_axes(axes, file, aircraft.notes);
    aircraft.hierarchy = turned(*input.mesh, axes.axes);
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

/// Levels that are no better than the polygons are never drawn.
MeshAircraft from_chain(const fs::path& file, const std::string& setting) {
    meshfile::LevelChain chain = meshfile::read_chain(file);
    const AircraftAxes found = aircraft_axes(setting, file, chain.levels.front().mesh);
    const models::polygons::FileAxes& axes = found.axes;
    MeshAircraft aircraft;
    note_axes(found, file, aircraft.notes);
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

/// Reads a chain of levels (.chain), a progressive mesh (.pm) or any other mesh file, of which a hierarchy is made
/// here, or read where `cache`, a folder, has it of before; empty: none. `axes`: as aircraft_axes takes them. Throws
/// Error.
MeshAircraft read_mesh_aircraft(const fs::path& file, const std::string& axes, const fs::path& cache) {
    return meshfile::is_chain_file(file) ? from_chain(file, axes) : from_hierarchy(file, axes, cache);
}

/// Gives the model that was made of its polygons the rest of a mesh aircraft.
void add_meshes(planning::AircraftModel& model, const MeshAircraft& aircraft) {
    if (aircraft.hierarchy) {
        planning::add_progressive(model, aircraft.hierarchy, aircraft.polygons_error_m);
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

/// What the user's own cache may hold.
constexpr std::uintmax_t max_bytes_of_user_cache = std::uintmax_t{256} << 20;

/// A file of a cache.
struct FoundFile {
    fs::file_time_type written;
    fs::path path;
    std::uintmax_t bytes = 0;
};

/// What caches keep, and nothing else that lies there; the last two are of older releases. What another run is writing
/// is left alone.
const std::array<fs::path, 4> cache_file_endings{".order", ".mesh", ".pm", ".repairs"};

std::vector<FoundFile> files_of(const fs::path& folder) {
    std::vector<FoundFile> files;
    std::error_code ignored;
    for (fs::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored)) {
        const fs::path kind = entry->path().extension();
        std::error_code size_error;
        std::error_code time_error;
        const bool is_unfinished_file = is_unfinished(entry->path());
        if ((std::ranges::find(cache_file_endings, kind) == cache_file_endings.end() && !is_unfinished_file) ||
            entry->symlink_status(size_error).type() != fs::file_type::regular) {
            continue;
        }
        const std::uintmax_t bytes = entry->file_size(size_error);
        const fs::file_time_type written = entry->last_write_time(time_error);
        const bool is_being_written =
            is_unfinished_file && fs::file_time_type::clock::now() - written < std::chrono::hours(1);
        if (!size_error && !time_error && !is_being_written) { files.push_back({written, entry->path(), bytes}); }
    }
    return files;
}

} // namespace

void remove_oldest(const fs::path& folder, std::uintmax_t max_bytes) {
    std::vector<FoundFile> files = files_of(folder);
    std::ranges::sort(files, std::greater(), &FoundFile::written);
    std::uintmax_t sum = 0;
    for (const FoundFile& file : files) {
        if (file.bytes > max_bytes - sum) {
            std::error_code ignored;
            fs::remove(file.path, ignored);
        } else {
            sum += file.bytes;
        }
    }
}

std::optional<fs::path> order_cache_folder(const std::string& value) {
    if (settings::is_order_cache_folder(value)) {
        ordercache::make_cache_folder(value);
        return value;
    }
    const fs::path own = base::cache_folder();
    if (value == settings::no_order_cache || own.empty()) { return std::nullopt; }
    try {
        ordercache::make_cache_folder(own / "orders");
        remove_oldest(own / "orders", max_bytes_of_user_cache);
        return own / "orders";
    } catch (const Error&) { return std::nullopt; }
}

namespace {

/// The folder of cached painting orders, and what loading gives beside the models.
struct LoadContext {
    std::vector<std::string> notes;
    std::vector<fs::path> order_files;
    /// Where painting orders are kept.
    std::optional<fs::path> order_cache_folder;

    void note(const std::vector<std::string>& more) { notes.insert(notes.end(), more.begin(), more.end()); }
};

/// An OBJ file with more faces is flown as a mesh.
constexpr std::size_t max_polygons_of_a_model = 50'000;
/// So is one with more triangles, where there are nearly no other faces.
constexpr std::size_t max_triangles_of_a_model = 2'000;
/// Polygons that stand in for a mesh far away are put in order up to this number.
constexpr std::size_t max_polygons_of_a_mesh = 2'000;
/// So long their order is searched: few pixels come of it.
constexpr double max_seconds_of_a_mesh = 0.3;

/// What painting orders are looked for.
struct OrderLimits {
    std::size_t polygons = 0;
    double seconds = 0.0;
};

draworder::OrderedModel with_order(
    PolygonModel model, const AircraftSources& inputs, const OrderLimits& most, LoadContext& context) {
    if (inputs.hidden_surface != scene::HiddenSurface::Octant || model.polygons.size() > most.polygons) {
        draworder::DrawOrder order = draworder::file_order(model);
        return {.model = std::move(model), .order = std::move(order), .cells = {}, .notes = {}};
    }
    draworder::OrderOptions options;
    options.method = inputs.order_method;
    options.seconds = std::min(inputs.order_seconds, most.seconds);
    if (!context.order_cache_folder) { return draworder::ordered(std::move(model), options); }
    ordercache::CachedOrder cached = ordercache::cached_order(*context.order_cache_folder, std::move(model), options);
    context.note(cached.notes);
    if (settings::is_order_cache_folder(inputs.order_cache)) { context.order_files.push_back(cached.file); }
    return std::move(cached.ordered);
}

/// Whether a material file has pictures or glass, which meshes show.
bool has_pictures_or_glass(const fs::path& materials) {
    std::error_code ignored;
    if (!fs::is_regular_file(materials, ignored)) { return false; }
    const models::polygons::MtlFile read = models::polygons::read_mtl(materials);
    return !read.opacities.empty() || std::ranges::any_of(read.pictures, [&](const auto& of_material) {
        return fs::is_regular_file(materials.parent_path() / of_material.second, ignored);
    });
}

/// Whether an OBJ file is a polygon model, to be painted in order. Many faces that are nearly all triangles are the
/// mesh of a surface, which refinement in flight serves better.
bool is_polygon_model(const fs::path& file) {
    if (extension_of(file) != ".obj") { return false; }
    std::size_t triangles = 0;
    std::size_t others = 0;
    bool is_plain = true;
    const std::string text = read_text_file(file);
    TextScanner lines(file, text);
    while (lines.next_line()) {
        if (lines.skip("f")) {
            ++(lines.words().size() == 3 ? triangles : others);
        } else if (lines.skip("mtllib")) {
            is_plain = is_plain && !has_pictures_or_glass(file.parent_path() / lines.rest_of_line());
        }
    }
    const std::size_t faces = triangles + others;
    const bool is_mesh = faces > max_triangles_of_a_model && others < faces / 10;
    return is_plain && faces <= max_polygons_of_a_model && !is_mesh;
}

/// `kind`: the row of the aircraft; null for one of which only the shape is known.
planning::AircraftModel finished_model(PolygonModel model, const sim::AircraftKind* kind, const AircraftSources& inputs,
    const OrderLimits& most, LoadContext& context) {
    const glm::dvec3 eye_m = kind != nullptr ? kind->pilot_eye_m : planning::pilot_eye_m(model);
    const PolygonModel whole = model;
    draworder::OrderedModel ordered = with_order(std::move(model), inputs, most, context);
    context.note(ordered.notes);
    std::vector<glm::vec3> normals = shading::piece_normals(whole, shading::corner_normals(whole), ordered.model);
    planning::AircraftModel made =
        planning::aircraft_model(std::move(ordered.model), std::move(ordered.order), eye_m, std::move(normals));
    // Orders move points by a hair: the camera keeps its place however hidden surfaces are removed.
    made.subject.radius_m = models::polygons::radius_m(whole);
    return made;
}

PolygonModel read_polygon_model(const fs::path& file, const std::string& axes, LoadContext& context) {
    if (file.parent_path() == base::data_folder() / "models") { return models::polygons::read_obj(file); }
    const models::polygons::FileAxes default_axes;
    PolygonModel model = models::polygons::read_obj(file, default_axes);
    models::TriangleMesh shape = models::polygons::mesh_from_polygons(model);
    for (glm::dvec3& vertex_m : shape.vertices_m) { vertex_m = default_axes.file_from_body(vertex_m); }
    const AircraftAxes shown = aircraft_axes(axes, file, shape);
    note_axes(shown, file, context.notes);
    return shown.axes.text() == default_axes.text() ? std::move(model) : models::polygons::read_obj(file, shown.axes);
}

/// The polygons that are drawn of a mesh far away. If no painting order is found they are used for shadows only: their
/// error is then infinite.
planning::AircraftModel far_model(MeshAircraft& mesh, const AircraftSources& inputs, LoadContext& context) {
    if (mesh.polygons.polygons.size() <= max_polygons_of_a_mesh) {
        try {
            return finished_model(
                mesh.polygons, nullptr, inputs, {max_polygons_of_a_mesh, max_seconds_of_a_mesh}, context);
        } catch (const Error& fault) {
            context.notes.push_back(fmt::format("{}; the mesh is drawn at every distance instead", fault.what()));
        }
    }
    mesh.polygons_error_m = std::numeric_limits<double>::infinity();
    return finished_model(std::move(mesh.polygons), nullptr, inputs, {}, context);
}

planning::AircraftModel load_model(const std::string& name, const AircraftSources& inputs, LoadContext& context) {
    const fs::path file = base::aircraft_file(name);
    if (is_polygon_model(file)) {
        PolygonModel model = read_polygon_model(file, inputs.axes, context);
        context.note(model.notes);
        return finished_model(std::move(model), sim::find_aircraft_kind(name), inputs,
            {max_polygons_of_a_model, inputs.order_seconds}, context);
    }
    MeshAircraft mesh = read_mesh_aircraft(file, inputs.axes, context.order_cache_folder.value_or(fs::path()));
    context.note(mesh.notes);
    planning::AircraftModel model = far_model(mesh, inputs, context);
    add_meshes(model, mesh);
    return model;
}

/// Nothing where the aircraft has none.
std::optional<planning::AircraftModel> load_cockpit(const std::string& aircraft) {
    const sim::AircraftKind* kind = sim::find_aircraft_kind(aircraft);
    if (kind == nullptr) { return std::nullopt; }
    PolygonModel model = models::polygons::read_obj(base::data_folder() / "models" / kind->cockpit_file);
    draworder::DrawOrder order = draworder::file_order(model);
    return planning::aircraft_model(std::move(model), std::move(order), glm::dvec3(0.0));
}

} // namespace

AircraftSources aircraft_sources(const settings::RunSettings& settings, std::vector<std::string> shapes) {
    AircraftSources inputs{.shapes = std::move(shapes),
        .files = {},
        .axes = settings.path.axes,
        .hidden_surface = settings.surface.hidden_surface,
        .order_method = settings.surface.order_method,
        .order_seconds = settings.surface.order_seconds,
        .order_cache = settings.surface.order_cache};
    for (const std::string& shape : inputs.shapes) {
        const fs::path file = base::aircraft_file(shape);
        open_file(file);
        add_mtime(file, inputs.files);
        for (const fs::path& named : referenced_files(file)) { add_mtime(named, inputs.files); }
    }
    return inputs;
}

LoadedAircraft load_aircraft(const AircraftSources& inputs) {
    LoadedAircraft loaded;
    loaded.inputs = inputs;
    LoadContext context;
    context.order_cache_folder = order_cache_folder(inputs.order_cache);
    const auto add = [&](planning::AircraftModel model) {
        loaded.models.push_back(std::make_shared<const planning::AircraftModel>(std::move(model)));
    };
    std::vector<std::string> names;
    const auto model_of = [&](const std::string& name) {
        const auto known = std::ranges::find(names, name);
        const auto number = static_cast<std::uint32_t>(known - names.begin());
        if (known == names.end()) {
            names.push_back(name);
            add(load_model(name, inputs, context));
        }
        return number;
    };
    for (const std::string& name : inputs.shapes) { loaded.aircraft.push_back(model_of(name)); }
    for (std::uint32_t i = 0; i < names.size(); ++i) {
        const sim::AircraftKind* kind = sim::find_aircraft_kind(names[i]);
        if (kind != nullptr && !kind->simple_type_name.empty()) {
            loaded.far_models.push_back({i, model_of(std::string(kind->simple_type_name)), kind->simple_model_error_m});
        }
    }
    if (auto cockpit = load_cockpit(inputs.shapes.front())) {
        loaded.cockpit = static_cast<std::uint32_t>(loaded.models.size());
        loaded.dials = planning::dials_of(cockpit->polygons, sim::aircraft_kind(inputs.shapes.front()).limits);
        add(std::move(*cockpit));
    }
    loaded.notes = std::move(context.notes);
    loaded.order_files = std::move(context.order_files);
    return loaded;
}

} // namespace octant::ui::world
