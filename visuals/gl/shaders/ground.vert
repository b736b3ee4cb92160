#version 450 core
// Ground: colours come lit; haze by the distance of the vertex.

layout(location = 0) in vec3 position_m; // world axes, eye at the origin
layout(location = 1) in vec4 own_colour;

layout(location = 0) uniform mat4 to_clip;
layout(location = 1) uniform vec3 haze_colour;
layout(location = 2) uniform float haze_per_m; // 1 / visibility, 0 = no haze

out vec3 colour;

void main() {
    float haze_share = 1.0 - exp(-length(position_m) * haze_per_m);
    colour = mix(own_colour.rgb, haze_colour, haze_share);
    gl_Position = to_clip * vec4(position_m, 1.0);
}
