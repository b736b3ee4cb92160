#include "visuals/gl/context.h"

#include "visuals/gl/debug_messages.h"

#include <algorithm>
#include <array>

namespace octant::visuals::gl {
namespace {

thread_local Context* current = nullptr;

std::string text(const Functions& gl, GLenum what) {
    const GLubyte* const found = gl.get_string(what);
    return found == nullptr ? "" : reinterpret_cast<const char*>(found);
}

} // namespace

bool is_software_device(std::string_view renderer) {
    constexpr std::array<std::string_view, 5> known = {
        "llvmpipe", "softpipe", "swrast", "Software Rasterizer", "SwiftShader"};
    return std::ranges::any_of(
        known, [&](std::string_view name) { return renderer.find(name) != std::string_view::npos; });
}

bool is_software_renderer(const Functions& gl) { return is_software_device(text(gl, GL_RENDERER)); }

void Context::make_current() {
    if (current == this) { return; }
    if (current != nullptr) { current->leave(); }
    bind();
    current = this;
}

const Functions& Context::current_functions() {
    make_current();
    return functions_;
}

void Context::leave() {
    if (current == this) {
        release();
        current = nullptr;
    }
}

void Context::start(const std::string& kind, ProcAddressLookup look_up_address) {
    make_current();
    functions_ = load_functions(look_up_address);
    const std::string device = text(functions_, GL_RENDERER);
    const std::string description = kind + ", OpenGL " + text(functions_, GL_VERSION);
    info_ = {description, device, is_software_device(device)};
    print_debug_messages(functions_);
}

} // namespace octant::visuals::gl
