#version 450 core
// What is coloured at its vertices alone: the sky.

in vec3 colour;

layout(location = 0) out vec4 pixel;

#include "cut.glsl"

void main() {
    cut();
    pixel = vec4(colour, 1.0);
}
