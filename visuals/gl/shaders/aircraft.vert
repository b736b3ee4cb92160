#version 450 core
// Aircraft: light from everywhere and from the sun, then haze; flat or smooth by the polygon's bit.

layout(location = 0) in vec3 position_m; // body axes
layout(location = 1) in vec4 own_colour;
layout(location = 2) in vec3 normal;     // body axes, unit
layout(location = 3) in uint part;       // 0 = body, then the turning parts
layout(location = 4) in uint first_part; // of the aircraft
layout(location = 5) in vec3 face_normal; // of the polygon that begins here, body axes, unit
layout(location = 6) in uint polygon;
layout(location = 7) in uint first_smooth; // of the aircraft
layout(location = 8) in vec4 face_colour; // of the polygon that begins here
layout(location = 9) in vec4 smooth_tint; // of the aircraft's smooth polygons; a = 0: none
layout(location = 10) in vec4 flat_tint; // the same of its flat ones

#ifdef TEXTURED
layout(location = 11) in vec2 place_on_texture;
layout(location = 12) in uint texture_number; // 0: none
layout(location = 13) in uint first_texture; // of the aircraft's model
#endif

#include "haze.glsl"

layout(std430, binding = 0) readonly buffer Parts {
    mat4 body_to_eye_world[]; // world axes, eye at the origin
};

layout(std430, binding = 1) readonly buffer Smooth {
    uint smooth_polygons[]; // a bit each
};

flat out vec4 flat_colour; // a = 1: the smooth one counts; a < 0: the polygon's back is seen
#if defined(PHONG) || defined(TEXTURED)
out vec4 haze_part; // colour times share, and what is left of the surface's own
#endif
#ifdef PHONG
out vec3 surface_colour;
out vec3 surface_normal; // world axes
out vec3 to_eye; // world axes, metres
out vec4 smooth_haze_part; // with what is mirrored
#else
out vec3 smooth_colour;
#endif
#ifdef TEXTURED
out vec2 on_texture;
flat out uint shown_texture; // 0: none
#endif

// What glass mirrors, as scene::MirroredSky says: what is added to the colour, and what is left of its own.
// `alpha`: of the colour; 1: no glass.
vec4 mirror(float alpha, vec3 place_m, vec3 outwards) {
    if (alpha == 1.0 || mirrored_overhead.a == 0.0) {
        return vec4(0.0, 0.0, 0.0, 1.0);
    }
    vec3 sight = place_m / max(length(place_m), 1e-6);
    float along = dot(outwards, sight);
    vec3 mirrored = sight - 2.0 * along * outwards;
    float share = 0.08 + 0.92 * pow(1.0 - min(abs(along), 1.0), 5.0);
    float towards = max(dot(mirrored, haze_to_sun.xyz), 0.0);
    float up = clamp(mirrored.z, 0.0, 1.0);
    vec3 sky = mix(mix(haze.rgb, haze_sunward.rgb, towards * towards), mirrored_overhead.rgb, up * (2.0 - up));
    sky = mix(sky, mirrored_below.rgb, clamp(-4.0 * mirrored.z, 0.0, 1.0));
    sky += 12.0 * sunlight.rgb * pow(max(dot(mirrored, to_sun.xyz), 0.0), 64.0);
    return vec4(sky * (share / max(alpha * 255.0 / 254.0, 0.05)), 1.0 - share);
}

// At most `most`: 1, or more where the picture's colour is still to come.
vec3 lit(vec3 colour, vec3 outwards, vec4 mirrored, float most) {
    vec3 light = ambient.rgb + sunlight.rgb * max(dot(outwards, to_sun.xyz), 0.0);
    return min(colour * light * mirrored.a + mirrored.rgb, vec3(most));
}

void main() {
    mat4 part_to_eye_world = body_to_eye_world[first_part + part];
    vec4 place = vec4((part_to_eye_world * vec4(position_m, 1.0)).xyz, 1.0);
    mat3 turn = mat3(part_to_eye_world);
    uint bit = smooth_polygons[first_smooth + polygon / 32u] >> (polygon % 32u) & 1u;
    vec4 air = haze_before(place.xyz);
    vec3 outwards = turn * face_normal;
    // Cosine between the line of sight and the normal above which a back is seen: a hundred times
    // what rounding leaves open.
    bool turned_away = dot(outwards, place.xyz) > 1e-5 * length(place.xyz);
    // Tinted polygons show their tint alone.
    vec4 flat_mirror = mirror(flat_tint.a > 0.0 ? 1.0 : face_colour.a, place.xyz, outwards);
#ifdef TEXTURED
    float most = texture_number == 0u || flat_tint.a > 0.0 ? 1.0 : 380.0 / 255.0; // as the raster renderer
#else
    float most = 1.0;
#endif
    vec3 flat_light = lit(mix(face_colour.rgb, flat_tint.rgb, flat_tint.a), outwards, flat_mirror, most);
    vec4 smooth_mirror = mirror(smooth_tint.a > 0.0 ? 1.0 : own_colour.a, place.xyz, turn * normal);
#if defined(PHONG) || defined(TEXTURED)
    haze_part = vec4(air.rgb * air.a, 1.0 - air.a);
#endif
#ifdef TEXTURED // the air comes after the picture
    flat_colour = vec4(flat_light, turned_away ? -1.0 : float(bit));
    on_texture = place_on_texture;
    shown_texture = texture_number == 0u || flat_tint.a > 0.0 ? 0u : first_texture + texture_number;
#else
    flat_colour = vec4(mix(flat_light, air.rgb, air.a), turned_away ? -1.0 : float(bit));
#endif
    vec3 own = mix(own_colour.rgb, smooth_tint.rgb, smooth_tint.a);
#ifdef PHONG
    surface_colour = own;
    surface_normal = turn * normal;
    to_eye = -place.xyz;
    // What is mirrored comes to the eye as haze does.
    smooth_haze_part = vec4(
        haze_part.rgb + min(smooth_mirror.rgb, vec3(1.0)) * haze_part.a, haze_part.a * smooth_mirror.a);
#elif defined(TEXTURED)
    smooth_colour = lit(own, turn * normal, smooth_mirror, most);
#else
    smooth_colour = mix(lit(own, turn * normal, smooth_mirror, most), air.rgb, air.a);
#endif
    gl_Position = world_to_clip * place;
}
