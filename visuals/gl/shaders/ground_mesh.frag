#version 450 core
// Ground with its mesh: lines one pixel wide along the edges.

in vec3 own_colour;
in vec3 from_edges;
flat in float level;

layout(location = 0) out vec4 pixel;

layout(location = 8) uniform vec4 mesh_look; // sample spacing, 1 = by level

#include "cut.glsl"

// Six hues around the wheel, one a level, so that neighbours are far apart.
vec3 level_colour() {
    float turn = fract(floor(level + 0.25) * 5.0 / 12.0) * 6.0;
    return clamp(abs(mod(turn + vec3(0.0, 4.0, 2.0), 6.0) - 3.0) - 1.0, 0.0, 1.0);
}

void main() {
    vec3 width = fwidth(from_edges);
    cut();
    vec3 near_edge = smoothstep(vec3(0.0), 1.2 * width, from_edges);
    float inside = min(min(near_edge.x, near_edge.y), near_edge.z);
    vec3 filled = mix(own_colour, level_colour(), 0.45 * mesh_look.y);
    pixel = vec4(mix(filled * 0.25, filled, inside), 1.0);
}
