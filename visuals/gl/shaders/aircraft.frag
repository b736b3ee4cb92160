#version 450 core
// Aircraft: each polygon flat or smooth.

flat in vec4 flat_colour; // a = 1: the smooth one counts; a < 0: the polygon's back is seen
#ifdef PHONG
#include "picture.glsl"

in vec3 surface_colour;
in vec3 surface_normal; // world axes
in vec3 to_eye; // world axes, metres
in vec4 haze_part; // colour times share, and what is left of the surface's own
#else
in vec3 smooth_colour;
#endif

layout(location = 0) out vec4 pixel;

#include "cut.glsl"

#ifdef PHONG
// Phong's shading with the highlight of scene::Highlight.
vec3 smooth_light() {
    vec3 normal = normalize(surface_normal);
    float cosine = max(dot(normal, to_sun.xyz), 0.0);
    float mirrored = cosine > 0.0 ? dot(reflect(-to_sun.xyz, normal), normalize(to_eye)) : 0.0;
    vec3 light = surface_colour * (ambient.rgb + sunlight.rgb * cosine) +
                 sunlight.rgb * 0.4 * pow(max(mirrored, 0.0), 24.0);
    return min(light, vec3(1.0)) * haze_part.a + haze_part.rgb;
}
#else
vec3 smooth_light() {
    return smooth_colour;
}
#endif

void main() {
    // Asked here, as some drivers leave out slivers by how their corners go round before they are
    // rounded: then holes remain between neighbours. The plane knows which of them rounding turned.
    if (!gl_FrontFacing || flat_colour.a < 0.0) {
        discard;
    }
    cut();
    pixel = vec4(mix(flat_colour.rgb, smooth_light(), flat_colour.a), 1.0);
}
