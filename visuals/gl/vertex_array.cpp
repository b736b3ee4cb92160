#include "visuals/gl/vertex_array.h"

namespace octant::visuals::gl {

void add_vector_input(const Functions& gl, const Object& array, GLuint input, std::size_t offset) {
    gl.enable_vertex_array_attrib(array.name(), input);
    gl.vertex_array_attrib_format(array.name(), input, 3, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
    gl.vertex_array_attrib_binding(array.name(), input, 0);
}

void add_place_input(const Functions& gl, const Object& array, GLuint input, std::size_t offset) {
    gl.enable_vertex_array_attrib(array.name(), input);
    gl.vertex_array_attrib_format(array.name(), input, 2, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
    gl.vertex_array_attrib_binding(array.name(), input, 0);
}

void add_colour_input(const Functions& gl, const Object& array, std::size_t offset, GLuint input, GLuint binding) {
    gl.enable_vertex_array_attrib(array.name(), input);
    gl.vertex_array_attrib_format(array.name(), input, 4, GL_UNSIGNED_BYTE, GL_TRUE, static_cast<GLuint>(offset));
    gl.vertex_array_attrib_binding(array.name(), input, binding);
}

void add_number_input(const Functions& gl, const Object& array, GLuint input, GLuint binding, std::size_t offset) {
    gl.enable_vertex_array_attrib(array.name(), input);
    gl.vertex_array_attrib_i_format(array.name(), input, 1, GL_UNSIGNED_INT, static_cast<GLuint>(offset));
    gl.vertex_array_attrib_binding(array.name(), input, binding);
}

} // namespace octant::visuals::gl
