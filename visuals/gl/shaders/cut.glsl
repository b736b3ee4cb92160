// cut(): where CUT is defined, only samples in front of all planes are drawn; else it does nothing.
#ifdef CUT
#include "picture.glsl"

layout(location = 0) uniform vec4 planes[8]; // world axes, eye at the origin

// By the sample's own line of sight, so that all triangles that cover it are cut alike.
void cut() {
    vec2 sample_at = floor(gl_FragCoord.xy) + gl_SamplePosition;
    vec3 ray = mat3(ray_from_pixel) * vec3(sample_at, 1.0);
    for (int i = 0; i < 8; ++i) {
        if (dot(planes[i].xyz, ray) + planes[i].w * gl_FragCoord.w < 0.0) {
            discard;
        }
    }
}
#else
void cut() {}
#endif
