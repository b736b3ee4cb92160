#version 450 core
// Panels over the window: places in its own units, glyphs and shapes from one atlas.

layout(location = 0) in vec2 at;
layout(location = 1) in vec4 own_colour;
layout(location = 2) in vec2 atlas_at;

layout(location = 0) uniform vec4 window; // 2 / width, -2 / height

out vec4 colour;
out vec2 in_atlas;

void main() {
    colour = own_colour;
    in_atlas = atlas_at;
    gl_Position = vec4(at * window.xy + vec2(-1.0, 1.0), 0.0, 1.0);
}
