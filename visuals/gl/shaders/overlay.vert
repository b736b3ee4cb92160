#version 450 core
// Overlay and transparent geometry: places in pixels from the upper left corner of the viewport, depth as in the buffer.

layout(location = 0) in vec2 at_px;
layout(location = 1) in vec4 own_colour;
layout(location = 2) in float depth;

layout(location = 0) uniform vec4 clip_per_px; // x right, y down

out vec4 colour;

void main() {
    colour = own_colour;
    vec2 share = at_px * clip_per_px.xy;
    gl_Position = vec4(share.x - 1.0, 1.0 - share.y, depth, 1.0);
}
