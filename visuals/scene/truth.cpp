#include "visuals/scene/truth.h"

#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace octant::visuals::scene {

namespace {

/// Ground counts as water no more than this above the level: rounding of heights that are small differences.
constexpr float water_tolerance_m = 0.05F;
/// Rise of ground over its width above which it is no water, as that of the picture's colours.
constexpr float max_water_slope = 0.0142F;

std::array<glm::vec3, 3> corners_of(const TriangleDraw& draw, const std::uint32_t* corners) {
    return {draw.vertices[corners[0]].position_m, draw.vertices[corners[1]].position_m,
        draw.vertices[corners[2]].position_m};
}

} // namespace

bool is_water(const WaterSurface& water, const std::array<glm::vec3, 3>& corners_m) {
    if (!water.height_m) { return false; }
    const float sinks_per_m2 = water.earth_radius_m > 0.0F ? 0.5F / water.earth_radius_m : 0.0F;
    std::array<float, 3> above_m{};
    int at_level = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec3& at_m = corners_m[i];
        above_m[i] = at_m.z + (at_m.x * at_m.x + at_m.y * at_m.y) * sinks_per_m2 - *water.height_m;
        at_level += above_m[i] <= water_tolerance_m ? 1 : 0;
    }
    if (at_level < 2) { return false; }
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = i < 2 ? i + 1 : 0;
        const glm::vec2 across_m = glm::vec2(corners_m[next]) - glm::vec2(corners_m[i]);
        const float rise_m = std::abs(above_m[next] - above_m[i]);
        if (rise_m > water_tolerance_m + max_water_slope * std::hypot(across_m.x, across_m.y)) { return false; }
    }
    return true;
}

SurfaceClass surface_of(const TriangleDraw& ground, const WaterSurface& water, const std::uint32_t* corners) {
    const auto after = std::ranges::upper_bound(ground.standing, corners[0], {}, &models::VertexRun::first);
    if (after != ground.standing.begin() && corners[0] < (after - 1)->end) { return (after - 1)->surface; }
    return is_water(water, corners_of(ground, corners)) ? SurfaceClass::Water : SurfaceClass::Terrain;
}

SurfaceClass ground_surface(const FramePlan& plan, const std::uint32_t* corners) {
    const std::size_t own = plan.ground.vertices.size();
    if (corners[0] < own) { return surface_of(plan.ground, plan.truth.water, corners); }
    const std::size_t piece = corners[0] - own;
    return piece < plan.truth.piece_surfaces.size() ? plan.truth.piece_surfaces[piece] : SurfaceClass::Terrain;
}

SurfaceClass sky_surface(const FramePlan& plan, const std::uint32_t* corners) {
    if (corners[0] < plan.truth.first_land_vertex) { return SurfaceClass::Sky; }
    if (!plan.truth.land_has_cover_codes) {
        return is_water(plan.truth.water, corners_of(plan.sky, corners)) ? SurfaceClass::Water : SurfaceClass::Terrain;
    }
    const auto wet =
        std::count_if(corners, corners + 3, [&](std::uint32_t i) { return plan.sky.vertices[i].colour >> 24U == 0; });
    return wet >= 2 ? SurfaceClass::Water : SurfaceClass::Terrain;
}

namespace {

/// Visits triangles of an aircraft or of a refined mesh.
void visit_mesh(std::span<const ModelVertex> vertices, std::span<const std::uint32_t> indices,
    std::span<const glm::mat4> parts, std::uint32_t object, const std::function<void(const SurfaceTriangle&)>& visit) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        SurfaceTriangle triangle{{}, SurfaceClass::Aircraft, object};
        for (std::size_t k = 0; k < 3; ++k) {
            const ModelVertex& vertex = vertices[indices[i + k]];
            triangle.corners_m[k] =
                glm::dvec3(glm::dmat4(parts[vertex.part]) * glm::dvec4(glm::dvec3(vertex.position_m), 1.0));
        }
        visit(triangle);
    }
}

} // namespace

void for_each_surface_triangle(const FramePlan& plan, std::span<const ModelBuffers> models,
    const std::function<void(const SurfaceTriangle&)>& visit) {
    const std::size_t own = plan.ground.vertices.size();
    const auto visit_ground = [&](std::span<const std::uint32_t> indices) {
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            SurfaceTriangle triangle{{}, ground_surface(plan, &indices[i]), 0};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t at = indices[i + k];
                triangle.corners_m[k] = glm::dvec3(
                    at < own ? plan.ground.vertices[at].position_m : plan.shadow_vertices[at - own].position_m);
            }
            visit(triangle);
        }
    };
    const auto visit_aircraft = [&](const AircraftDraw& draw) {
        const ModelBuffers& model = models[draw.model];
        const std::span<const std::uint32_t> all(model.indices);
        const auto parts = std::span(plan.parts).subspan(draw.first_part);
        if (draw.ranges.empty()) {
            visit_mesh(model.vertices, all.subspan(draw.first_index, draw.index_count), parts, draw.object, visit);
        }
        for (const IndexRange& range : draw.ranges) {
            visit_mesh(model.vertices, all.subspan(range.first_index, range.index_count), parts, draw.object, visit);
        }
    };
    for (const PaintStep& step : plan.steps) {
        if (step.clip != PaintStep::no_clip || step.depth == DepthUse::DepthOnly) { continue; }
        switch (step.content) {
        case PaintStep::Content::ClearDepth:
        case PaintStep::Content::Transparent:
        case PaintStep::Content::Overlay:
            break;
        case PaintStep::Content::Sky: {
            const auto indices = plan.sky.indices.subspan(step.first, step.count);
            for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
                const SurfaceClass surface = sky_surface(plan, &indices[i]);
                if (surface == SurfaceClass::Sky) { continue; }
                const auto [a, b, c] = corners_of(plan.sky, &indices[i]);
                visit({{glm::dvec3(a), glm::dvec3(b), glm::dvec3(c)}, surface, 0});
            }
            break;
        }
        case PaintStep::Content::Ground:
            visit_ground(plan.ground.indices.subspan(step.first, step.count));
            break;
        case PaintStep::Content::GroundRepaint:
            visit_ground(std::span(plan.repaint_indices).subspan(step.first, step.count));
            break;
        case PaintStep::Content::Aircraft:
            for (std::uint32_t i = step.first; i < step.first + step.count; ++i) { visit_aircraft(plan.aircraft[i]); }
            break;
        case PaintStep::Content::Refined:
            for (std::uint32_t i = step.first; i < step.first + step.count; ++i) {
                const RefinedDraw& draw = plan.refined[i];
                visit_mesh(
                    draw.vertices, draw.indices, std::span(plan.parts).subspan(draw.first_part), draw.object, visit);
            }
            break;
        }
    }
}

} // namespace octant::visuals::scene
