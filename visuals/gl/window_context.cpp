#include "visuals/gl/window_context.h"

#include "sim/base/error.h"
#include "visuals/gl/debug_messages.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <fmt/format.h>

namespace octant::visuals::gl {
namespace {

std::string fault_text() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text == nullptr ? "no reason given" : printable(text);
}

/// The windowing library, for as long as a window is open.
class Library {
public:
    Library() {
        if (glfwInit() != GLFW_TRUE) {
            throw Error(fmt::format(
                "expected a display to open a window on, got none ({}); octant fly needs none", fault_text()));
        }
    }

    ~Library() { glfwTerminate(); }

    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
    Library(Library&&) = delete;
    Library& operator=(Library&&) = delete;
};

class GlfwContext final : public WindowContext {
public:
    explicit GlfwContext(const WindowOptions& options) {
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, prints_debug_messages ? GLFW_TRUE : GLFW_FALSE);
        glfwWindowHint(GLFW_DEPTH_BITS, 0);
        glfwWindowHint(GLFW_STENCIL_BITS, 0);
        glfwWindowHint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
        window_ = glfwCreateWindow(options.size.x, options.size.y, options.title.c_str(), nullptr, nullptr);
        if (window_ == nullptr) {
            throw Error(fmt::format("expected a display driver with OpenGL 4.5, got none ({}); octant fly draws "
                                    "without a display's driver",
                fault_text()));
        }
    }

    ~GlfwContext() override {
        leave();
        glfwDestroyWindow(window_);
    }

    GlfwContext(const GlfwContext&) = delete;
    GlfwContext& operator=(const GlfwContext&) = delete;
    GlfwContext(GlfwContext&&) = delete;
    GlfwContext& operator=(GlfwContext&&) = delete;

    void start() {
        Context::start("window", glfwGetProcAddress);
        glfwSwapInterval(0);
    }

    GLFWwindow* window() const override { return window_; }

    void wait_for_refresh(bool wait) override {
        make_current();
        glfwSwapInterval(wait ? 1 : 0);
    }

    void swap_buffers() override {
        make_current();
        glfwSwapBuffers(window_);
    }

private:
    void bind() override { glfwMakeContextCurrent(window_); }

    void release() override { glfwMakeContextCurrent(nullptr); }

    Library library_; ///< is left after the window is closed
    GLFWwindow* window_ = nullptr;
};

} // namespace

std::unique_ptr<WindowContext> make_window_context(const WindowOptions& options) {
    auto context = std::make_unique<GlfwContext>(options);
    context->start();
    return context;
}

} // namespace octant::visuals::gl
