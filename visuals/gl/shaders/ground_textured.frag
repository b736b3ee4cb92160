#version 450 core
// Ground by texture: colour and normal of the full-resolution field, lit here.
// CUT: only samples in front of all planes.

in vec2 albedo_at;
in vec2 normal_at;
in vec2 shade_and_haze;

layout(location = 0) out vec4 pixel;

layout(std140, binding = 0) uniform Picture {
    mat4 world_to_clip;
    vec4 haze;
    vec4 to_sun; // unit, world axes
    vec4 ambient;
    vec4 sunlight;
    mat4 ray_from_pixel; // world axes, one unit deep
    vec4 albedo_place;
    vec4 normal_place;
};

layout(binding = 0) uniform sampler2D albedo;
layout(binding = 1) uniform sampler2D normal_xy; // 128 + 127 x, 128 + 127 y

#ifdef CUT
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
    // Before any cut: the size that a texture is read at comes from the neighbouring pixels.
    vec3 own = texture(albedo, albedo_at).rgb;
    vec2 slope = texture(normal_xy, normal_at).rg * (255.0 / 127.0) - 128.0 / 127.0;
#ifdef CUT
    cut();
#endif
    vec3 normal = vec3(slope, sqrt(max(1.0 - dot(slope, slope), 0.0)));
    vec3 light = ambient.rgb + sunlight.rgb * max(dot(normal, to_sun.xyz), 0.0);
    vec3 lit = min(own * light, vec3(1.0)) * shade_and_haze.x;
    pixel = vec4(mix(lit, haze.rgb, shade_and_haze.y), 1.0);
}
