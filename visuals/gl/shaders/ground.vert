#version 450 core
// Ground: colours come lit; haze by the distance of the vertex.

layout(location = 0) in vec3 position_m; // world axes, eye at the origin
layout(location = 1) in vec4 own_colour; // alpha: the number of its covers

#include "haze.glsl"

#ifdef NUMBERS
flat
#endif
out vec3 colour;
out vec3 place_m;
#ifndef MESH
out float covers;
out float left; // by the haze
#endif

void main() {
    vec4 place = vec4(position_m, 1.0);
    vec4 air = haze_before(position_m);
    colour = mix(own_colour.rgb, air.rgb, air.a);
    place_m = position_m;
#ifndef MESH
    covers = own_colour.a;
    left = 1.0 - air.a;
#endif
    gl_Position = world_to_clip * place;
}
