#include "visuals/gl/object.h"

#include "visuals/gl/debug_messages.h"

namespace octant::visuals::gl {

Object make_buffer(const Functions& gl, const char* label) {
    GLuint name = 0;
    gl.create_buffers(1, &name);
    label_object(gl, GL_BUFFER, name, label);
    return {gl, name, [](const Functions& f, GLuint n) { f.delete_buffers(1, &n); }};
}

Object make_vertex_array(const Functions& gl, const char* label) {
    GLuint name = 0;
    gl.create_vertex_arrays(1, &name);
    label_object(gl, GL_VERTEX_ARRAY, name, label);
    return {gl, name, [](const Functions& f, GLuint n) { f.delete_vertex_arrays(1, &n); }};
}

Object make_framebuffer(const Functions& gl, const char* label) {
    GLuint name = 0;
    gl.create_framebuffers(1, &name);
    label_object(gl, GL_FRAMEBUFFER, name, label);
    return {gl, name, [](const Functions& f, GLuint n) { f.delete_framebuffers(1, &n); }};
}

Object make_renderbuffer(const Functions& gl, const char* label) {
    GLuint name = 0;
    gl.create_renderbuffers(1, &name);
    label_object(gl, GL_RENDERBUFFER, name, label);
    return {gl, name, [](const Functions& f, GLuint n) { f.delete_renderbuffers(1, &n); }};
}

Object make_texture(const Functions& gl, const char* label) {
    GLuint name = 0;
    gl.create_textures(GL_TEXTURE_2D, 1, &name);
    label_object(gl, GL_TEXTURE, name, label);
    return {gl, name, [](const Functions& f, GLuint n) { f.delete_textures(1, &n); }};
}

} // namespace octant::visuals::gl
