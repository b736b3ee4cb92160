#include "ui/world/aircraft_loader.h"

#include "models/meshfile/picture_path.h"
#include "models/meshfile/texture_store.h"
#include "models/polygons/file_axes.h"
#include "models/polygons/obj_reader.h"
#include "models/polygons/polygon_model.h"
#include "sim/aircraft_kind.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/stopwatch.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"
#include "ui/base/data_files.h"
#include "ui/settings/settings.h"
#include "ui/world/input_files.h"
#include "ui/world/mesh_aircraft.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/ordercache/order_cache.h"
#include "visuals/planning/aircraft_model.h"
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
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace octant::ui::world {

namespace fs = std::filesystem;
namespace ordercache = visuals::ordercache;

namespace {

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

namespace draworder = visuals::draworder;
namespace fs = std::filesystem;
namespace ordercache = visuals::ordercache;
namespace planning = visuals::planning;
namespace scene = visuals::scene;
namespace shading = visuals::shading;
using models::polygons::PolygonModel;

namespace {

/// The folder of cached painting orders, and what loading gives beside the models.
struct LoadContext {
    std::vector<std::string> notes;
    std::vector<fs::path> order_files;
    /// Where painting orders are kept.
    std::optional<fs::path> order_cache_folder;
    /// The pictures on aircraft; null where they are not drawn.
    std::shared_ptr<models::meshfile::TextureStore> textures;

    void note(const std::vector<std::string>& more) { notes.insert(notes.end(), more.begin(), more.end()); }
};

/// An OBJ file with more faces is flown as a mesh.
constexpr std::size_t max_polygons_of_a_model = 50'000;
/// So is one with more triangles, where there are nearly no other faces.
constexpr std::size_t max_triangles_of_a_model = 2'000;
/// Larger sets of polygons that replace a mesh far away get no painting order.
constexpr std::size_t max_polygons_of_a_mesh = 2'000;
/// Limit for the search of their order, which decides few pixels, and of that of glass.
constexpr double max_seconds_of_a_mesh = 0.3;
/// More transparent polygons than these are not sorted.
constexpr std::size_t max_polygons_of_glass = 20'000;

/// What painting orders are looked for.
struct OrderLimits {
    std::size_t polygons = 0;
    double seconds = 0.0;
};

/// A model with a painting order for every eye, or as printed.
draworder::OrderedModel sorted(
    PolygonModel model, const AircraftSources& inputs, double max_seconds, LoadContext& context) {
    draworder::OrderOptions options;
    options.method = inputs.order_method;
    options.seconds = std::min(inputs.order_seconds, max_seconds);
    if (!context.order_cache_folder) { return draworder::ordered(std::move(model), options); }
    ordercache::CachedOrder cached = ordercache::cached_order(*context.order_cache_folder, std::move(model), options);
    context.note(cached.notes);
    if (settings::is_order_cache_folder(inputs.order_cache)) { context.order_files.push_back(cached.file); }
    return std::move(cached.ordered);
}

/// In file order; transparent polygons come after all others, sorted for every eye where they are not too many.
draworder::OrderedModel drawn_by_depth(PolygonModel model, const AircraftSources& inputs, LoadContext& context) {
    const auto sort = [&](PolygonModel glass) -> draworder::OrderedModel {
        if (glass.polygons.size() <= max_polygons_of_glass) {
            AircraftSources exactly = inputs;
            exactly.order_method = draworder::OrderMethod::Exact;
            return sorted(std::move(glass), exactly, max_seconds_of_a_mesh, context);
        }
        context.notes.push_back(fmt::format("{}: {} transparent polygons are too many to be sorted (at most {}): "
                                            "blended as the file has them",
            glass.name, glass.polygons.size(), max_polygons_of_glass));
        draworder::DrawOrder order = draworder::file_order(glass);
        return {.model = std::move(glass), .order = std::move(order)};
    };
    if (draworder::has_transparent_polygons(model)) { return draworder::opaque_first(model, sort); }
    draworder::DrawOrder order = draworder::file_order(model);
    return {.model = std::move(model), .order = std::move(order)};
}

draworder::OrderedModel with_order(
    PolygonModel model, const AircraftSources& inputs, const OrderLimits& most, LoadContext& context) {
    if (inputs.hidden_surface != scene::HiddenSurface::Octant || model.polygons.size() > most.polygons) {
        return drawn_by_depth(std::move(model), inputs, context);
    }
    return sorted(std::move(model), inputs, most.seconds, context);
}

/// Whether a material file has pictures, which are shown on meshes where they are not drawn as textures.
bool has_pictures(const fs::path& materials) {
    std::error_code ignored;
    if (!fs::is_regular_file(materials, ignored)) { return false; }
    const models::polygons::MtlFile read = models::polygons::read_mtl(materials);
    return std::ranges::any_of(read.pictures, [&](const auto& of_material) {
        return fs::is_regular_file(materials.parent_path() / of_material.second.file, ignored);
    });
}

/// Whether an OBJ file is a polygon model, to be painted in order. Many faces that are nearly all triangles are the
/// mesh of a surface, which refinement in flight serves better.
bool is_polygon_model(const fs::path& file, bool textures) {
    if (extension_of(file) != ".obj" || models::meshfile::is_xplane_object(file)) { return false; }
    std::size_t triangles = 0;
    std::size_t others = 0;
    bool is_plain = true;
    const std::string text = read_text_file(file);
    TextScanner lines(file, text);
    while (lines.next_line()) {
        if (lines.skip("f")) {
            ++(lines.words().size() == 3 ? triangles : others);
        } else if (lines.skip("mtllib")) {
            is_plain = is_plain && (textures || !has_pictures(file.parent_path() / lines.rest_of_line()));
        }
    }
    const std::size_t faces = triangles + others;
    const bool is_mesh = faces > max_triangles_of_a_model && others < faces / 10;
    return is_plain && faces <= max_polygons_of_a_model && !is_mesh;
}

/// A model with its order, and what belongs to the corners of the polygons that were cut for it.
struct FinishedOrder {
    draworder::OrderedModel ordered;
    std::vector<glm::vec3> normals;
};

FinishedOrder finished_order(
    const PolygonModel& whole, const AircraftSources& inputs, const OrderLimits& most, LoadContext& context) {
    PolygonModel model = whole;
    model.corner_texture_coordinates.clear(); // orders need none and cut polygons
    FinishedOrder made{with_order(std::move(model), inputs, most, context), {}};
    context.note(made.ordered.notes);
    made.normals = shading::piece_normals(whole, shading::corner_normals(whole), made.ordered.model);
    if (!whole.corner_texture_coordinates.empty()) {
        made.ordered.model.corner_texture_coordinates = shading::piece_texture_coordinates(whole, made.ordered.model);
    }
    return made;
}

/// `kind`: the row of the aircraft; null for one of which only the shape is known.
planning::AircraftModel finished_model(PolygonModel model, const sim::AircraftKind* kind, const AircraftSources& inputs,
    const OrderLimits& most, LoadContext& context) {
    const glm::dvec3 eye_m = kind != nullptr ? kind->pilot_eye_m : planning::pilot_eye_m(model);
    FinishedOrder made = finished_order(model, inputs, most, context);
    planning::AircraftModel finished = planning::aircraft_model(
        std::move(made.ordered.model), std::move(made.ordered.order), eye_m, std::move(made.normals));
    // Orders move points by a hair: the camera keeps its place however hidden surfaces are removed.
    finished.subject.radius_m = models::polygons::radius_m(model);
    return finished;
}

/// Adds the transparent surfaces of a mesh, sorted for every eye, to its model.
void add_glass(
    const PolygonModel& glass, const AircraftSources& inputs, LoadContext& context, planning::AircraftModel& model) {
    if (glass.polygons.empty()) { return; }
    FinishedOrder made = finished_order(glass, inputs, {}, context);
    planning::add_glass(model, made.ordered.model, std::move(made.ordered.order), std::move(made.normals));
}

/// Decodes the pictures that the materials name. Those that cannot be read are noted.
void take_pictures(PolygonModel& model, const fs::path& file, LoadContext& context) {
    for (models::Material& material : model.materials) {
        if (material.picture.empty()) { continue; }
        const fs::path picture = models::meshfile::picture_file(file, material.picture);
        try {
            models::set_picture(material, context.textures->picture_in(picture));
            material.picture = picture.string();
            if (material.colour == glm::vec3(0.0F)) { material.colour = glm::vec3(1.0F); } // as meshes
        } catch (const Error& fault) {
            context.notes.push_back(fmt::format("{}; its surfaces have their material's colour", fault.what()));
        }
    }
}

PolygonModel read_polygon_model(const fs::path& file, const AircraftFrameSettings& frame, LoadContext& context) {
    if (file.parent_path() == base::data_folder() / "models") { return models::polygons::read_obj(file); }
    const bool textures = context.textures != nullptr;
    const models::polygons::FileAxes default_axes;
    PolygonModel model = models::polygons::read_obj(file, default_axes, textures);
    models::TriangleMesh shape = models::polygons::mesh_from_polygons(model);
    for (glm::dvec3& vertex_m : shape.vertices_m) { vertex_m = default_axes.file_from_body(vertex_m); }
    const AircraftAxes shown = aircraft_axes(frame.axes, file, shape);
    const models::BoundingBox bounds = models::bounds_of(shape);
    for (const auto& note :
        {axes_note(shown, file), size_note((bounds.max_m - bounds.min_m) * frame.scale, frame.scale, file)}) {
        if (note) { context.notes.push_back(*note); }
    }
    const glm::dvec3 origin = flown_origin(file, bounds);
    if (const auto note = origin_note(origin, file)) { context.notes.push_back(*note); }
    if (shown.axes.text() != default_axes.text()) { model = models::polygons::read_obj(file, shown.axes, textures); }
    const glm::dvec3 body_origin = shown.axes.body_from_file(origin);
    if (frame.scale != 1.0 || origin != glm::dvec3(0.0)) {
        for (glm::dvec3& vertex_m : model.vertices_m) { vertex_m = frame.scale * (vertex_m - body_origin); }
        for (models::polygons::Pivot& pivot : model.pivots) {
            pivot.point_m = frame.scale * (pivot.point_m - body_origin);
        }
    }
    if (textures) { take_pictures(model, file, context); }
    return model;
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
    if (is_polygon_model(file, context.textures != nullptr)) {
        PolygonModel model = read_polygon_model(file, inputs.frame, context);
        context.note(model.notes);
        return finished_model(std::move(model), sim::find_aircraft_kind(name), inputs,
            {max_polygons_of_a_model, inputs.order_seconds}, context);
    }
    MeshAircraft mesh =
        read_mesh_aircraft(file, inputs.frame, context.order_cache_folder.value_or(fs::path()), context.textures);
    context.note(mesh.notes);
    planning::AircraftModel model = far_model(mesh, inputs, context);
    add_meshes(model, mesh);
    add_glass(mesh.glass, inputs, context, model);
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
        .frame = {settings.path.axes, settings.path.aircraft_scale},
        .hidden_surface = settings.surface.hidden_surface,
        .order_method = settings.surface.order_method,
        .order_seconds = settings.surface.order_seconds,
        .order_cache = settings.surface.order_cache,
        .textures = settings.surface.textures};
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
    if (inputs.textures) { context.textures = std::make_shared<models::meshfile::TextureStore>(); }
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
    auto cockpit = inputs.shapes.empty() ? std::nullopt : load_cockpit(inputs.shapes.front());
    if (cockpit) {
        loaded.cockpit = static_cast<std::uint32_t>(loaded.models.size());
        loaded.dials = planning::dials_of(cockpit->polygons, sim::aircraft_kind(inputs.shapes.front()).limits);
        add(std::move(*cockpit));
    }
    if (context.textures) { context.note(context.textures->notes()); }
    loaded.notes = std::move(context.notes);
    loaded.order_files = std::move(context.order_files);
    return loaded;
}

} // namespace octant::ui::world
