#version 450 core
// Alpha = how much of what is there is covered.

in vec4 colour;

layout(location = 0) out vec4 pixel;

void main() {
    pixel = colour;
}
