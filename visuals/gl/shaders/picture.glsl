// What all shaders read about a picture: PictureValues of visuals/gl/renderer.cpp.
#ifndef PICTURE
#define PICTURE
layout(std140, binding = 0) uniform Picture {
    mat4 world_to_clip;
    vec4 haze; // colour, 1 / visibility (0 = no haze)
    vec4 haze_sunward; // colour, fall of the density a metre
    vec4 haze_to_sun; // unit, level, world axes
    vec4 to_sun; // unit, world axes
    vec4 ambient;
    vec4 sunlight;
    vec4 mirrored_overhead; // what glass mirrors, scene::MirroredSky; a = 0: nothing
    vec4 mirrored_below;
    mat4 ray_from_pixel; // world axes, one unit deep
    vec4 albedo_place; // texture coordinates of the eye, then their change a metre
    vec4 normal_place;
    vec4 detail_at_eye[8]; // the eye's place in the detail texture at each scale, in cubes; texels a metre; 0 = none
};
#endif
