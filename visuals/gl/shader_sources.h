#pragma once

namespace octant::visuals::gl {

// The files of visuals/gl/shaders/, put in at build time (embed_shaders.cmake).
extern const char* const ground_vert;
extern const char* const ground_frag;
extern const char* const ground_textured_vert;
extern const char* const ground_textured_frag;
extern const char* const sky_vert;
extern const char* const aircraft_vert;
extern const char* const aircraft_frag;
extern const char* const ground_mesh_geom;
extern const char* const ground_mesh_frag;
extern const char* const panel_vert;
extern const char* const panel_frag;
extern const char* const overlay_vert;
extern const char* const overlay_frag;

} // namespace octant::visuals::gl
