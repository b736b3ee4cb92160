#version 450 core
// Ground: colours come lit; haze by the distance of the vertex.

layout(location = 0) in vec3 position_m; // world axes, eye at the origin
layout(location = 1) in vec4 own_colour; // alpha: share of the fine pattern

#include "haze.glsl"

#ifdef NUMBERS
flat
#endif
out vec3 colour;
#ifdef MESH
out vec3 place_m;
#else
out vec2 grain_at;
out float grain_share;

const float tile_m = 128.0; // scene::GrainPattern
const vec2 lean = vec2(0.6, -0.8);
const float most_share = 0.32;
#endif

void main() {
    vec4 place = vec4(position_m, 1.0);
    vec4 air = haze_before(position_m);
    colour = mix(own_colour.rgb, air.rgb, air.a);
#ifdef MESH
    place_m = position_m;
#else
    grain_at = grain.xy + (position_m.xy + lean * position_m.z) / tile_m;
    float near = grain.w > grain.z ? (grain.w - length(position_m)) / (grain.w - grain.z) : 0.0;
    grain_share = most_share * own_colour.a * clamp(near, 0.0, 1.0) * (1.0 - air.a);
#endif
    gl_Position = world_to_clip * place;
}
