#include "sim/base/error.h"
#include "sim/base/lazy_library.h"
#include "visuals/gl/context.h"

#include <GL/osmesa.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace octant::visuals::gl {
namespace {

/// OSMesa is opened when the first context is made: it brings a compiler with it, which takes as long to load as
/// everything else that a program does at its start.
constinit LazyLibrary osmesa_library(OCTANT_OSMESA_FILE);

#define OCTANT_OSMESA(name) const LazyFunction<decltype(::name)> name(osmesa_library, #name)
OCTANT_OSMESA(OSMesaCreateContextAttribs);
OCTANT_OSMESA(OSMesaDestroyContext);
OCTANT_OSMESA(OSMesaGetProcAddress);
OCTANT_OSMESA(OSMesaMakeCurrent);
#undef OCTANT_OSMESA

/// OSMesa wants a picture in memory; nothing is drawn there.
constexpr int unused_px = 16;

class OsmesaContext final : public Context {
public:
    OsmesaContext() {
        const std::array<int, 11> wanted{OSMESA_FORMAT, OSMESA_RGBA, OSMESA_PROFILE, OSMESA_CORE_PROFILE,
            OSMESA_CONTEXT_MAJOR_VERSION, 4, OSMESA_CONTEXT_MINOR_VERSION, 5, OSMESA_DEPTH_BITS, 0, 0};
        context_ = OSMesaCreateContextAttribs(wanted.data(), nullptr);
        if (context_ == nullptr) { throw Error("expected OpenGL 4.5, got no such context from OSMesa"); }
    }

    ~OsmesaContext() override {
        leave();
        OSMesaDestroyContext(context_);
    }

    OsmesaContext(const OsmesaContext&) = delete;
    OsmesaContext& operator=(const OsmesaContext&) = delete;
    OsmesaContext(OsmesaContext&&) = delete;
    OsmesaContext& operator=(OsmesaContext&&) = delete;

    void start() { Context::start("osmesa", OSMesaGetProcAddress); }

private:
    void bind() override {
        if (OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, unused_px, unused_px) == GL_FALSE) {
            throw Error("expected OSMesa to make its context current, got a refusal");
        }
    }

    void release() override { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

    std::array<std::uint32_t, std::size_t{unused_px} * unused_px> pixels_{};
    OSMesaContext context_ = nullptr;
};

} // namespace

std::unique_ptr<Context> make_osmesa_context() {
    auto context = std::make_unique<OsmesaContext>();
    context->start();
    return context;
}

} // namespace octant::visuals::gl
