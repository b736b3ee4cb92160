#pragma once

#include "visuals/gl/functions.h"
#include "visuals/scene/renderer.h"

#include <memory>
#include <string>
#include <string_view>

namespace octant::visuals::gl {

/// Whether a processor draws, not a GPU: by the driver's GL_RENDERER, and by that of the current context.
bool is_software_device(std::string_view renderer);
bool is_software_renderer(const Functions& gl);

/// An OpenGL 4.5 core context without a picture of its own: draw into a Framebuffer. Must outlive whatever was made
/// with its functions.
class Context {
public:
    virtual ~Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    Context(Context&&) = delete;
    Context& operator=(Context&&) = delete;

    /// Makes it current in this thread, which costs nothing where it is already. Whichever context was current is
    /// released first: a maker (GLX, EGL, OSMesa) does not notice that another one took over. To be called first by
    /// whatever draws with the functions. Throws Error.
    void make_current();

    const Functions& functions() const { return functions_; }

    /// make_current(), then functions().
    const Functions& current_functions();

    /// The driver and the device that draw.
    const scene::RendererInfo& info() const { return info_; }

protected:
    Context() = default;

    /// Makes it current and fills functions and info; in debug builds its messages are printed from now on. Throws
    /// Error.
    void start(const std::string& kind, ProcAddressLookup look_up_address);

    /// For the destructor of a maker: releases the context where it is still current.
    void leave();

private:
    virtual void bind() = 0;
    virtual void release() = 0;

    Functions functions_;
    scene::RendererInfo info_;
};

/// A context on Mesa's off-screen library (processor only, no display needed), current in this thread. Throws Error.
std::unique_ptr<Context> make_osmesa_context();

/// A context through EGL without display or surface: Mesa's surfaceless platform or, failing that, the first device
/// that gives one; current in this thread. Throws Error.
std::unique_ptr<Context> make_egl_context();

} // namespace octant::visuals::gl
