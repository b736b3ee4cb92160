#include "tests/visuals/gl/small_scene.h"
#include "visuals/gl/debug_messages.h"

#include <catch2/catch.hpp>

#include <iostream>
#include <sstream>
#include <string>

using namespace octant;
using namespace octant::tests;

namespace {

/// What is said on standard error while it lives.
class Overheard {
public:
    Overheard() : before_(std::cerr.rdbuf(text_.rdbuf())) {}

    ~Overheard() { std::cerr.rdbuf(before_); }

    Overheard(const Overheard&) = delete;
    Overheard& operator=(const Overheard&) = delete;
    Overheard(Overheard&&) = delete;
    Overheard& operator=(Overheard&&) = delete;

    std::string text() const { return text_.str(); }

private:
    std::ostringstream text_;
    std::streambuf* before_;
};

} // namespace

TEST_CASE("debug builds print what the driver complains about, others nothing") {
    const auto context = gl::make_osmesa_context();
    const gl::Functions& functions = context->functions();
    const Overheard overheard;
    functions.enable(GL_TRIANGLES); // no such capability
    CHECK(functions.get_error() == GL_INVALID_ENUM);
    if (gl::prints_debug_messages) {
        CHECK_THAT(overheard.text(), Catch::StartsWith("OpenGL error: "));
    } else {
        CHECK(overheard.text().empty());
    }
}

TEST_CASE("the driver complains about nothing that the painters do") {
    const Overheard overheard;
    {
        Studio studio;
        hash_of_full_scene(studio);
        studio.renderer().warm_up();
        studio.renderer().resize({32, 16}, 4);
        hash_of_full_scene(studio);
    }
    CHECK(overheard.text().empty());
}
