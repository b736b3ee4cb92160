#version 450 core
// Sky: no haze, and at depth 0, which is infinitely far.

layout(location = 0) in vec3 position_m; // world axes, eye at the origin
layout(location = 1) in vec4 own_colour;

#include "picture.glsl"

out vec3 colour;

void main() {
    colour = own_colour.rgb;
    vec4 clip = world_to_clip * vec4(position_m, 1.0);
    gl_Position = vec4(clip.xy, 0.0, clip.w);
}
