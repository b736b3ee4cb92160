#pragma once

#define GL_GLEXT_PROTOTYPES // for the types of the functions; none of them is linked
#include <GL/glcorearb.h>

#include <string_view>

// The OpenGL functions that this project calls: member of Functions, and name without "gl". A function that is needed
// gets an entry here and nothing else.
// clang-format off
#define OCTANT_GL_FUNCTIONS(X) \
    X(attach_shader, AttachShader) X(bind_buffer_base, BindBufferBase) X(bind_buffer, BindBuffer) \
    X(bind_framebuffer, BindFramebuffer) X(bind_texture, BindTexture) X(bind_texture_unit, BindTextureUnit) \
    X(bind_vertex_array, BindVertexArray) X(blend_color, BlendColor) X(blend_func_separate, BlendFuncSeparate) \
    X(blit_named_framebuffer, BlitNamedFramebuffer) X(check_named_framebuffer_status, CheckNamedFramebufferStatus) \
    X(clear_named_framebufferfv, ClearNamedFramebufferfv) X(clip_control, ClipControl) X(color_mask, ColorMask) \
    X(compile_shader, CompileShader) X(create_buffers, CreateBuffers) X(create_framebuffers, CreateFramebuffers) \
    X(create_program, CreateProgram) X(create_renderbuffers, CreateRenderbuffers) X(create_shader, CreateShader) \
    X(create_textures, CreateTextures) X(create_vertex_arrays, CreateVertexArrays) X(cull_face, CullFace) \
    X(debug_message_callback, DebugMessageCallback) X(debug_message_control, DebugMessageControl) \
    X(delete_buffers, DeleteBuffers) X(delete_framebuffers, DeleteFramebuffers) X(delete_program, DeleteProgram) \
    X(delete_renderbuffers, DeleteRenderbuffers) X(delete_shader, DeleteShader) X(delete_textures, DeleteTextures) \
    X(delete_vertex_arrays, DeleteVertexArrays) X(depth_func, DepthFunc) X(depth_mask, DepthMask) \
    X(disable, Disable) X(draw_elements_base_vertex, DrawElementsBaseVertex) \
    X(draw_elements_instanced, DrawElementsInstancedBaseVertexBaseInstance) X(enable, Enable) \
    X(enable_vertex_array_attrib, EnableVertexArrayAttrib) X(finish, Finish) X(front_face, FrontFace) \
    X(generate_texture_mipmap, GenerateTextureMipmap) X(get_error, GetError) X(get_floatv, GetFloatv) \
    X(get_integerv, GetIntegerv) X(get_program_info_log, GetProgramInfoLog) X(get_programiv, GetProgramiv) \
    X(get_shader_info_log, GetShaderInfoLog) X(get_shaderiv, GetShaderiv) X(get_stringi, GetStringi) \
    X(get_string, GetString) X(link_program, LinkProgram) X(multi_draw_elements_indirect, MultiDrawElementsIndirect) \
    X(named_buffer_data, NamedBufferData) X(named_buffer_sub_data, NamedBufferSubData) \
    X(named_framebuffer_renderbuffer, NamedFramebufferRenderbuffer) \
    X(named_renderbuffer_storage_multisample, NamedRenderbufferStorageMultisample) \
    X(named_framebuffer_texture, NamedFramebufferTexture) X(object_label, ObjectLabel) X(pixel_storei, PixelStorei) \
    X(polygon_offset, PolygonOffset) X(program_uniform_4fv, ProgramUniform4fv) X(provoking_vertex, ProvokingVertex) \
    X(read_pixels, ReadPixels) X(scissor, Scissor) X(shader_source, ShaderSource) X(tex_image_2d, TexImage2D) \
    X(texture_parameterf, TextureParameterf) X(texture_parameteri, TextureParameteri) \
    X(texture_storage_2d, TextureStorage2D) X(texture_storage_3d, TextureStorage3D) \
    X(texture_sub_image_2d, TextureSubImage2D) X(texture_sub_image_3d, TextureSubImage3D) X(use_program, UseProgram) \
    X(vertex_array_attrib_binding, VertexArrayAttribBinding) X(vertex_array_attrib_format, VertexArrayAttribFormat) \
    X(vertex_array_attrib_i_format, VertexArrayAttribIFormat) \
    X(vertex_array_binding_divisor, VertexArrayBindingDivisor) \
    X(vertex_array_element_buffer, VertexArrayElementBuffer) X(vertex_array_vertex_buffer, VertexArrayVertexBuffer) \
    X(viewport, Viewport)
// clang-format on

namespace octant::visuals::gl {

/// OpenGL 4.5 core functions of one driver; to be called while its context is current.
struct Functions {
#define OCTANT_GL_MEMBER(member, name) decltype(&::gl##name) member = nullptr;
    OCTANT_GL_FUNCTIONS(OCTANT_GL_MEMBER)
#undef OCTANT_GL_MEMBER
};

/// What OSMesa, EGL, GLX and GLFW all offer: a function by its name.
using AnyFunction = void (*)();
using ProcAddressLookup = AnyFunction (*)(const char* name);

/// Fills the table from the current context. Throws Error when it is older than OpenGL 4.5 or lacks a function.
Functions load_functions(ProcAddressLookup look_up_address);

/// Throws Error "expected OpenGL 4.5, got ..." unless `version` (a driver's GL_VERSION) starts with 4.5 or more.
void require_gl_4_5(std::string_view version);

} // namespace octant::visuals::gl
