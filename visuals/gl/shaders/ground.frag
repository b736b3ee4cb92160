#version 450 core
// Ground that is coloured at its vertices, with its detail texture; and the sky, which has none.

#ifdef NUMBERS
flat // from corner to corner rounding would change a bit in slivers
#endif
in vec3 colour;
in vec3 place_m;
in float covers;
in float left;

layout(location = 0) out vec4 pixel;

#include "cut.glsl"
#include "detail_texture.glsl"

void main() {
    // Before any cut: how large a pixel is comes from its neighbours.
    vec3 across = dFdx(place_m);
    vec3 down = dFdy(place_m);
    cut();
    pixel = vec4(colour * (1.0 + left * detail_at(place_m, across, down, covers)), 1.0);
}
