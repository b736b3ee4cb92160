#version 450 core
// Aircraft: each polygon flat or smooth.

flat in vec4 flat_colour; // a = 1: the smooth one counts; a < 0: the polygon's back is seen
#ifdef PHONG
#include "picture.glsl"

in vec3 surface_colour;
in vec3 surface_normal; // world axes
in vec3 to_eye; // world axes, metres
in vec4 smooth_haze_part; // with what is mirrored
#else
in vec3 smooth_colour;
#endif
#if defined(PHONG) || defined(TEXTURED)
in vec4 haze_part; // colour times share, and what is left of the surface's own
#endif
#ifdef TEXTURED
in vec2 on_texture;
flat in uint shown_texture; // 0: none
layout(location = 8) uniform vec4 step_opacity; // of the step, in x; 1: nothing is blended

#include "texture.glsl"
#endif

layout(location = 0) out vec4 pixel;

#include "cut.glsl"

#ifdef PHONG
// Phong's shading with the highlight of scene::Highlight. `picture`: the colour that lies on the surface.
vec3 smooth_light(vec3 picture) {
    vec3 normal = normalize(surface_normal);
    float cosine = max(dot(normal, to_sun.xyz), 0.0);
    float mirrored = cosine > 0.0 ? dot(reflect(-to_sun.xyz, normal), normalize(to_eye)) : 0.0;
    vec3 light = surface_colour * picture * (ambient.rgb + sunlight.rgb * cosine) +
                 sunlight.rgb * 0.4 * pow(max(mirrored, 0.0), 24.0);
    return min(light, vec3(1.0)) * smooth_haze_part.a + smooth_haze_part.rgb;
}
#elif defined(TEXTURED)
vec3 smooth_light(vec3 picture) {
    return min(smooth_colour * picture, vec3(1.0)) * haze_part.a + haze_part.rgb;
}
#else
vec3 smooth_light(vec3 picture) {
    return smooth_colour;
}
#endif

#ifdef TEXTURED
// The picture's colour and its share of what is blended. Derivatives have to be taken before any sample is discarded.
vec4 picture_here() {
    vec2 across = dFdx(on_texture);
    vec2 down = dFdy(on_texture);
    if (shown_texture == 0u) {
        return vec4(1.0);
    }
    Texture shown = textures[shown_texture - 1u];
    vec4 colour = shown_by(shown, on_texture, across, down);
    uint alpha = shown.modes >> 4;
    if (alpha == alpha_mask && colour.a < shown.threshold) {
        return vec4(colour.rgb, -1.0);
    }
    return vec4(colour.rgb, alpha == alpha_blend ? colour.a : 1.0);
}
#endif

void main() {
#ifdef TEXTURED
    vec4 picture = picture_here();
    if (picture.a < 0.0) {
        discard;
    }
#endif
    // Asked here, as some drivers leave out slivers by how their corners go round before they are
    // rounded: then holes remain between neighbours. The plane knows which of them rounding turned.
    if (!gl_FrontFacing || flat_colour.a < 0.0) {
        discard;
    }
    cut();
#ifdef TEXTURED
    vec3 flat_light = min(flat_colour.rgb * picture.rgb, vec3(1.0)) * haze_part.a + haze_part.rgb;
    float share = step_opacity.x < 1.0 ? step_opacity.x * picture.a : 1.0;
    pixel = vec4(mix(flat_light, smooth_light(picture.rgb), flat_colour.a), share);
#else
    pixel = vec4(mix(flat_colour.rgb, smooth_light(vec3(1.0)), flat_colour.a), 1.0);
#endif
}
