#include "ui/library/scene_file.h"

#include "visuals/scene/truth.h"

#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <octant/octant.h>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::library {

namespace scene = visuals::scene;

std::string obj_of(const scene::FramePlan& plan, const visuals::planning::Scene& drawn, const glm::dvec3& eye_m) {
    std::vector<scene::ModelBuffers> models;
    for (const auto& model : drawn.models) { models.push_back(model->buffers); }
    // By class and object, each group's triangles in the plan's order.
    std::map<std::pair<int, std::uint32_t>, std::vector<scene::SurfaceTriangle>> groups;
    scene::for_each_surface_triangle(plan, models, [&](const scene::SurfaceTriangle& triangle) {
        groups[{static_cast<int>(triangle.surface), triangle.object}].push_back(triangle);
    });
    std::string obj = fmt::format(
        "# Octant, as drawn from {:.6f} {:.6f} {:.6f}; x east, y north, z up, metres\n", eye_m.x, eye_m.y, eye_m.z);
    std::size_t vertices = 0;
    for (const auto& [key, triangles] : groups) {
        const std::string_view surface = name_of(static_cast<SurfaceClass>(key.first));
        fmt::format_to(std::back_inserter(obj), "g {}\n",
            key.second == 0 ? std::string(surface) : fmt::format("{}-{}", surface, key.second));
        for (const scene::SurfaceTriangle& triangle : triangles) {
            for (const glm::dvec3& corner_m : triangle.corners_m) {
                const glm::dvec3 at_m = eye_m + corner_m;
                fmt::format_to(std::back_inserter(obj), "v {:.7f} {:.7f} {:.7f}\n", at_m.x, at_m.y, at_m.z);
            }
            vertices += 3;
            fmt::format_to(std::back_inserter(obj), "f {} {} {}\n", vertices - 2, vertices - 1, vertices);
        }
    }
    return obj;
}

} // namespace octant::ui::library
