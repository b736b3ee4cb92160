#include "ui/chain_maker.h"

#include "models/measure/mesh_distance.h"

#include <algorithm>
#include <array>
#include <utility>

namespace octant::ui {

namespace {

using models::PolygonModel;
using models::Triangle;
using models::TriangleMesh;

constexpr std::size_t most_polygons = 300; ///< that draw orders are found for quickly

PolygonModel polygons_of(const TriangleMesh& mesh, const models::FileAxes& axes) {
    PolygonModel model;
    model.name = mesh.name;
    for (const glm::dvec3& vertex_m : mesh.vertices_m) {
        model.vertices_m.push_back(axes.body_from_file(vertex_m));
    }
    model.materials = mesh.materials;
    if (model.materials.empty()) {
        model.materials.push_back({.name = "default"});
    }
    model.parts = {"default"};
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        models::Polygon polygon;
        polygon.first_corner = static_cast<std::uint32_t>(model.corner_vertices.size());
        polygon.corner_count = 3;
        polygon.material = mesh.triangle_materials.empty() ? 0 : mesh.triangle_materials[t];
        const Triangle& corners = mesh.triangles[t];
        model.corner_vertices.insert(model.corner_vertices.end(), corners.begin(), corners.end());
        model.polygons.push_back(polygon);
    }
    return model;
}

/// Convex polygons cut into fans, in the axes of the file.
TriangleMesh triangles_of(const PolygonModel& model, const models::FileAxes& axes) {
    TriangleMesh mesh;
    for (const glm::dvec3& vertex_m : model.vertices_m) {
        mesh.vertices_m.push_back(axes.file_from_body(vertex_m));
    }
    for (std::size_t i = 0; i < model.polygons.size(); ++i) {
        const auto corners = model.corners(i);
        for (std::size_t c = 2; c < corners.size(); ++c) {
            mesh.triangles.push_back({corners[0], corners[c - 1], corners[c]});
        }
    }
    return mesh;
}

double certified_m(const TriangleMesh& original, const TriangleMesh& mesh, int threads) {
    return models::measure::distance(
               original,
               mesh,
               {.negligible_m = 1e-6 * models::diagonal_m(original),
                .samples = 0,
                .threads = threads})
        .most_hausdorff_m();
}

std::vector<std::size_t> face_goals(std::size_t faces, std::size_t coarsest) {
    std::vector<std::size_t> goals;
    for (std::size_t goal = faces / 2; goal > coarsest; goal /= 2) {
        goals.push_back(goal);
    }
    if (coarsest < faces) {
        goals.push_back(coarsest);
    }
    return goals;
}

} // namespace

models::meshfile::LevelChain level_chain(TriangleMesh mesh, const ChainOptions& options) {
    constexpr double larger = 1.0 + 1e-9; // errors of a chain rise from level to level
    models::simplify::SimplifyOptions simplify = options.simplify;
    simplify.goal = {.vertices = {}, .faces = options.coarsest_faces, .error_m = {}};
    const std::vector<std::size_t> goals =
        face_goals(mesh.triangles.size(), options.coarsest_faces);
    const models::simplify::Simplified coarsest =
        models::simplify::simplified(std::move(mesh), simplify);
    const models::CollapseSequence& sequence = coarsest.sequence;
    const TriangleMesh& original = sequence.original;
    models::meshfile::LevelChain chain;
    chain.name = original.name;
    chain.levels.push_back({original, 0.0});
    for (const std::size_t goal : goals) {
        const std::size_t collapses = models::collapses_to_faces(sequence, goal);
        TriangleMesh level = collapses == sequence.collapses.size()
                                 ? coarsest.mesh
                                 : models::simplify::polished(
                                       models::mesh_after(sequence, collapses), original, simplify);
        if (level.triangles.size() < chain.levels.back().mesh.triangles.size()) {
            const double before_m = chain.levels.back().error_m;
            const double error_m = certified_m(original, level, simplify.threads);
            const double least_m =
                std::max(before_m * larger, 1e-12 * models::diagonal_m(original));
            chain.levels.push_back({std::move(level), std::max(error_m, least_m)});
        }
        if (options.show_level) {
            options.show_level(chain.levels.size() - 1, goals.size());
        }
    }
    const TriangleMesh& last = chain.levels.back().mesh;
    chain.polygons = options.polygons;
    if (!chain.polygons && last.triangles.size() <= most_polygons) {
        chain.polygons = polygons_of(last, options.axes);
    }
    if (chain.polygons) {
        chain.polygons_error_m =
            options.polygons
                ? certified_m(
                      original, triangles_of(*chain.polygons, options.axes), simplify.threads)
                : chain.levels.back().error_m;
    }
    return chain;
}

} // namespace octant::ui
