#version 450 core
// Aircraft: light from everywhere and from the sun, then haze; one colour for a whole polygon.

layout(location = 0) in vec3 position_m; // body axes
layout(location = 1) in vec4 own_colour;
layout(location = 2) in vec3 normal;     // body axes, unit
layout(location = 3) in uint part;       // 0 = body, then the turning parts
layout(location = 4) in uint first_part; // of the aircraft

layout(std140, binding = 0) uniform Picture {
    mat4 world_to_clip;
    vec4 haze; // colour, 1 / visibility (0 = no haze)
    vec4 to_sun; // unit, world axes
    vec4 ambient;
    vec4 sunlight;
    mat4 ray_from_pixel;
};

layout(std430, binding = 0) readonly buffer Parts {
    mat4 body_to_eye_world[]; // world axes, eye at the origin
};

flat out vec3 colour;

void main() {
    mat4 part_to_eye_world = body_to_eye_world[first_part + part];
    vec4 place = vec4((part_to_eye_world * vec4(position_m, 1.0)).xyz, 1.0);
    vec3 outwards = mat3(part_to_eye_world) * normal;
    vec3 light = ambient.rgb + sunlight.rgb * max(dot(outwards, to_sun.xyz), 0.0);
    vec3 lit = min(own_colour.rgb * light, vec3(1.0));
    float haze_share = 1.0 - exp(-length(place.xyz) * haze.w);
    colour = mix(lit, haze.rgb, haze_share);
    gl_Position = world_to_clip * place;
}
