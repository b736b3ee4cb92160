#version 450 core
// Aircraft: light from everywhere and from the sun, then haze; one colour for a whole polygon.

layout(location = 0) in vec3 position_m; // body axes
layout(location = 1) in vec4 own_colour;
layout(location = 2) in vec3 normal; // body axes, unit

layout(location = 0) uniform mat4 to_clip;
layout(location = 1) uniform vec3 haze_colour;
layout(location = 2) uniform float haze_per_m; // 1 / visibility, 0 = no haze
layout(location = 3) uniform mat4 body_to_eye_world;
layout(location = 4) uniform vec3 sun_in_body; // unit, towards the sun
layout(location = 5) uniform vec3 ambient;
layout(location = 6) uniform vec3 sunlight;

flat out vec3 colour;

void main() {
    vec3 light = ambient + sunlight * max(dot(normal, sun_in_body), 0.0);
    vec3 lit = min(own_colour.rgb * light, vec3(1.0));
    float distance_m = length((body_to_eye_world * vec4(position_m, 1.0)).xyz);
    float haze_share = 1.0 - exp(-distance_m * haze_per_m);
    colour = mix(lit, haze_colour, haze_share);
    gl_Position = to_clip * vec4(position_m, 1.0);
}
