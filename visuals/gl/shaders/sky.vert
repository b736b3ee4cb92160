#version 450 core
// Sky and the land around the map: their colours come in haze, and at depth 0, which is infinitely far.

layout(location = 0) in vec3 position_m; // world axes, eye at the origin
layout(location = 1) in vec4 own_colour;

#include "haze.glsl"

out vec3 colour;
out vec3 place_m;
out float covers; // of the land around the map
out float left;

void main() {
    colour = own_colour.rgb;
    place_m = position_m;
    covers = own_colour.a;
    left = 1.0 - haze_before(position_m).a;
    vec4 clip = world_to_clip * vec4(position_m, 1.0);
    gl_Position = vec4(clip.xy, 0.0, clip.w);
}
