#version 450 core
// Ground with its mesh: hands each triangle's corners on with their distances from its edges, and
// how many times its longest edge is twice the ground's sample spacing.

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

in vec3 colour[];
in vec3 place_m[]; // world axes, eye at the origin

layout(location = 8) uniform vec4 mesh_look; // sample spacing, 1 = by level

out vec3 own_colour;
out vec3 from_edges; // 1 at the corner opposite the edge
flat out float level;

void main() {
    float longest_m = 0.0;
    for (int i = 0; i < 3; ++i) {
        longest_m = max(longest_m, distance(place_m[i].xy, place_m[(i + 1) % 3].xy));
    }
    level = log2(max(longest_m / mesh_look.x, 1.0));
    for (int i = 0; i < 3; ++i) {
        own_colour = colour[i];
        from_edges = vec3(i == 0, i == 1, i == 2);
        gl_Position = gl_in[i].gl_Position;
        EmitVertex();
    }
    EndPrimitive();
}
