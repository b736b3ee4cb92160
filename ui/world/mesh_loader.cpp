#include "ui/world/mesh_loader.h"

#include "models/meshfile/mesh_file.h"
#include "models/polygons/polygon_model.h"
#include "models/procedural/procedural_models.h"
#include "models/repair/repair.h"
#include "models/simplify/simplify.h"
#include "sim/base/binary_file.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/base/data_files.h"
#include "ui/base/progress.h"
#include "ui/report/child_program.h"
#include "ui/world/mesh_textures.h"
#include "ui/world/unpacked_file.h"
#include "visuals/refine/progressive_file.h"
#include "visuals/refine/progressive_mesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

namespace octant::ui::world {

namespace fs = std::filesystem;
namespace refine = visuals::refine;

namespace {

struct Library {
    /// Its name in the command line of octant-read-mesh.
    std::string_view word;
    std::string_view name;
    std::string_view endings;
};

/// The limit of Octant's own readers. The libraries read larger files for a minute and then fail for want of memory.
constexpr std::uintmax_t largest_bytes = std::uintmax_t{1} << 30U;

constexpr std::array libraries{
    Library{"assimp", "Assimp", ".3ds .ase .b3d .blend .dae .dxf .fbx .lwo .lws .md2 .ms3d .x"},
    Library{"osg", "OpenSceneGraph", ".flt .ive .osg .osgb .osgt"}};

const Library* library_of(const fs::path& file) {
    const std::string ending = extension_of(file);
    for (const Library& library : libraries) {
        const auto endings = split_words(library.endings);
        if (std::ranges::find(endings, ending) != endings.end()) { return &library; }
    }
    return nullptr;
}

/// With the reader's own message if it has one; else it crashed or met its limits.
[[noreturn]] void refuse(const fs::path& file, const Library& library, std::string_view error_line) {
    if (const std::string named = file.string() + ": "; error_line.starts_with(named)) {
        error_line.remove_prefix(named.size());
    }
    constexpr std::size_t longest = 300;
    const std::string words = one_line(error_line.substr(0, longest));
    throw_error_in(file, words.starts_with("expected ")
                             ? words
                             : fmt::format("expected a mesh that {} can read; its reader: {}", library.name, words));
}

} // namespace

bool is_library_file(const fs::path& file) { return library_of(file) != nullptr; }

namespace {

/// Reads a model by a library in a process of its own; as read_library_mesh(), with transparent surfaces apart.
models::meshfile::RotatingModel read_library_model(const fs::path& file, const models::meshfile::ReadOptions& options) {
    const Library& library = *library_of(file);
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) { throw_error_in(file, "expected a file that can be read, got none"); }
    if (fs::file_size(file, ignored) > largest_bytes) {
        throw_error_in(file, fmt::format("expected at most {} bytes, got more", largest_bytes));
    }
    const fs::path program = reader_program();
    if (program.empty()) {
        throw_error_in(file,
            fmt::format("expected a build with {} for {} files, got one without", library.name, extension_of(file)));
    }
    const base::TemporaryFolder folder;
    const fs::path out = folder.path() / "mesh.obj";
    auto child = report::ChildProgram::start({program.string(), std::string(library.word),
        options.textures   ? "textures"
        : options.pictures ? "pictures"
                           : "-",
        options.backs ? "backs" : "-", file.string(), out.string()});
    if (!child) { throw_error_in(program, "expected a program that can be run, got another file"); }
    const report::ProgramResult ending = child->finish();
    if (!ending.succeeded) { refuse(file, library, ending.last_error_line); }
    // The colours of pictures came with the vertices; what keeps the pictures themselves has to read them.
    models::meshfile::RotatingModel model = models::meshfile::read_rotating_model(
        out, {.pictures = options.textures != nullptr, .textures = options.textures});
    model.body.name = file.stem().string();
    for (models::TriangleMesh* mesh : {&model.body, &model.clear}) {
        for (models::Material& material : mesh->materials) {
            if (fs::path(material.picture).parent_path() == folder.path()) { // one that was inside the file
                material.picture_bytes =
                    std::make_shared<const std::string>(read_file(material.picture, largest_bytes));
                material.picture = fs::path(material.picture).filename().string();
            }
        }
    }
    return model;
}

} // namespace

models::TriangleMesh read_library_mesh(const fs::path& file, const models::meshfile::ReadOptions& options) {
    models::meshfile::RotatingModel model = read_library_model(file, options);
    models::meshfile::join_mesh(model.body, std::move(model.clear), {});
    return std::move(model.body);
}

std::string library_formats() {
    if (reader_program().empty()) { return "no formats by libraries: built without Assimp and OpenSceneGraph"; }
    std::string text;
    for (const Library& library : libraries) {
        text += fmt::format("{}by {}: {}", text.empty() ? "" : "\n", library.name, library.endings);
    }
    return text;
}

std::string built_in_mesh_names() {
    return fmt::format("globe, torus, machined-part, {}", fmt::join(base::built_in_models, ", "));
}

models::TriangleMesh load_mesh(const std::string& name_or_file, const models::meshfile::ReadOptions& options) {
    if (!path_exists(name_or_file)) {
        if (name_or_file == "globe") { return models::procedural::globe(); }
        if (name_or_file == "machined-part") { return models::procedural::machined_part(); }
        if (name_or_file == "torus") { return models::polygons::mesh_from_polygons(models::procedural::torus()); }
        if (std::ranges::find(base::built_in_models, name_or_file) != base::built_in_models.end()) {
            return models::meshfile::read_mesh(base::aircraft_file(name_or_file), options);
        }
    }
    return is_library_file(name_or_file) ? read_library_mesh(name_or_file, options)
                                         : read_packed_mesh(name_or_file, options);
}

models::meshfile::RotatingModel load_rotating_model(
    const std::string& name_or_file, const models::meshfile::ReadOptions& options) {
    if (path_exists(name_or_file)) {
        if (is_library_file(name_or_file)) { return read_library_model(name_or_file, options); }
        if (models::meshfile::is_mesh_file(name_or_file)) { return read_packed_model(name_or_file, options); }
    }
    return {load_mesh(name_or_file, options), {}, {}};
}

namespace {

/// Colours are vertices' in a hierarchy: those of the materials around each, where it has none.
void colour_by_materials(models::TriangleMesh& mesh) {
    if (!mesh.colours.empty()) { return; }
    std::vector<glm::vec3> sums(mesh.vertices_m.size(), glm::vec3(0.0F));
    std::vector<int> counts(mesh.vertices_m.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::vec3 colour = models::material_colour(mesh, t);
        for (const std::uint32_t vertex : mesh.triangles[t]) {
            sums[vertex] += colour;
            ++counts[vertex];
        }
    }
    for (std::size_t v = 0; v < sums.size(); ++v) {
        mesh.colours.push_back(counts[v] > 0 ? sums[v] / static_cast<float>(counts[v]) : models::Material().colour);
    }
}

/// Whether a hierarchy has the colour of a mesh without materials everywhere, as one has that was saved of a mesh
/// without colours.
bool is_all_grey(const refine::ProgressiveMesh& mesh) {
    const refine::PackedColour grey = refine::packed_rgb16(models::Material().colour);
    for (std::uint32_t leaf = 0; leaf < mesh.leaf_count(); ++leaf) {
        if (refine::unpacked(mesh.packed_colour(leaf)) != refine::unpacked(grey)) { return false; }
    }
    return mesh.has_colours();
}

void refuse_too_many(const std::string& file, const models::TriangleMesh& mesh) {
    using refine::ProgressiveMesh;
    if (mesh.triangles.size() > ProgressiveMesh::max_faces || mesh.vertices_m.size() > ProgressiveMesh::max_leaves) {
        throw_error_in(file, fmt::format("expected at most {} triangles and {} vertices to refine, got {} and {} "
                                         "(octant simplify makes fewer of them)",
                                 ProgressiveMesh::max_faces, ProgressiveMesh::max_leaves, mesh.triangles.size(),
                                 mesh.vertices_m.size()));
    }
}

/// Adds its repairs to the notes of a mesh.
void note_repairs(const RefineMeshOptions& input, RefineMesh& mesh) {
    for (const std::string& line : mesh.repairs) { mesh.notes.push_back(input.file + ": " + line); }
}

} // namespace

namespace {

/// Collapses the edges of a repaired mesh. Where pictures lie on it, seams of their coordinates are kept, and the nodes
/// get places on them; each chart keeps name, colour and opacity of its material. Else there are no places.
std::pair<std::shared_ptr<const refine::ProgressiveMesh>, NodePlaces> hierarchy_of(models::TriangleMesh mesh,
    bool is_plain, const models::simplify::SimplifyOptions& options, std::vector<std::string>& notes) {
    const std::optional<models::simplify::AttributeSeams> charts = texture_charts(mesh, is_plain, notes);
    if (!charts) {
        return {
            std::make_shared<const refine::ProgressiveMesh>(models::simplify::fast_sequence(std::move(mesh), options)),
            {}};
    }
    models::CollapseSequence sequence = models::simplify::fast_sequence(charts->marked(), options);
    for (std::size_t chart = 0; chart < sequence.original.materials.size(); ++chart) {
        const std::uint32_t of_chart = charts->materials_of_charts()[chart];
        if (of_chart >= mesh.materials.size()) { continue; }
        const models::Material& material = mesh.materials[of_chart];
        sequence.original.materials[chart] = {
            .name = material.name, .colour = material.colour, .opacity = material.opacity};
    }
    sequence.original.normals = std::move(mesh.normals);
    sequence.original.corner_normals = std::move(mesh.corner_normals);
    auto made = std::make_shared<const refine::ProgressiveMesh>(sequence);
    NodePlaces places = node_places(*made, *charts);
    return {std::move(made), std::move(places)};
}

} // namespace

RefineMesh make_refine_mesh(const RefineMeshOptions& input, models::TriangleMesh mesh) {
    const std::vector<models::Material> materials = mesh.materials;
    const bool is_plain = has_plain_colours(mesh);
    models::repair::RepairedMesh repaired = models::repair::repaired(std::move(mesh));
    RefineMesh result;
    result.notes = repaired.mesh.notes;
    result.repairs = models::repair::describe_counts(repaired.counts);
    note_repairs(input, result);
    if (repaired.mesh.triangles.empty()) { throw_error_in(input.file, "expected a mesh with triangles, got none"); }
    refuse_too_many(input.file, repaired.mesh);
    result.has_material_colours = repaired.mesh.colours.empty();
    colour_by_materials(repaired.mesh);
    constexpr int steps = 1000;
    base::Progress progress("collapsing edges", steps, input.quiet, "thousandths");
    models::simplify::SimplifyOptions options;
    options.length_share = 0.03;
    if (input.base > 0) { options.goal.vertices = input.base; }
    options.show_progress = [&](double share) { progress.show(static_cast<int>(share * steps)); };
    const std::vector<refine::CornerNormals> normals = refine::creased_normals(repaired.mesh);
    NodePlaces places;
    std::tie(result.mesh, places) = hierarchy_of(std::move(repaired.mesh), is_plain, options, result.notes);
    progress.finish();
    result.creases = refine::mesh_creases(*result.mesh, normals);
    if (!places.first.empty()) {
        result.chart_materials = places.chart_materials;
        result.textures = mesh_textures(std::move(places), materials, is_plain, result.mesh->node_count());
    }
    return result;
}

namespace {

/// Raised whenever make_refine_mesh() gives any mesh another hierarchy, or its file another layout: what was cached
/// before is then made anew.
constexpr unsigned refine_mesh_cache_version = 8;

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
    hash.add_word(mesh.colours_are_means ? 1 : 0);
    add_list(hash, mesh.triangles);
    add_list(hash, mesh.normals);
    add_list(hash, mesh.corner_normals);
    add_list(hash, mesh.triangle_materials);
    for (const models::Material& material : mesh.materials) { hash.add(std::as_bytes(std::span(&material.colour, 1))); }
    if (has_textures(mesh)) {
        add_list(hash, mesh.texture_coordinates);
        add_list(hash, mesh.corner_texture_coordinates);
        for (const models::Material& material : mesh.materials) {
            hash.add_word(material.texture.picture != nullptr ? 1 : 0);
        }
    }
    return hash.value();
}

} // namespace

fs::path refine_mesh_cache_file(const fs::path& folder, const models::TriangleMesh& mesh) {
    return folder / fmt::format("{:016x}{:016x}.mesh", hash_of(mesh, 1), hash_of(mesh, 2));
}

RefineMesh cached_refine_mesh(const fs::path& folder, const RefineMeshOptions& input, models::TriangleMesh mesh) {
    const fs::path file = refine_mesh_cache_file(folder, mesh);
    const bool is_plain = has_plain_colours(mesh);
    const bool is_textured = has_textures(mesh) || is_plain;
    const std::vector<models::Material> materials = is_textured ? mesh.materials : std::vector<models::Material>();
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
        // In the order of the original faces, as creased_normals has them.
        const auto normals = in.take_list<refine::CornerNormals>();
        in.check(normals.empty() || normals.size() == prepared.mesh->face_count(), "normals for each face, or none");
        prepared.creases = refine::mesh_creases(*prepared.mesh, normals);
        if (is_textured) {
            NodePlaces places;
            places.first = in.take_list<std::uint32_t>();
            places.places = in.take_list<refine::ChartPlace>();
            places.chart_materials = in.take_list<std::uint32_t>();
            prepared.textures = mesh_textures(std::move(places), materials, is_plain, prepared.mesh->node_count());
            in.check(prepared.textures != nullptr, "places on pictures that fit the mesh");
        }
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
    std::vector<refine::CornerNormals> normals(made.creases ? made.mesh->face_count() : 0);
    for (std::uint32_t face = 0; face < normals.size(); ++face) {
        normals[made.mesh->original_face(face)] = made.creases->corner_normals[face];
    }
    out.put_list(normals);
    if (made.textures) {
        out.put_list(made.textures->first);
        out.put_list(made.textures->places);
        out.put_list(made.chart_materials);
    }
    if (is_textured == (made.textures != nullptr)) { // too many charts are told in each run
        write_cache(cache, out.bytes(), notes);
    }
    made.notes.insert(made.notes.end(), notes.begin(), notes.end());
    return made;
}

RefineMesh read_refine_mesh(const RefineMeshOptions& input) {
    RefineMesh result;
    if (refine::is_progressive_file(input.file)) {
        result.mesh =
            std::make_shared<const refine::ProgressiveMesh>(refine::read_progressive(input.file, input.max_vertices));
        if (result.mesh->face_count() == 0) { throw_error_in(input.file, "expected a mesh with triangles, got none"); }
        result.notes = result.mesh->parts().notes;
        result.has_material_colours = is_all_grey(*result.mesh);
    } else {
        result = make_refine_mesh(input, load_mesh(input.file, {.pictures = true, .backs = true}));
    }
    return result;
}

RefineMesh load_refine_mesh(const RefineMeshOptions& input) {
    RefineMesh result = read_refine_mesh(input);
    for (const std::string& note : result.notes) { base::print_note(input.quiet, "note: " + note); }
    return result;
}

} // namespace octant::ui::world
