#include "models/measure/mesh_defects.h"
#include "models/meshfile/level_chain.h"
#include "models/meshfile/mesh_parts.h"
#include "models/meshfile/texture_store.h"
#include "models/repair/repair.h"
#include "models/smooth_normals.h"
#include "models/triangle_mesh.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/base/json_value.h"
#include "ui/base/progress.h"
#include "ui/command_line/setting_option.h"
#include "ui/commands/commands.h"
#include "ui/report/png_file.h"
#include "ui/settings/setting_rows.h"
#include "ui/world/aircraft_frame.h"
#include "ui/world/mesh_loader.h"
#include "visuals/refine/active_mesh.h"
#include "visuals/refine/progressive_file.h"
#include "visuals/shading/vertex_normals.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::commands {

using namespace command_line;

namespace {

constexpr int samples_a_side = 2; ///< Of a pixel.
constexpr glm::vec3 background_colour(0.93F, 0.94F, 0.96F);

/// The directions on the screen, body axes. `towards` points to the eye.
struct View {
    glm::dvec3 right;
    glm::dvec3 up;
    glm::dvec3 towards;
};

constexpr std::array views{View{{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, View{{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
    View{{0, -1, 0}, {0, 0, -1}, {1, 0, 0}}};

/// Samples of one view, the nearest surface at each.
class Pane {
public:
    Pane(int width, int height)
        : width_(width), height_(height), depths_(cells(), -std::numeric_limits<double>::infinity()),
          colours_(cells(), background_colour) {}

    /// Corners: x and y in samples from the upper left corner, z towards the eye.
    void draw(const std::array<glm::dvec3, 3>& corners, const glm::vec3& colour) {
        const auto [a, b, c] = corners;
        const double area = cross(b - a, c - a);
        if (area == 0.0) { return; }
        const int first_x = clamped(std::min({a.x, b.x, c.x}), width_);
        const int last_x = clamped(std::max({a.x, b.x, c.x}), width_);
        const int first_y = clamped(std::min({a.y, b.y, c.y}), height_);
        const int last_y = clamped(std::max({a.y, b.y, c.y}), height_);
        for (int y = first_y; y <= last_y; ++y) {
            for (int x = first_x; x <= last_x; ++x) {
                const glm::dvec3 p(x + 0.5, y + 0.5, 0.0);
                const double u = cross(c - b, p - b) / area;
                const double v = cross(a - c, p - c) / area;
                const double w = 1.0 - u - v;
                if (u >= 0.0 && v >= 0.0 && w >= 0.0) { put(x, y, u * a.z + v * b.z + w * c.z, colour); }
            }
        }
    }

    /// The mean of a pixel's samples.
    glm::vec3 pixel(int x, int y) const {
        glm::vec3 sum(0.0F);
        for (int j = 0; j < samples_a_side; ++j) {
            for (int i = 0; i < samples_a_side; ++i) {
                sum += colours_[index(x * samples_a_side + i, y * samples_a_side + j)];
            }
        }
        return sum / static_cast<float>(samples_a_side * samples_a_side);
    }

private:
    std::size_t cells() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }

    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }

    static int clamped(double place, int size) {
        return static_cast<int>(std::clamp(std::floor(place), 0.0, size - 1.0));
    }

    static double cross(const glm::dvec3& one, const glm::dvec3& other) { return one.x * other.y - one.y * other.x; }

    void put(int x, int y, double depth, const glm::vec3& colour) {
        if (depth > depths_[index(x, y)]) {
            depths_[index(x, y)] = depth;
            colours_[index(x, y)] = colour;
        }
    }

    int width_;
    int height_;
    std::vector<double> depths_;
    std::vector<glm::vec3> colours_;
};

/// Where a mesh comes to lie in the panes: its middle in theirs, at one scale for all.
struct FittedScale {
    glm::dvec3 middle_m{0.0};
    double samples_per_m = 1.0;
};

FittedScale fitted_scale_of(const models::TriangleMesh& body, double width, double height) {
    constexpr double share = 0.92;
    const models::BoundingBox bounds = models::bounds_of(body);
    const glm::dvec3 extent_m = bounds.max_m - bounds.min_m;
    double scale = std::numeric_limits<double>::infinity();
    for (const View& view : views) {
        const double across_m = std::abs(glm::dot(extent_m, view.right));
        const double up_m = std::abs(glm::dot(extent_m, view.up));
        scale = across_m > 0.0 ? std::min(scale, share * width / across_m) : scale;
        scale = up_m > 0.0 ? std::min(scale, share * height / up_m) : scale;
    }
    return {0.5 * (bounds.min_m + bounds.max_m), std::isfinite(scale) ? scale : 1.0};
}

Pane pane_of(const models::TriangleMesh& body, const View& view, int width, int height) {
    Pane pane(width, height);
    const FittedScale fit = fitted_scale_of(body, width, height);
    for (std::size_t t = 0; t < body.triangles.size(); ++t) {
        std::array<glm::dvec3, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 off_m = body.vertices_m[body.triangles[t][k]] - fit.middle_m;
            corners.at(k) = glm::dvec3(0.5 * width + fit.samples_per_m * glm::dot(off_m, view.right),
                0.5 * height - fit.samples_per_m * glm::dot(off_m, view.up), glm::dot(off_m, view.towards));
        }
        const double facing = glm::dot(models::normal_of(body, body.triangles[t]), view.towards);
        const double light = (facing < 0.0 ? 0.5 : 1.0) * (0.3 + 0.7 * std::abs(facing));
        pane.draw(corners, models::mean_colour(body, t) * static_cast<float>(light));
    }
    return pane;
}

std::byte byte_of(float part) { return static_cast<std::byte>(std::lround(std::clamp(part, 0.0F, 1.0F) * 255.0F)); }

/// Three views of a mesh in body axes, side by side at one scale: from its left, from above (the nose points left in
/// both) and from ahead. Orthographic, in the colours of the mesh, lit from the eye; what is seen from its back is half
/// as bright. Same mesh, same bytes.
report::Picture three_views(const models::TriangleMesh& body, int pane_width_px, int height_px) {
    const int panes = static_cast<int>(views.size());
    report::Picture picture{pane_width_px * panes, height_px, 3, {}};
    picture.bytes.resize(static_cast<std::size_t>(picture.width_px) * static_cast<std::size_t>(height_px) * 3);
    for (int number = 0; number < panes; ++number) {
        const Pane pane = pane_of(body, views.at(static_cast<std::size_t>(number)), pane_width_px * samples_a_side,
            height_px * samples_a_side);
        for (int y = 0; y < height_px; ++y) {
            for (int x = 0; x < pane_width_px; ++x) {
                const glm::vec3 colour = pane.pixel(x, y);
                const int column = number * pane_width_px + x;
                const std::size_t at = 3 * static_cast<std::size_t>(y * picture.width_px + column);
                for (int part = 0; part < 3; ++part) {
                    picture.bytes[at + static_cast<std::size_t>(part)] = byte_of(colour[part]);
                }
            }
        }
    }
    return picture;
}

struct ModelInfoOptions : base::OutputOptions {
    std::string file;
    world::AircraftFrameSettings frame;
    std::string picture;
};

models::meshfile::RotatingModel read_any_model(
    const std::string& file, const std::shared_ptr<models::meshfile::TextureStore>& textures) {
    if (models::meshfile::is_chain_file(file)) {
        return {std::move(models::meshfile::read_chain(file).levels.front().mesh), {}, {}};
    }
    if (visuals::refine::is_progressive_file(file)) {
        return {visuals::refine::finest_mesh(visuals::refine::read_progressive(file)), {}, {}};
    }
    return world::load_rotating_model(file, {.pictures = true, .textures = textures});
}

void turn_into_body(models::TriangleMesh& mesh, const models::polygons::FileAxes& axes) {
    for (glm::dvec3& vertex_m : mesh.vertices_m) { vertex_m = axes.body_from_file(vertex_m); }
}

/// Which unit of length an aircraft was probably modelled in.
std::string scale_in_words(const glm::dvec3& extent_m) {
    const std::string unit = world::likely_unit(std::max({extent_m.x, extent_m.y, extent_m.z}));
    if (unit == "metres") { return unit; }
    return unit.empty() ? "metres as read; no aircraft is so long" : fmt::format("metres as read; likely {}", unit);
}

void add_materials(base::JsonValue& results, const models::TriangleMesh& mesh) {
    std::vector<std::pair<std::string, std::size_t>> lines; // how often each comes
    for (const models::Material& material : mesh.materials) {
        const glm::vec3& colour = material.colour;
        std::string line = fmt::format("{} ({:.2f} {:.2f} {:.2f}{})", printable(material.name), colour.x, colour.y,
            colour.z, material.opacity < 1.0F ? fmt::format(", opacity {:.2f}", material.opacity) : "");
        const auto known = std::ranges::find(lines, line, &std::pair<std::string, std::size_t>::first);
        if (known == lines.end()) {
            lines.emplace_back(std::move(line), 1);
        } else {
            ++known->second;
        }
    }
    results["materials"] = base::JsonValue::list({});
    for (const auto& [line, count] : lines) {
        results["materials"].push_back(count == 1 ? line : fmt::format("{}, {} times", line, count));
    }
    results["vertex_colours"] = !mesh.colours.empty();
}

std::string_view words_of(models::TextureAlpha alpha) {
    return alpha == models::TextureAlpha::Opaque ? "opaque"
           : alpha == models::TextureAlpha::Mask ? "with holes"
                                                 : "clear";
}

/// The pictures that lie on triangles, each with its size and what its alpha does, and the memory that they take.
void add_pictures(
    base::JsonValue& results, const models::TriangleMesh& mesh, const models::meshfile::TextureStore& textures) {
    std::vector<std::string> lines;
    std::vector<std::string> glowing;
    const auto add_once = [](std::vector<std::string>& list, std::string line) {
        if (std::ranges::find(list, line) == list.end()) { list.push_back(std::move(line)); }
    };
    for (const models::Material& material : mesh.materials) {
        if (const auto& picture = material.texture.picture; picture != nullptr) {
            const models::TextureLevel& finest = picture->levels.front();
            add_once(lines,
                fmt::format("{} ({} x {}, {})", printable(std::filesystem::path(material.picture).filename().string()),
                    finest.width, finest.height, words_of(material.texture.alpha)));
        }
        if (!material.emissive_picture.empty()) {
            add_once(glowing, printable(std::filesystem::path(material.emissive_picture).filename().string()));
        }
    }
    results["pictures"] = base::JsonValue::list({});
    for (const std::string& line : lines) { results["pictures"].push_back(line); }
    results["emissive_pictures"] = base::JsonValue::list({});
    for (const std::string& line : glowing) { results["emissive_pictures"].push_back(line); }
    results["picture_bytes"] = textures.bytes();
}

/// Edges of two triangles of a repaired mesh, and those at which it is drawn with two normals.
struct EdgeCounts {
    std::size_t all = 0;
    std::size_t hard = 0;
};

/// With the normals of its file, or those that a mesh without any is flown with.
EdgeCounts count_edges(const models::TriangleMesh& mesh) {
    constexpr double same_normal_rad = 0.02;
    const std::vector<glm::vec3> made =
        mesh.corner_normals.empty() ? visuals::shading::corner_normals(mesh) : std::vector<glm::vec3>();
    const auto normal_at = [&](std::size_t triangle, std::size_t corner) -> glm::dvec3 {
        if (!made.empty()) { return glm::dvec3(made[3 * triangle + corner]); }
        const std::uint32_t normal = mesh.corner_normals[triangle][corner];
        return normal == models::invalid_index ? models::normal_of(mesh, mesh.triangles[triangle])
                                               : glm::dvec3(mesh.normals[normal]);
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<glm::dvec3, glm::dvec3>> open;
    EdgeCounts counts;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            auto edge = std::pair(mesh.triangles[t][k], mesh.triangles[t][next]);
            auto normals = std::pair(normal_at(t, k), normal_at(t, next));
            if (edge.first > edge.second) {
                std::swap(edge.first, edge.second);
                std::swap(normals.first, normals.second);
            }
            const auto [other, is_first] = open.try_emplace(edge, normals);
            if (is_first) { continue; }
            ++counts.all;
            const auto& [one, two] = other->second;
            if (models::angle_rad(one, normals.first) > same_normal_rad ||
                models::angle_rad(two, normals.second) > same_normal_rad) {
                ++counts.hard;
            }
            open.erase(other);
        }
    }
    return counts;
}

/// What turns and moves in flight, and what is seen through.
void add_parts(base::JsonValue& results, const models::meshfile::RotatingModel& model) {
    results["turning_parts"] =
        std::ranges::count_if(model.parts, [](const auto& part) { return part.about.turns_per_s != 0.0; });
    results["moving_parts"] = std::ranges::count_if(model.parts, [](const auto& part) { return !part.moves.empty(); });
    results["glass_faces"] = model.clear.triangles.size();
    results["glass_panes"] = models::measure::defects(models::repair::repaired(model.clear).mesh).shells;
}

void add_surface(base::JsonValue& results, const models::TriangleMesh& mesh) {
    const std::size_t read = mesh.triangles.size();
    const models::repair::RepairedMesh repaired = models::repair::repaired(mesh);
    const models::measure::MeshDefects found = models::measure::defects(repaired.mesh);
    results["faces"] = read;
    results["vertices"] = mesh.vertices_m.size();
    results["shells"] = found.shells;
    results["closed"] = found.boundary_edges == 0;
    const EdgeCounts edges = count_edges(repaired.mesh);
    results["edges"] = edges.all;
    results["hard_edges"] = edges.hard;
    results["normals"] = mesh.corner_normals.empty() ? "by crease angle" : "of the file";
    results["defects"] = models::repair::describe_counts(repaired.counts);
}

void show_model_info(const ModelInfoOptions& options) {
    world::check_axes(options.frame.axes);
    if (!options.picture.empty()) { check_can_write(options.picture); }
    const auto textures = std::make_shared<models::meshfile::TextureStore>();
    models::meshfile::RotatingModel model = read_any_model(options.file, textures);
    base::JsonValue results;
    results["file"] = options.file;
    add_parts(results, model);
    models::TriangleMesh mesh = models::meshfile::mesh_at_rest(std::move(model));
    const world::AircraftAxes axes = world::aircraft_axes(options.frame.axes, options.file, mesh);
    world::scale_mesh(mesh, options.frame.scale);
    turn_into_body(mesh, axes.axes);
    const models::BoundingBox bounds = models::bounds_of(mesh);
    const glm::dvec3 extent_m = bounds.max_m - bounds.min_m;
    results["length_m"] = extent_m.x;
    results["span_m"] = extent_m.y;
    results["height_m"] = extent_m.z;
    results["scale"] = scale_in_words(extent_m);
    results["axes"] = axes.axes.text();
    results["axes_are"] = world::axes_text(axes);
    add_surface(results, mesh);
    add_materials(results, mesh);
    add_pictures(results, mesh, *textures);
    for (const std::string& note : textures->notes()) { mesh.notes.push_back(note); }
    for (const auto& note :
        {world::axes_note(axes, options.file), world::size_note(extent_m, options.frame.scale, options.file)}) {
        if (note) { mesh.notes.push_back(*note); }
    }
    results["notes"] = base::JsonValue::list({});
    for (const std::string& note : mesh.notes) { results["notes"].push_back(note); }
    for (const std::string& note : mesh.notes) { base::print_note(options.quiet, "note: " + note); }
    if (!options.picture.empty()) {
        constexpr int pane_px = 400;
        constexpr int height_px = 320;
        report::write_png(options.picture, three_views(mesh, pane_px, height_px).view());
        results["picture"] = options.picture;
    }
    base::print_value(results, options.json);
}

Command model_info_command() {
    auto options = std::make_shared<ModelInfoOptions>();
    return {.name = "info",
        .summary = "Shows size, axes, surface defects and materials of a mesh, and draws three views of it",
        .options = with_output_options(
            *options, {required(text_option("file", "FILE",
                           "a mesh (.obj, .ply, .stl, .gltf, .glb, .ac, .wrl, .dnm, .srf, .xml, .acf, .chain, .pm) or "
                           "a built-in name",
                           options->file)),
                          text_option("--picture", "OUT.png",
                              "write a picture with views from the left, above and ahead; the nose points left",
                              options->picture),
                          text_option("--axes", "X,Y,Z|auto",
                              "directions of the file's x, y and z axes: right, left, up, down, forward, back",
                              options->frame.axes),
                          value_option(settings::aircraft_scale_info, options->frame.scale)}),
        .footer =
            "Keys: file, turning_parts, moving_parts, glass_faces, glass_panes, length_m, span_m, height_m, scale, "
            "axes, axes_are, faces and "
            "vertices as read,\n  shells, closed, edges, hard_edges and defects as repaired, normals (of the file or "
            "by crease "
            "angle),\n  materials (red green blue, opacity where they are clear) and how often, "
            "vertex_colours,\n  pictures that lie on it, emissive_pictures, picture_bytes in memory with mip levels, "
            "notes, picture.\n"
            "Example:\n  octant model info f15 --picture f15.png",
        .run = [options] { show_model_info(*options); }};
}

} // namespace

Command model_command() {
    return {.name = "model",
        .summary = "Inspects aircraft and mesh files",
        .footer = "Example:\n  octant model info f15 --picture f15.png",
        .commands = {model_info_command()}};
}

} // namespace octant::ui::commands
