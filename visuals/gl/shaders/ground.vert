#version 450 core
// Ground: colours come lit; haze by the distance of the vertex.

layout(location = 0) in vec3 position_m; // world axes, eye at the origin
layout(location = 1) in vec4 own_colour;

#include "picture.glsl"

out vec3 colour;
#ifdef MESH
out vec3 place_m;
#endif

void main() {
    vec4 place = vec4(position_m, 1.0);
    float haze_share = 1.0 - exp(-length(position_m) * haze.w);
    colour = mix(own_colour.rgb, haze.rgb, haze_share);
#ifdef MESH
    place_m = position_m;
#endif
    gl_Position = world_to_clip * place;
}
