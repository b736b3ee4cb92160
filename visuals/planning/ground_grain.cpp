#include "visuals/planning/ground_grain.h"

#include "visuals/scene/grain_pattern.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace octant::visuals::planning {

namespace {

constexpr double coarsest_grain_m = 4.0;
constexpr double least_reach_m = 250.0;
constexpr double most_reach_m = 2000.0;

} // namespace

scene::Grain ground_grain(const landscape::Ground& ground, const FrameView& view) {
    using scene::GrainPattern;
    const glm::dvec3& eye_m = view.camera.eye_m;
    const double over_m = eye_m.z - ground.height_at(eye_m.x, eye_m.y).value_or(eye_m.z);
    const double reach_m = std::clamp(
        std::sqrt(coarsest_grain_m * std::max(over_m, 0.0) / view.pixel_rad),
        least_reach_m,
        most_reach_m);
    const glm::dvec2 place =
        (glm::dvec2(eye_m) + glm::dvec2(GrainPattern::lean) * eye_m.z) *
        (static_cast<double>(GrainPattern::texels_per_m) / GrainPattern::texels_a_side);
    return {
        glm::vec2(place - glm::floor(place)),
        static_cast<float>(0.6 * reach_m),
        static_cast<float>(reach_m)};
}

} // namespace octant::visuals::planning
