#version 450 core
// CUT: only samples in front of all planes.

flat in vec4 flat_colour; // a = 1: the smooth one counts
in vec3 smooth_colour;

layout(location = 0) out vec4 pixel;

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

void main() {
#ifdef CUT
    cut();
#endif
    pixel = vec4(mix(flat_colour.rgb, smooth_colour, flat_colour.a), 1.0);
}
