#include "ui/studies/hybrid_shading/shading_models.h"

#include "models/procedural/background60.h"
#include "models/polygons/obj_reader.h"
#include "sim/base/units.h"
#include "ui/base/data_files.h"
#include "ui/world/refine_mesh.h"
#include "visuals/refine/active_mesh.h"
#include "visuals/refine/view_refiner.h"
#include "visuals/shading/vertex_normals.h"

#include <glm/geometric.hpp>

#include <cassert>
#include <cmath>
#include <memory>
#include <utility>

namespace octant::ui::studies::hybrid_shading {

namespace {

namespace refine = visuals::refine;
namespace shading = visuals::shading;

/// The angle between the torus' quads along the inner side is more than the usual crease.
constexpr double round_crease_rad = rad_from_deg(60.0);

ShadedModel
shaded_model(std::string name, const auto& model, double crease_rad = shading::default_crease_rad) {
    return {
        std::move(name),
        shading::shaded_polygons(model, shading::corner_normals(model, crease_rad))};
}

/// Each polygon as the fan of its first corner.
models::TriangleMesh triangles_of(const models::polygons::PolygonModel& model) {
    models::TriangleMesh mesh;
    mesh.vertices_m = model.vertices_m;
    mesh.materials = model.materials;
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const auto corners = model.corners(i);
        for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
            mesh.triangles.push_back({corners[0], corners[k], corners[k + 1]});
            mesh.triangle_materials.push_back(model.polygons[i].material);
        }
    }
    return mesh;
}

/// Bunches numbers from 0 to 1 together around 0.
double concentrated(double part) {
    return 0.12 * part + 0.88 * part * part;
}

glm::dvec3 ball_point(double polar_rad, double azimuth_rad) {
    const glm::dvec3 unit{
        std::sin(polar_rad) * std::cos(azimuth_rad),
        std::sin(polar_rad) * std::sin(azimuth_rad),
        std::cos(polar_rad)};
    const double dents = std::sin(4.0 * unit.x + 1.0) * std::sin(5.0 * unit.y) +
                         0.5 * std::sin(9.0 * unit.z + 2.0 * unit.x);
    return (1.0 + 0.12 * dents) * unit;
}

/// As fine as an eye three radii from its middle, to its side and above, needs it in a picture of
/// 720 rows.
models::TriangleMesh refined_mesh(const std::shared_ptr<const refine::ProgressiveMesh>& hierarchy) {
    const double radius_m = hierarchy->half_diagonal_m();
    refine::RefineView view;
    view.eye_m = hierarchy->middle_m() + radius_m * glm::dvec3(1.8, 1.2, 2.1);
    view.forward = glm::normalize(hierarchy->middle_m() - view.eye_m);
    view.focal_px = 870.0;
    refine::ViewRefiner refiner(hierarchy);
    refiner.refine_fully(view);
    return refine::active_mesh(refiner.front()).mesh;
}

} // namespace

models::TriangleMesh uneven_ball(int rings, int slices) {
    assert(rings >= 2 && slices >= 3);
    models::TriangleMesh mesh;
    mesh.name = "uneven ball";
    const auto across = static_cast<std::uint32_t>(slices);
    mesh.vertices_m.push_back(ball_point(0.0, 0.0));
    for (int ring = 1; ring < rings; ++ring) {
        const double polar_rad = pi * concentrated(static_cast<double>(ring) / rings);
        for (int slice = 0; slice < slices; ++slice) {
            mesh.vertices_m.push_back(
                ball_point(polar_rad, 2.0 * pi * concentrated(static_cast<double>(slice) / slices)));
        }
    }
    mesh.vertices_m.push_back(ball_point(pi, 0.0));
    const auto last = static_cast<std::uint32_t>(mesh.vertices_m.size() - 1);
    for (std::uint32_t slice = 0; slice < across; ++slice) {
        const std::uint32_t next = (slice + 1) % across;
        mesh.triangles.push_back({0, 1 + slice, 1 + next});
        for (std::uint32_t first = 1; first + across < last; first += across) {
            const std::uint32_t below = first + across;
            mesh.triangles.push_back({first + slice, below + slice, below + next});
            mesh.triangles.push_back({first + slice, below + next, first + next});
        }
        mesh.triangles.push_back({last, last - across + next, last - across + slice});
    }
    return mesh;
}

std::vector<ShadedModel> shading_models(const std::vector<std::filesystem::path>& more) {
    std::vector<ShadedModel> all;
    all.push_back(shaded_model(
        "torus of 416 triangles", triangles_of(models::procedural::torus(26, 8)), round_crease_rad));
    all.push_back(shaded_model("torus of 416 quads", models::procedural::torus(), round_crease_rad));
    for (const char* aircraft : {"f15", "500md"}) {
        all.push_back(shaded_model(aircraft, models::polygons::read_obj(base::aircraft_file(aircraft))));
    }
    all.push_back(shaded_model("uneven ball", uneven_ball(48, 97), round_crease_rad));
    for (const std::filesystem::path& file : more) {
        const auto hierarchy =
            world::read_refine_mesh({.file = file.string(), .base = 0, .quiet = true}).mesh;
        refine::SelectiveRefiner whole(hierarchy);
        for (std::uint32_t node = 0; node < hierarchy->node_count(); ++node) {
            if (!hierarchy->is_leaf(node)) {
                whole.split(node);
            }
        }
        const std::string name = file.stem().string();
        all.push_back(shaded_model(name, refine::active_mesh(whole).mesh, round_crease_rad));
        all.push_back(shaded_model(name + " refined", refined_mesh(hierarchy), round_crease_rad));
    }
    return all;
}

} // namespace octant::ui::studies::hybrid_shading
