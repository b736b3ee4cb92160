#include "fake_renderer.h"

#include "sim/base/error.h"
#include "sim/base/hash.h"

#include <fmt/format.h>
#include <span>
#include <utility>

namespace octant::tests {

namespace scene = visuals::scene;

FakeRenderer::FakeRenderer(std::shared_ptr<RendererLog> log, const glm::ivec2& size_px) : log_(std::move(log)) {
    log_->size_px = size_px;
}

std::unique_ptr<scene::Renderer> FakeRenderer::sibling(const glm::ivec2& size_px, int /*samples*/) const {
    return std::make_unique<FakeRenderer>(std::make_shared<RendererLog>(), size_px);
}

void FakeRenderer::called(const std::string& call) {
    log_->calls.push_back(call);
    if (log_->refuses && call.starts_with(*log_->refuses)) {
        log_->refuses.reset();
        throw Error("no memory for " + call);
    }
}

void FakeRenderer::resize(const glm::ivec2& size_px, std::optional<int> /*samples*/) {
    called(fmt::format("resize {}x{}", size_px.x, size_px.y));
    log_->size_px = size_px;
}

void FakeRenderer::load_models(std::span<const scene::ModelBuffers> models) {
    called(fmt::format("models {}", models.size()));
}

void FakeRenderer::load_ground_texture(const scene::GroundTexture& texture) {
    called("texture");
    Hash hash;
    hash.add(std::as_bytes(std::span(texture.albedo.texels)));
    hash.add(std::as_bytes(std::span(texture.normal.texels)));
    log_->texture = hash.value();
}

void FakeRenderer::add_ground(const scene::FramePlan& plan) {
    Hash hash;
    for (const std::uint32_t index : plan.ground.indices) {
        hash.add(std::as_bytes(std::span(&plan.ground.vertices[index], 1)));
    }
    log_->grounds.push_back(hash.value());
    log_->visibilities_m.push_back(plan.haze.visibility_m);
    log_->triangles.push_back(plan.ground.indices.size() / 3);
}

} // namespace octant::tests
