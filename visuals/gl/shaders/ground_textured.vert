#version 450 core
// Ground by texture: its places in the texture, and haze by the distance of the vertex. What is
// painted on it has its own colour and is all haze of that colour.

layout(location = 0) in vec3 position_m; // world axes, eye at the origin
layout(location = 1) in vec4 own_colour; // alpha: share of the light that is left; 0 = painted

#include "haze.glsl"

out vec2 albedo_at;
out vec2 normal_at;
out float shade;
out vec4 air; // the haze, and its share

void main() {
    albedo_at = albedo_place.xy + position_m.xy * albedo_place.zw;
    normal_at = normal_place.xy + position_m.xy * normal_place.zw;
    shade = own_colour.a;
    air = haze_before(position_m);
    if (own_colour.a == 0.0) {
        air = vec4(mix(own_colour.rgb, air.rgb, air.a), 1.0);
    }
    gl_Position = world_to_clip * vec4(position_m, 1.0);
}
