#pragma once

#include <GL/glcorearb.h>

#include <string_view>

// The GL functions this project calls: member name, type, name of the driver's function. A function that is needed gets
// a line here and nothing else.
#define OCTANT_GL_FUNCTIONS(X)                                                                                         \
    X(attach_shader, PFNGLATTACHSHADERPROC, "glAttachShader")                                                          \
    X(bind_buffer_base, PFNGLBINDBUFFERBASEPROC, "glBindBufferBase")                                                   \
    X(bind_buffer, PFNGLBINDBUFFERPROC, "glBindBuffer")                                                                \
    X(bind_framebuffer, PFNGLBINDFRAMEBUFFERPROC, "glBindFramebuffer")                                                 \
    X(bind_texture, PFNGLBINDTEXTUREPROC, "glBindTexture")                                                             \
    X(bind_texture_unit, PFNGLBINDTEXTUREUNITPROC, "glBindTextureUnit")                                                \
    X(bind_vertex_array, PFNGLBINDVERTEXARRAYPROC, "glBindVertexArray")                                                \
    X(blend_color, PFNGLBLENDCOLORPROC, "glBlendColor")                                                                \
    X(blend_func_separate, PFNGLBLENDFUNCSEPARATEPROC, "glBlendFuncSeparate")                                          \
    X(blit_named_framebuffer, PFNGLBLITNAMEDFRAMEBUFFERPROC, "glBlitNamedFramebuffer")                                 \
    X(check_named_framebuffer_status, PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC, "glCheckNamedFramebufferStatus")           \
    X(clear_named_framebufferfv, PFNGLCLEARNAMEDFRAMEBUFFERFVPROC, "glClearNamedFramebufferfv")                        \
    X(clip_control, PFNGLCLIPCONTROLPROC, "glClipControl")                                                             \
    X(color_mask, PFNGLCOLORMASKPROC, "glColorMask")                                                                   \
    X(compile_shader, PFNGLCOMPILESHADERPROC, "glCompileShader")                                                       \
    X(create_buffers, PFNGLCREATEBUFFERSPROC, "glCreateBuffers")                                                       \
    X(create_framebuffers, PFNGLCREATEFRAMEBUFFERSPROC, "glCreateFramebuffers")                                        \
    X(create_program, PFNGLCREATEPROGRAMPROC, "glCreateProgram")                                                       \
    X(create_renderbuffers, PFNGLCREATERENDERBUFFERSPROC, "glCreateRenderbuffers")                                     \
    X(create_shader, PFNGLCREATESHADERPROC, "glCreateShader")                                                          \
    X(create_textures, PFNGLCREATETEXTURESPROC, "glCreateTextures")                                                    \
    X(create_vertex_arrays, PFNGLCREATEVERTEXARRAYSPROC, "glCreateVertexArrays")                                       \
    X(cull_face, PFNGLCULLFACEPROC, "glCullFace")                                                                      \
    X(debug_message_callback, PFNGLDEBUGMESSAGECALLBACKPROC, "glDebugMessageCallback")                                 \
    X(debug_message_control, PFNGLDEBUGMESSAGECONTROLPROC, "glDebugMessageControl")                                    \
    X(delete_buffers, PFNGLDELETEBUFFERSPROC, "glDeleteBuffers")                                                       \
    X(delete_framebuffers, PFNGLDELETEFRAMEBUFFERSPROC, "glDeleteFramebuffers")                                        \
    X(delete_program, PFNGLDELETEPROGRAMPROC, "glDeleteProgram")                                                       \
    X(delete_renderbuffers, PFNGLDELETERENDERBUFFERSPROC, "glDeleteRenderbuffers")                                     \
    X(delete_shader, PFNGLDELETESHADERPROC, "glDeleteShader")                                                          \
    X(delete_textures, PFNGLDELETETEXTURESPROC, "glDeleteTextures")                                                    \
    X(delete_vertex_arrays, PFNGLDELETEVERTEXARRAYSPROC, "glDeleteVertexArrays")                                       \
    X(depth_func, PFNGLDEPTHFUNCPROC, "glDepthFunc")                                                                   \
    X(depth_mask, PFNGLDEPTHMASKPROC, "glDepthMask")                                                                   \
    X(disable, PFNGLDISABLEPROC, "glDisable")                                                                          \
    X(draw_elements_base_vertex, PFNGLDRAWELEMENTSBASEVERTEXPROC, "glDrawElementsBaseVertex")                          \
    X(draw_elements_instanced, PFNGLDRAWELEMENTSINSTANCEDBASEVERTEXBASEINSTANCEPROC,                                   \
        "glDrawElementsInstancedBaseVertexBaseInstance")                                                               \
    X(enable, PFNGLENABLEPROC, "glEnable")                                                                             \
    X(enable_vertex_array_attrib, PFNGLENABLEVERTEXARRAYATTRIBPROC, "glEnableVertexArrayAttrib")                       \
    X(finish, PFNGLFINISHPROC, "glFinish")                                                                             \
    X(front_face, PFNGLFRONTFACEPROC, "glFrontFace")                                                                   \
    X(generate_texture_mipmap, PFNGLGENERATETEXTUREMIPMAPPROC, "glGenerateTextureMipmap")                              \
    X(get_error, PFNGLGETERRORPROC, "glGetError")                                                                      \
    X(get_floatv, PFNGLGETFLOATVPROC, "glGetFloatv")                                                                   \
    X(get_integerv, PFNGLGETINTEGERVPROC, "glGetIntegerv")                                                             \
    X(get_program_info_log, PFNGLGETPROGRAMINFOLOGPROC, "glGetProgramInfoLog")                                         \
    X(get_programiv, PFNGLGETPROGRAMIVPROC, "glGetProgramiv")                                                          \
    X(get_shader_info_log, PFNGLGETSHADERINFOLOGPROC, "glGetShaderInfoLog")                                            \
    X(get_shaderiv, PFNGLGETSHADERIVPROC, "glGetShaderiv")                                                             \
    X(get_stringi, PFNGLGETSTRINGIPROC, "glGetStringi")                                                                \
    X(get_string, PFNGLGETSTRINGPROC, "glGetString")                                                                   \
    X(link_program, PFNGLLINKPROGRAMPROC, "glLinkProgram")                                                             \
    X(multi_draw_elements_indirect, PFNGLMULTIDRAWELEMENTSINDIRECTPROC, "glMultiDrawElementsIndirect")                 \
    X(named_buffer_data, PFNGLNAMEDBUFFERDATAPROC, "glNamedBufferData")                                                \
    X(named_buffer_sub_data, PFNGLNAMEDBUFFERSUBDATAPROC, "glNamedBufferSubData")                                      \
    X(named_framebuffer_renderbuffer, PFNGLNAMEDFRAMEBUFFERRENDERBUFFERPROC, "glNamedFramebufferRenderbuffer")         \
    X(named_renderbuffer_storage_multisample, PFNGLNAMEDRENDERBUFFERSTORAGEMULTISAMPLEPROC,                            \
        "glNamedRenderbufferStorageMultisample")                                                                       \
    X(named_framebuffer_texture, PFNGLNAMEDFRAMEBUFFERTEXTUREPROC, "glNamedFramebufferTexture")                        \
    X(object_label, PFNGLOBJECTLABELPROC, "glObjectLabel")                                                             \
    X(pixel_storei, PFNGLPIXELSTOREIPROC, "glPixelStorei")                                                             \
    X(polygon_offset, PFNGLPOLYGONOFFSETPROC, "glPolygonOffset")                                                       \
    X(program_uniform_4fv, PFNGLPROGRAMUNIFORM4FVPROC, "glProgramUniform4fv")                                          \
    X(provoking_vertex, PFNGLPROVOKINGVERTEXPROC, "glProvokingVertex")                                                 \
    X(read_pixels, PFNGLREADPIXELSPROC, "glReadPixels")                                                                \
    X(scissor, PFNGLSCISSORPROC, "glScissor")                                                                          \
    X(shader_source, PFNGLSHADERSOURCEPROC, "glShaderSource")                                                          \
    X(tex_image_2d, PFNGLTEXIMAGE2DPROC, "glTexImage2D")                                                               \
    X(texture_parameterf, PFNGLTEXTUREPARAMETERFPROC, "glTextureParameterf")                                           \
    X(texture_parameteri, PFNGLTEXTUREPARAMETERIPROC, "glTextureParameteri")                                           \
    X(texture_storage_2d, PFNGLTEXTURESTORAGE2DPROC, "glTextureStorage2D")                                             \
    X(texture_sub_image_2d, PFNGLTEXTURESUBIMAGE2DPROC, "glTextureSubImage2D")                                         \
    X(use_program, PFNGLUSEPROGRAMPROC, "glUseProgram")                                                                \
    X(vertex_array_attrib_binding, PFNGLVERTEXARRAYATTRIBBINDINGPROC, "glVertexArrayAttribBinding")                    \
    X(vertex_array_attrib_format, PFNGLVERTEXARRAYATTRIBFORMATPROC, "glVertexArrayAttribFormat")                       \
    X(vertex_array_attrib_i_format, PFNGLVERTEXARRAYATTRIBIFORMATPROC, "glVertexArrayAttribIFormat")                   \
    X(vertex_array_binding_divisor, PFNGLVERTEXARRAYBINDINGDIVISORPROC, "glVertexArrayBindingDivisor")                 \
    X(vertex_array_element_buffer, PFNGLVERTEXARRAYELEMENTBUFFERPROC, "glVertexArrayElementBuffer")                    \
    X(vertex_array_vertex_buffer, PFNGLVERTEXARRAYVERTEXBUFFERPROC, "glVertexArrayVertexBuffer")                       \
    X(viewport, PFNGLVIEWPORTPROC, "glViewport")

namespace octant::visuals::gl {

/// OpenGL 4.5 core functions of one driver; to be called while its context is current.
struct Functions {
#define OCTANT_GL_MEMBER(member, type, name) type member = nullptr;
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
