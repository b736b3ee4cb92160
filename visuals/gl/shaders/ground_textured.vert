#version 450 core
// Ground by texture: its places in the texture, and haze by the distance of the vertex.

layout(location = 0) in vec3 position_m; // world axes, eye at the origin
layout(location = 1) in vec4 own_colour; // only alpha: share of the light that is left

#include "picture.glsl"

out vec2 albedo_at;
out vec2 normal_at;
out vec2 shade_and_haze;

void main() {
    albedo_at = albedo_place.xy + position_m.xy * albedo_place.zw;
    normal_at = normal_place.xy + position_m.xy * normal_place.zw;
    shade_and_haze = vec2(own_colour.a, 1.0 - exp(-length(position_m) * haze.w));
    gl_Position = world_to_clip * vec4(position_m, 1.0);
}
