#include "sim/base/error.h"
#include "visuals/gl/context.h"
#include "visuals/gl/debug_messages.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace octant::visuals::gl {
namespace {

/// Words of an extension list, compared whole.
bool has_word(const char* words, std::string_view wanted) {
    std::string_view rest = words == nullptr ? "" : words;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        if (rest.substr(0, end) == wanted) { return true; }
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return false;
}

/// Displays that need no screen, the likeliest first. Not yet initialised.
std::vector<EGLDisplay> surfaceless_displays() {
    const char* const extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    std::vector<EGLDisplay> displays;
    if (has_word(extensions, "EGL_MESA_platform_surfaceless")) {
        displays.push_back(eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    }
    const auto query_devices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    if (has_word(extensions, "EGL_EXT_platform_device") && query_devices != nullptr) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count);
        for (EGLint i = 0; i < count; ++i) {
            displays.push_back(
                eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr));
        }
    }
    std::erase(displays, EGL_NO_DISPLAY);
    return displays;
}

class EglContext final : public Context {
public:
    explicit EglContext(EGLDisplay display) : display_(display) {
        // Never terminated: EGL hands out the same display again and does not count its users.
        if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
            throw Error("expected EGL to initialise without a display, got a refusal");
        }
        const std::array<EGLint, 5> requested_config{
            EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint configs = 0;
        eglChooseConfig(display, requested_config.data(), &config, 1, &configs);
        const std::array<EGLint, 9> wanted{EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5,
            EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_CONTEXT_OPENGL_DEBUG,
            prints_debug_messages ? EGL_TRUE : EGL_FALSE, EGL_NONE};
        if (configs > 0 && eglBindAPI(EGL_OPENGL_API) == EGL_TRUE) {
            context_ = eglCreateContext(display, config, EGL_NO_CONTEXT, wanted.data());
        }
        if (context_ == EGL_NO_CONTEXT) { throw Error("expected OpenGL 4.5, got no such context from EGL"); }
    }

    ~EglContext() override {
        leave();
        eglDestroyContext(display_, context_);
    }

    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;
    EglContext(EglContext&&) = delete;
    EglContext& operator=(EglContext&&) = delete;

    void start() { Context::start("egl", eglGetProcAddress); }

private:
    void bind() override {
        eglBindAPI(EGL_OPENGL_API);
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
            throw Error("expected EGL to make a context current without a surface, got a refusal");
        }
    }

    void release() override { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

    EGLDisplay display_;
    EGLContext context_ = EGL_NO_CONTEXT;
};

} // namespace

std::unique_ptr<Context> make_egl_context() {
    std::string fault = "expected EGL without a display, got neither its surfaceless platform nor "
                        "a device";
    for (EGLDisplay display : surfaceless_displays()) {
        try {
            auto context = std::make_unique<EglContext>(display);
            context->start();
            return context;
        } catch (const Error& error) { fault = error.what(); }
    }
    throw Error(fault);
}

} // namespace octant::visuals::gl
