// Step 2 of a picture (renderer.cpp): the vertices of aircraft are projected to the screen, lit and hazed, and the
// light of the picture is prepared. Those of ground are in ground_vertices.cpp. Next: triangle_setup.cpp.
#include "visuals/raster/vertex_stage.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace octant::visuals::raster {

namespace {

constexpr float max_level = 255.0F;
/// Cosine between a line of sight and a polygon's normal above which its back is seen: a hundred times what rounding
/// leaves open.
constexpr float min_turn = 1e-5F;

glm::vec4 unpacked(std::uint32_t colour) {
    const auto byte = [&](unsigned shift) { return static_cast<float>(colour >> shift & 0xffU); };
    return {byte(0), byte(8), byte(16), byte(24)};
}

/// Haze between the eye and a place.
struct Air {
    glm::vec3 rgb_255;
    float share;
};

/// As scene::Haze says.
Air air_before(const glm::vec3& place_m, const Light& light) {
    const float distance_m = std::sqrt(place_m.x * place_m.x + place_m.y * place_m.y + place_m.z * place_m.z);
    const float haze_density_exponent = place_m.z * light.falloff_per_m;
    const float size = std::abs(haze_density_exponent);
    float density = 1.0F - 0.5F * haze_density_exponent;
    if (size >= min_haze_fall) {
        const float left = exp_of_minus(std::min(size, max_haze_fall));
        density = (1.0F - left) / (haze_density_exponent > 0.0F ? size : size * left);
    }
    const float level_m = place_m.x * light.horizontal_to_sun.x + place_m.y * light.horizontal_to_sun.y;
    const float towards = std::max(level_m / std::max(distance_m, 1e-6F), 0.0F);
    return {glm::mix(light.haze, light.sunward_colour, towards * towards) * max_level,
        1.0F - exp_of_minus(distance_m * light.per_m * density)};
}

/// A colour under the light on a surface that faces `outwards`, levels.
glm::vec3 lit(const glm::vec3& rgb_255, const glm::vec3& outwards, const Light& light) {
    const glm::vec3 sum = light.ambient + light.sunlight * std::max(glm::dot(outwards, light.to_sun), 0.0F);
    return glm::min(rgb_255 * sum, glm::vec3(max_level));
}

/// The colour over which a tint lies, if its alpha says so; levels.
glm::vec3 tinted(std::uint32_t colour, std::uint32_t tint) {
    const glm::vec4 own = unpacked(colour);
    if (tint == 0) { return {own.x, own.y, own.z}; }
    const glm::vec4 over = unpacked(tint);
    return glm::mix(glm::vec3(own.x, own.y, own.z), glm::vec3(over.x, over.y, over.z), over.w / max_level);
}

void set_three(const glm::vec3& from, std::span<float> to) {
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

} // namespace

Light light_of(const scene::FramePlan& plan) {
    const float visibility_m = plan.haze.visibility_m;
    return {plan.ambient, plan.sunlight, plan.to_sun, plan.haze.colour,
        visibility_m > 0.0F ? 1.0F / visibility_m : 0.0F, plan.haze.falloff_per_m, plan.haze.horizontal_to_sun,
        plan.haze.sunward_colour};
}

void project_aircraft(std::span<const scene::ModelVertex> from, const AircraftDrawState& state,
    const Projection& projection, const Light& light, const VertexOutputs& to) {
    assert(to.vertices.size() == from.size() && to.flat.size() == from.size());
    for (std::size_t i = 0; i < from.size(); ++i) {
        const scene::ModelVertex& vertex = from[i];
        const glm::mat4& turn = state.parts[vertex.part];
        const glm::vec3 at_m = glm::vec3(turn * glm::vec4(vertex.position_m, 1.0F));
        to.clip[i] = clip_position(projection, at_m);
        place(projection, to.clip[i], to.vertices[i]);
        const std::uint32_t word = vertex.polygon / 32U;
        const bool smooth = word < state.smooth.size() && (state.smooth[word] >> (vertex.polygon % 32U) & 1U) != 0;
        const Air air = air_before(at_m, light);
        const auto coloured = [&](std::uint32_t colour, std::uint32_t tint, const glm::vec3& normal) {
            const glm::vec3 outwards = glm::mat3(turn) * normal;
            return glm::mix(lit(tinted(colour, tint), outwards, light), air.rgb_255, air.share);
        };
        set_three(coloured(vertex.colour, state.tints.smooth, vertex.normal), to.vertices[i].value);
        to.flat[i].is_smooth = smooth;
        to.flat[i].is_back_facing = glm::dot(glm::mat3(turn) * vertex.face_normal, at_m) > min_turn * glm::length(at_m);
        if (!smooth) { set_three(coloured(vertex.face_colour, state.tints.flat, vertex.face_normal), to.flat[i].rgb); }
        if (!to.lit.empty()) {
            LitVertex& lit = to.lit[i];
            set_three(glm::mat3(turn) * vertex.normal, lit.normal);
            set_three(-at_m, lit.to_eye);
            set_three(tinted(vertex.colour, state.tints.smooth), lit.rgb);
            set_three(air.rgb_255 * air.share, lit.haze);
            lit.transmittance = 1.0F - air.share;
        }
    }
}

} // namespace octant::visuals::raster
