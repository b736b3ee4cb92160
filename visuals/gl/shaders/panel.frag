#version 450 core
// Panels over the window: the atlas holds how much of a texel is covered.

in vec4 colour;
in vec2 in_atlas;

layout(binding = 0) uniform sampler2D atlas;

layout(location = 0) out vec4 pixel;

void main() {
    pixel = vec4(colour.rgb, colour.a * texture(atlas, in_atlas).r);
}
