#include "plan_painter.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace octant::tests {

namespace planning = visuals::planning;
namespace scene = visuals::scene;

namespace {

constexpr double missed = std::numeric_limits<double>::infinity();
constexpr double doubt = 1e-5; ///< sine of the angle to an edge under which rounding may decide

/// Which side of the plane through the eye and two points a ray runs on.
double side(const glm::dvec3& ray, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 normal = glm::cross(a, b);
    const double size = glm::length(normal) * glm::length(ray);
    return size > 0.0 ? glm::dot(normal, ray) / size : 0.0;
}

/// The index of the first corner of each triangle.
std::vector<std::size_t> first_corners(std::span<const scene::IndexRange> ranges) {
    std::vector<std::size_t> first;
    for (const scene::IndexRange& range : ranges) {
        for (std::uint32_t i = 0; i < range.index_count; i += 3) {
            first.push_back(std::size_t{range.first_index} + i);
        }
    }
    return first;
}

} // namespace

PlanPainter::PlanPainter(const scene::FramePlan& plan, const planning::Scene& scene) {
    const auto ground_triangle = [&](std::span<const std::uint32_t> indices, std::size_t first) {
        std::array<glm::dvec3, 3> at;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::size_t vertex = indices[first + corner];
            const std::size_t own = plan.ground.vertices.size();
            at[corner] = glm::dvec3(
                vertex < own ? plan.ground.vertices[vertex].position_m : plan.shadow_vertices[vertex - own].position_m);
        }
        return Triangle{at[0], at[1], at[2]};
    };
    for (const scene::PaintStep& step : plan.steps) {
        if (step.content == scene::PaintStep::Content::Aircraft) {
            add_aircraft(plan, scene, step);
            continue;
        }
        const bool again = step.content == scene::PaintStep::Content::GroundRepaint;
        if (!again && step.content != scene::PaintStep::Content::Ground) { continue; }
        const std::span indices = again ? std::span(plan.repaint_indices) : plan.ground.indices;
        for (std::size_t i = step.first; i < step.first + step.count; i += 3) {
            Triangle triangle = ground_triangle(indices, i);
            triangle.clip = step.clip == scene::PaintStep::no_clip ? nullptr : &plan.clips[step.clip];
            triangle.again = again;
            triangles_.push_back(triangle);
        }
    }
}

void PlanPainter::add_aircraft(
    const scene::FramePlan& plan, const planning::Scene& scene, const scene::PaintStep& step) {
    for (std::size_t d = step.first; d < step.first + step.count; ++d) {
        const scene::AircraftDraw& draw = plan.aircraft[d];
        const scene::ModelBuffers& buffers = scene.models[draw.model]->buffers;
        const scene::IndexRange only{draw.first_index, draw.index_count};
        for (const std::size_t i : first_corners(draw.ranges.empty() ? std::span(&only, 1) : draw.ranges)) {
            const auto corner = [&](std::size_t k) {
                const scene::ModelVertex& vertex = buffers.vertices[buffers.indices[i + k]];
                const glm::dmat4 part(plan.parts[draw.first_part + vertex.part]);
                return glm::dvec3(part * glm::dvec4(glm::dvec3(vertex.position_m), 1.0));
            };
            const scene::Clip* clip = step.clip == scene::PaintStep::no_clip ? nullptr : &plan.clips[step.clip];
            triangles_.push_back({corner(0), corner(1), corner(2), clip, clip != nullptr});
        }
    }
}

std::optional<Sight> PlanPainter::look(const glm::dvec3& ray) const {
    Sight sight{missed, missed};
    for (const Triangle& t : triangles_) {
        const glm::dvec3 normal = glm::cross(t.b - t.a, t.c - t.a);
        const double height = glm::dot(normal, t.a);
        const double slope = glm::dot(normal, ray);
        if (height >= 0.0 || slope >= 0.0) {
            continue; // faces away, or lies behind the eye
        }
        // Seen from the front corners turn counter-clockwise: all sides positive inside.
        const double inside = -std::max({side(ray, t.a, t.b), side(ray, t.b, t.c), side(ray, t.c, t.a)});
        if (inside < -doubt) { continue; }
        double clipped = missed;
        for (int i = 0; t.clip != nullptr && i < t.clip->count; ++i) {
            const glm::dvec4 plane(t.clip->planes[static_cast<std::size_t>(i)]);
            const double at =
                (glm::dot(glm::dvec3(plane), ray) * height / slope + plane.w) / (glm::length(ray) * height / slope);
            clipped = std::min(clipped, at);
        }
        if (clipped < -doubt) { continue; }
        if (inside < doubt || clipped < doubt) { return std::nullopt; }
        const double at = height / slope;
        sight.painted_m = at;
        sight.nearest_m = t.again ? sight.nearest_m : std::min(sight.nearest_m, at);
    }
    return sight;
}

SightCount count_wrong_sights(const scene::FramePlan& plan, const planning::Scene& scene,
    const std::vector<sim::AircraftState>& states, const scene::Camera& camera, PlaceDice& dice) {
    const PlanPainter painter(plan, scene);
    const auto frustum = scene::frustum_normals(camera, 4.0 / 3.0);
    SightCount count;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const double radius_m = scene.model_of(i).subject.radius_m;
        for (int k = 0; k < 150; ++k) {
            const glm::dvec3 target_m = states[i].position_m - camera.eye_m + dice.in_box(glm::dvec3(radius_m));
            if (!scene::in_view(target_m, 0.0, frustum)) { continue; }
            const std::optional<Sight> sight = painter.look(glm::normalize(target_m));
            if (!sight || sight->nearest_m == missed) { continue; }
            ++count.seen;
            count.wrong += sight->painted_m > sight->nearest_m * (1.0 + 1e-4) + 1e-4 ? 1 : 0;
        }
    }
    return count;
}

} // namespace octant::tests
