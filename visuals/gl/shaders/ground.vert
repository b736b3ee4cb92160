#version 450 core
// Ground: colours come lit; haze by the distance of the vertex.

layout(location = 0) in vec3 position_m; // world axes, eye at the origin
layout(location = 1) in vec4 own_colour;

#include "haze.glsl"

out vec3 colour;
#ifdef MESH
out vec3 place_m;
#endif

void main() {
    vec4 place = vec4(position_m, 1.0);
    vec4 air = haze_before(position_m);
    colour = mix(own_colour.rgb, air.rgb, air.a);
#ifdef MESH
    place_m = position_m;
#endif
    gl_Position = world_to_clip * place;
}
