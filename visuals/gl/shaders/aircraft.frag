#version 450 core
// Aircraft: each polygon flat or smooth.

flat in vec4 flat_colour; // a = 1: the smooth one counts
in vec3 smooth_colour;

layout(location = 0) out vec4 pixel;

#include "cut.glsl"

void main() {
    cut();
    pixel = vec4(mix(flat_colour.rgb, smooth_colour, flat_colour.a), 1.0);
}
