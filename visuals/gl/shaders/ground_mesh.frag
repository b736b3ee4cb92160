#version 450 core
// Ground with its mesh: lines one pixel wide along the edges.
// CUT: only samples in front of all planes.

in vec3 own_colour;
in vec3 from_edges;
flat in float level;

layout(location = 0) out vec4 pixel;

layout(location = 8) uniform vec4 mesh_look; // sample spacing, 1 = by level

#ifdef CUT
layout(std140, binding = 0) uniform Picture {
    mat4 world_to_clip;
    vec4 haze;
    vec4 to_sun;
    vec4 ambient;
    vec4 sunlight;
    mat4 ray_from_pixel; // world axes, one unit deep
};

layout(location = 0) uniform vec4 planes[8]; // world axes, eye at the origin

// By the sample's own line of sight, so that all triangles that cover it are cut alike.
void cut() {
    vec2 sample_at = floor(gl_FragCoord.xy) + gl_SamplePosition;
    vec3 ray = mat3(ray_from_pixel) * vec3(sample_at, 1.0);
    for (int i = 0; i < 8; ++i) {
        if (dot(planes[i].xyz, ray) + planes[i].w * gl_FragCoord.w < 0.0) {
            discard;
        }
    }
}
#endif

// Six hues around the wheel, one a level, so that neighbours are far apart.
vec3 level_colour() {
    float turn = fract(floor(level + 0.25) * 5.0 / 12.0) * 6.0;
    return clamp(abs(mod(turn + vec3(0.0, 4.0, 2.0), 6.0) - 3.0) - 1.0, 0.0, 1.0);
}

void main() {
    vec3 width = fwidth(from_edges);
#ifdef CUT
    cut();
#endif
    vec3 near_edge = smoothstep(vec3(0.0), 1.2 * width, from_edges);
    float inside = min(min(near_edge.x, near_edge.y), near_edge.z);
    vec3 filled = mix(own_colour, level_colour(), 0.45 * mesh_look.y);
    pixel = vec4(mix(filled * 0.25, filled, inside), 1.0);
}
