#include "ui/world/aircraft_loader.h"

#include "models/polygons/file_axes.h"
#include "models/polygons/mesh_polygons.h"
#include "models/polygons/mtl_reader.h"
#include "models/polygons/obj_line_reader.h"
#include "models/polygons/obj_reader.h"
#include "sim/aircraft_kind.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/base/data_files.h"
#include "ui/settings/order_cache_name.h"
#include "ui/world/aircraft_axes.h"
#include "ui/world/mesh_aircraft.h"
#include "ui/world/referenced_files.h"
#include "ui/world/order_cache_folder.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/ordercache/order_cache.h"
#include "visuals/planning/cockpit_dials.h"
#include "visuals/shading/piece_normals.h"
#include "visuals/shading/vertex_normals.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace octant::ui::world {

namespace planning = visuals::planning;
namespace scene = visuals::scene;
namespace draworder = visuals::draworder;
namespace ordercache = visuals::ordercache;
namespace shading = visuals::shading;

namespace {

/// What loading comes upon beside the models.
struct LoadNotes {
    std::vector<std::string> notes;
    std::vector<std::filesystem::path> order_files;
    /// Where painting orders are kept.
    std::optional<std::filesystem::path> order_cache_folder;

    void note(const std::vector<std::string>& more) {
        notes.insert(notes.end(), more.begin(), more.end());
    }
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
    models::polygons::PolygonModel model,
    const AircraftSources& inputs,
    const OrderLimits& most,
    LoadNotes& load_notes) {
    if (inputs.hidden_surface != scene::HiddenSurface::Octant ||
        model.polygons.size() > most.polygons) {
        draworder::DrawOrder order = draworder::file_order(model);
        return {.model = std::move(model), .order = std::move(order), .cells = {}, .notes = {}};
    }
    draworder::OrderOptions options;
    options.method = inputs.order_method;
    options.seconds = std::min(inputs.order_seconds, most.seconds);
    if (!load_notes.order_cache_folder) {
        return draworder::ordered(std::move(model), options);
    }
    ordercache::CachedOrder cached =
        ordercache::cached_order(*load_notes.order_cache_folder, std::move(model), options);
    load_notes.note(cached.notes);
    if (settings::is_order_cache_folder(inputs.order_cache)) {
        load_notes.order_files.push_back(cached.file);
    }
    return std::move(cached.ordered);
}

/// Whether a line of an OBJ file names a material file of pictures or glass, which meshes show.
bool names_pictures_or_glass(std::string_view line, const std::filesystem::path& file) {
    if (!line.starts_with("mtllib")) {
        return false;
    }
    const std::filesystem::path folder = file.parent_path();
    const std::filesystem::path materials = folder / models::polygons::after_first_word(line);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(materials, ignored)) {
        return false;
    }
    const auto pictures = models::polygons::pictures_of_mtl(materials);
    return !models::polygons::opacities_of_mtl(materials).empty() ||
           std::ranges::any_of(pictures, [&](const auto& of_material) {
               return std::filesystem::is_regular_file(folder / of_material.second, ignored);
           });
}

/// Whether an OBJ file is a polygon model, to be painted in order. Many faces that are nearly all
/// triangles are the mesh of a surface, which refinement in flight serves better.
bool is_polygon_model(const std::filesystem::path& file) {
    if (extension_of(file) != ".obj") {
        return false;
    }
    std::size_t triangles = 0;
    std::size_t others = 0;
    bool is_plain = true;
    const std::string text = read_text_file(file);
    for (const std::string_view line : split_lines(text)) {
        if (line.starts_with("f ") || line.starts_with("f\t")) {
            ++(split_words(line).size() == 4 ? triangles : others);
        }
        is_plain = is_plain && !names_pictures_or_glass(line, file);
    }
    const std::size_t faces = triangles + others;
    const bool is_mesh = faces > max_triangles_of_a_model && others < faces / 10;
    return is_plain && faces <= max_polygons_of_a_model && !is_mesh;
}

/// `kind`: the row of the aircraft; null for one of which only the shape is known.
planning::AircraftModel finished_model(
    models::polygons::PolygonModel model,
    const sim::AircraftKind* kind,
    const AircraftSources& inputs,
    const OrderLimits& most,
    LoadNotes& load_notes) {
    const glm::dvec3 eye_m = kind != nullptr ? kind->pilot_eye_m : planning::pilot_eye_m(model);
    const models::polygons::PolygonModel whole = model;
    draworder::OrderedModel ordered = with_order(std::move(model), inputs, most, load_notes);
    load_notes.note(ordered.notes);
    std::vector<glm::vec3> normals =
        shading::piece_normals(whole, shading::corner_normals(whole), ordered.model);
    planning::AircraftModel made = planning::aircraft_model(
        std::move(ordered.model), std::move(ordered.order), eye_m, std::move(normals));
    // Orders move points by a hair: the camera keeps its place however hidden surfaces are removed.
    made.subject.radius_m = models::polygons::radius_m(whole);
    return made;
}

models::polygons::PolygonModel
read_polygon_model(const std::filesystem::path& file, const std::string& axes, LoadNotes& load_notes) {
    if (file.parent_path() == base::data_folder() / "models") {
        return models::polygons::read_obj(file);
    }
    const models::polygons::FileAxes default_axes;
    models::polygons::PolygonModel model = models::polygons::read_obj(file, default_axes);
    models::TriangleMesh shape = models::polygons::mesh_from_polygons(model);
    for (glm::dvec3& vertex_m : shape.vertices_m) {
        vertex_m = default_axes.file_from_body(vertex_m);
    }
    const AircraftAxes shown = aircraft_axes(axes, file, shape);
    if (std::string note = axes_note(shown, file); !note.empty()) {
        load_notes.notes.push_back(std::move(note));
    }
    return shown.axes.text() == default_axes.text() ? std::move(model)
                                             : models::polygons::read_obj(file, shown.axes);
}

/// The polygons that stand in for a mesh far away. Without a painting order they only throw
/// shadows.
planning::AircraftModel far_model(MeshAircraft& mesh, const AircraftSources& inputs, LoadNotes& load_notes) {
    if (mesh.polygons.polygons.size() <= max_polygons_of_a_mesh) {
        try {
            return finished_model(
                mesh.polygons,
                nullptr,
                inputs,
                {max_polygons_of_a_mesh, max_seconds_of_a_mesh},
                load_notes);
        } catch (const Error& fault) {
            load_notes.notes.push_back(
                fmt::format("{}; the mesh is drawn at every distance instead", fault.what()));
        }
    }
    mesh.polygons_error_m = std::numeric_limits<double>::infinity();
    return finished_model(std::move(mesh.polygons), nullptr, inputs, {}, load_notes);
}

planning::AircraftModel
load_model(const std::string& name, const AircraftSources& inputs, LoadNotes& load_notes) {
    const std::filesystem::path file = base::aircraft_file(name);
    if (is_polygon_model(file)) {
        models::polygons::PolygonModel model = read_polygon_model(file, inputs.axes, load_notes);
        load_notes.note(model.notes);
        return finished_model(
            std::move(model),
            sim::find_aircraft_kind(name),
            inputs,
            {max_polygons_of_a_model, inputs.order_seconds},
            load_notes);
    }
    MeshAircraft mesh =
        read_mesh_aircraft(file, inputs.axes, load_notes.order_cache_folder.value_or(std::filesystem::path()));
    load_notes.note(mesh.notes);
    planning::AircraftModel model = far_model(mesh, inputs, load_notes);
    add_meshes(model, mesh);
    return model;
}

/// Nothing where the aircraft has none.
std::optional<planning::AircraftModel> load_cockpit(const std::string& aircraft) {
    const sim::AircraftKind* kind = sim::find_aircraft_kind(aircraft);
    if (kind == nullptr) {
        return std::nullopt;
    }
    models::polygons::PolygonModel model =
        models::polygons::read_obj(base::data_folder() / "models" / kind->cockpit_file);
    draworder::DrawOrder order = draworder::file_order(model);
    return planning::aircraft_model(std::move(model), std::move(order), glm::dvec3(0.0));
}

} // namespace

AircraftSources
aircraft_sources(const settings::RunSettings& settings, std::vector<std::string> shapes) {
    AircraftSources inputs{
        .shapes = std::move(shapes),
        .files = {},
        .axes = settings.path.axes,
        .hidden_surface = settings.surface.hidden_surface,
        .order_method = settings.surface.order_method,
        .order_seconds = settings.surface.order_seconds,
        .order_cache = settings.surface.order_cache};
    for (const std::string& shape : inputs.shapes) {
        const std::filesystem::path file = base::aircraft_file(shape);
        const LineReader opened(file);
        add_mtime(file, inputs.files);
        for (const std::filesystem::path& named : referenced_files(file)) {
            add_mtime(named, inputs.files);
        }
    }
    return inputs;
}

LoadedAircraft load_aircraft(const AircraftSources& inputs) {
    LoadedAircraft loaded;
    loaded.inputs = inputs;
    LoadNotes told;
    told.order_cache_folder = order_cache_folder(inputs.order_cache);
    const auto add = [&](planning::AircraftModel model) {
        loaded.models.push_back(std::make_shared<const planning::AircraftModel>(std::move(model)));
    };
    std::vector<std::string> names;
    for (const std::string& name : inputs.shapes) {
        const auto load_notes = std::find(names.begin(), names.end(), name);
        loaded.aircraft.push_back(static_cast<std::uint32_t>(load_notes - names.begin()));
        if (load_notes == names.end()) {
            names.push_back(name);
            add(load_model(name, inputs, told));
        }
    }
    for (std::uint32_t i = 0; i < names.size(); ++i) {
        const sim::AircraftKind* kind = sim::find_aircraft_kind(names[i]);
        if (kind == nullptr || kind->simple_type_name.empty()) {
            continue;
        }
        const std::string plain(kind->simple_type_name);
        const auto load_notes = std::find(names.begin(), names.end(), plain);
        loaded.far_models.push_back(
            {i, static_cast<std::uint32_t>(load_notes - names.begin()), kind->simple_model_error_m});
        if (load_notes == names.end()) {
            names.push_back(plain);
            add(load_model(plain, inputs, told));
        }
    }
    if (auto cockpit = load_cockpit(inputs.shapes.front())) {
        loaded.cockpit = static_cast<std::uint32_t>(loaded.models.size());
        loaded.dials =
            planning::dials_of(cockpit->polygons, sim::aircraft_kind(inputs.shapes.front()).limits);
        add(std::move(*cockpit));
    }
    loaded.notes = std::move(told.notes);
    loaded.order_files = std::move(told.order_files);
    return loaded;
}

} // namespace octant::ui::world
