#include "visuals/gl/context.h"

namespace octant::visuals::gl {
namespace {

thread_local Context* current = nullptr;

std::string text(const Functions& gl, GLenum what) {
    const GLubyte* const found = gl.get_string(what);
    return found == nullptr ? "" : reinterpret_cast<const char*>(found);
}

} // namespace

void Context::make_current() {
    if (current == this) {
        return;
    }
    if (current != nullptr) {
        current->leave();
    }
    bind();
    current = this;
}

void Context::leave() {
    if (current == this) {
        release();
        current = nullptr;
    }
}

void Context::start(const std::string& kind, AddressOf address_of) {
    make_current();
    functions_ = load_functions(address_of);
    description_ = {kind, text(functions_, GL_RENDERER), text(functions_, GL_VERSION)};
}

} // namespace octant::visuals::gl
