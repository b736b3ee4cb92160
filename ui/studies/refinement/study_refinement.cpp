#include "ui/studies/refinement/study_refinement.h"

#include "models/procedural/procedural_terrain.h"
#include "models/simplify/simplify.h"
#include "ui/base/progress.h"
#include "ui/studies/refinement/refinement_tables.h"
#include "ui/studies/shading_pictures.h"
#include "ui/studies/study.h"
#include "ui/world/mesh_loader.h"
#include "visuals/refine/active_mesh.h"
#include "visuals/refine/refine_criterion.h"
#include "visuals/shading/vertex_normals.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <string>
#include <utility>

namespace octant::ui::studies::refinement {

namespace {

namespace refine = visuals::refine;
namespace shading = visuals::shading;

constexpr int size_px = 480;
constexpr auto background = std::byte{255};

/// Axes of ShadingPictures: x forward, y right, z down.
models::TriangleMesh in_body_axes(models::TriangleMesh mesh, bool y_up) {
    for (glm::dvec3& point_m : mesh.vertices_m) {
        point_m = y_up ? glm::dvec3(point_m.x, point_m.z, -point_m.y) : glm::dvec3(point_m.x, -point_m.y, -point_m.z);
    }
    mesh.normals.clear();
    mesh.corner_normals.clear();
    mesh.materials.clear();
    mesh.triangle_materials.clear();
    if (mesh.colours.empty()) { mesh.colours.assign(mesh.vertices_m.size(), glm::vec3(0.6F)); }
    return mesh;
}

/// Flat faces from the right, a little from the front and above. Light is worked out for red, green and blue in turn.
report::Picture picture_of(const models::TriangleMesh& original, bool y_up) {
    const models::TriangleMesh mesh = in_body_axes(original, y_up);
    shading::ShadingLight light;
    light.to_light = glm::normalize(glm::vec3(0.5F, 0.6F, -0.7F));
    light.ambient = 0.35F;
    light.diffuse = 0.65F;
    light.specular = 0.0F;
    const std::vector<glm::vec3> normals = shading::corner_normals(mesh);
    report::Picture picture{size_px, size_px, 3, {}};
    picture.bytes.assign(std::size_t{3} * size_px * size_px, background);
    for (int part = 0; part < 3; ++part) {
        models::TriangleMesh tinted = mesh;
        for (glm::vec3& colour : tinted.colours) { colour = glm::vec3(colour[part], 0.0F, 0.0F); }
        const shading::ShadedPolygons polygons = shading::shaded_polygons(tinted, normals);
        const glm::dvec3 eye_m = glm::dvec3(polygons.centre_m) + 3.0 * static_cast<double>(polygons.radius_m) *
                                                                     glm::normalize(glm::dvec3(0.35, 1.0, -0.3));
        const ShadingPictures pictures(polygons, light, eye_m, size_px);
        const LightPicture seen = pictures.hybrid(std::vector<std::uint8_t>(polygons.size(), 0));
        for (std::size_t at = 0; at < seen.light.size(); ++at) {
            if (pictures.covered()[at] != 0) {
                const float shown = glm::clamp(seen.light[at], 0.0F, 1.0F);
                picture.bytes[3 * at + static_cast<std::size_t>(part)] =
                    static_cast<std::byte>(std::lround(255.0F * shown));
            }
        }
    }
    return picture;
}

/// About the original vertex that lies nearest to three quarters of the way to the front and below the middle.
refine::Sphere chest_of(const models::TriangleMesh& original, bool y_up) {
    const models::BoundingBox bounds = models::bounds_of(original);
    const glm::dvec3 share = y_up ? glm::dvec3(0.72, 0.42, 0.8) : glm::dvec3(0.72, 0.2, 0.42);
    const glm::dvec3 wanted_m = glm::mix(bounds.min_m, bounds.max_m, share);
    const auto nearest = std::ranges::min_element(
        original.vertices_m, {}, [&](const auto& at_m) { return glm::distance(at_m, wanted_m); });
    return {*nearest, 0.12 * models::diagonal_m(original)};
}

/// The paper's figure of what refinement means: a model, its base mesh, the parts of the model that the base mesh's
/// vertices stand for, and the base mesh with one part (a cow's chest: front, low) refined all the way. `y_up`: else z
/// is. The model is seen from its right, its front is at +x. Throws Error.
void add_pictures(Study& study, const RefinedModel& model, bool y_up) {
    refine::SelectiveRefiner front(model);
    const auto add = [&](const char* name, const models::TriangleMesh& mesh, const std::string& what) {
        study.add(fmt::format("refinement-{}.png", name), picture_of(mesh, y_up).view(),
            fmt::format("{}: {}", model->parts().name, what));
    };
    const models::TriangleMesh original = refine::partition_mesh(front, refine::ColourBy::Nothing);
    add("original", original, fmt::format("{} vertices", model->leaf_count()));
    models::TriangleMesh base = refine::active_mesh(front).mesh;
    base.colours.clear();
    add("base", base, fmt::format("its base mesh of {} vertices", model->roots().size()));
    add("partition", refine::partition_mesh(front), "the parts that these stand for");
    const refine::Sphere chest = chest_of(original, y_up);
    refine::refine_regions(front, std::span(&chest, 1));
    front.repair();
    add("region", refine::coloured_mesh(refine::active_mesh(front), refine::ColourBy::Level),
        fmt::format("one part refined, {} vertices (blue: original ones)", front.active_count()));
}

/// Two triangles between four samples each.
models::TriangleMesh mesh_of(const models::heights::HeightField& field) {
    models::TriangleMesh mesh;
    mesh.name = field.name;
    const auto columns = static_cast<std::uint32_t>(field.columns());
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            mesh.vertices_m.push_back(field.sample_m(column, row));
            if (row + 1 < field.rows() && column + 1 < field.columns()) {
                const auto at = static_cast<std::uint32_t>(mesh.vertices_m.size() - 1);
                mesh.triangles.push_back({at, at + 1, at + columns + 1});
                mesh.triangles.push_back({at, at + columns + 1, at + columns});
            }
        }
    }
    return mesh;
}

RefinedModel made_ground(int base) {
    models::procedural::ProceduralTerrainOptions made;
    made.size = 129;
    models::TriangleMesh mesh = mesh_of(models::procedural::procedural_hills(made));
    mesh.name = "hills";
    models::simplify::SimplifyOptions options;
    options.length_share = 0.03;
    options.goal.vertices = static_cast<std::size_t>(base);
    return std::make_shared<const refine::ProgressiveMesh>(models::simplify::fast_sequence(std::move(mesh), options));
}

std::vector<RefinedModel> read_models(const RefinementStudyOptions& options) {
    std::vector<RefinedModel> models;
    for (const std::string& file : options.meshes) {
        world::RefineMeshOptions input;
        input.file = file;
        input.base = static_cast<std::size_t>(options.base);
        input.quiet = options.quiet;
        models.push_back(world::load_refine_mesh(input).mesh);
    }
    if (models.empty()) { models.push_back(made_ground(options.base)); }
    return models;
}

} // namespace

void study_refinement(const RefinementStudyOptions& options) {
    const std::vector<RefinedModel> models = read_models(options);
    Study study(options);
    const auto add = [&](const char* file, report::ResultTable table) {
        study.add(file, std::move(table));
        base::print_note(options.quiet, fmt::format("done: {}", file));
    };
    add("forced-splits", forced_splits_table(models));
    add("refinement-path", refinement_path_table(models, options.frames));
    add("refinement-speed", refinement_speed_table(models));
    add_pictures(study, models.back(), !options.meshes.empty()); // The made ground has z up, mesh files y.
    study.finish("refinement");
}

} // namespace octant::ui::studies::refinement
