#version 450 core
// Ground by texture: colour and normal of the full-resolution field, lit here.

in vec2 albedo_at;
in vec2 normal_at;
in float shade;
in vec4 air;

layout(location = 0) out vec4 pixel;

#include "picture.glsl"

layout(binding = 0) uniform sampler2D albedo;
layout(binding = 1) uniform sampler2D normal_xy; // 128 + 127 x, 128 + 127 y

#include "cut.glsl"

void main() {
    // Before any cut: the size that a texture is read at comes from the neighbouring pixels.
    vec3 own = texture(albedo, albedo_at).rgb;
    vec2 slope = texture(normal_xy, normal_at).rg * (255.0 / 127.0) - 128.0 / 127.0;
    cut();
    vec3 normal = vec3(slope, sqrt(max(1.0 - dot(slope, slope), 0.0)));
    vec3 light = ambient.rgb + sunlight.rgb * max(dot(normal, to_sun.xyz), 0.0);
    vec3 lit = min(own * light, vec3(1.0)) * shade;
    pixel = vec4(mix(lit, air.rgb, air.a), 1.0);
}
