#version 450 core
// Ground that is coloured at its vertices, with its fine pattern.

#ifdef NUMBERS
flat // from corner to corner rounding would change a bit in slivers
#endif
in vec3 colour;
in vec2 grain_at;
in float grain_share;

layout(location = 0) out vec4 pixel;

layout(binding = 2) uniform sampler2D pattern;

#include "cut.glsl"

void main() {
    // Before any cut: the size that a texture is read at comes from the neighbouring pixels. Half a
    // level finer than usual, as the pattern's finest features are two texels wide.
    vec2 across = dFdx(grain_at) * 0.7071;
    vec2 down = dFdy(grain_at) * 0.7071;
    cut();
    float grain = 0.0;
    if (grain_share > 0.0) {
        grain = textureGrad(pattern, grain_at, across, down).r * (255.0 / 128.0) - 1.0;
    }
    pixel = vec4(colour * (1.0 + grain_share * grain), 1.0);
}
