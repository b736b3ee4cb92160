#pragma once

#include "visuals/scene/renderer.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace octant::tests {

/// What a FakeRenderer was asked for; its test keeps it.
struct RendererLog {
    /// The calls that load or change something, in order: "resize 64x48", "models 2", "texture".
    std::vector<std::string> calls;
    /// The next call whose name this begins with throws Error, once.
    std::optional<std::string> refuses;
    glm::ivec2 size_px{0};
    std::uint64_t texture = 0; ///< a hash of the last texture's texels
    /// A hash of the ground's corners, colours and triangles in each plan, in the order drawn.
    std::vector<std::uint64_t> grounds;
    std::vector<float> visibilities_m;  ///< of those plans
    std::vector<std::size_t> triangles; ///< of ground in those plans
};

/// A renderer that draws nothing and says what it was asked for.
class FakeRenderer final : public visuals::scene::Renderer {
public:
    FakeRenderer(std::shared_ptr<RendererLog> log, const glm::ivec2& size_px);

    const visuals::scene::RendererInfo& info() const override { return info_; }

    std::unique_ptr<Renderer> sibling(const glm::ivec2& size_px, int samples) const override;
    void resize(const glm::ivec2& size_px, std::optional<int> samples) override;
    void load_models(std::span<const visuals::scene::ModelBuffers> models) override;
    void load_ground_texture(const visuals::scene::GroundTexture& texture) override;

    void warm_up() override {}

    void draw(const visuals::scene::FramePlan& plan) override { add_ground(plan); }

    void draw_inset(const visuals::scene::FramePlan& plan, const visuals::scene::PixelRect& /*rect*/) override {
        add_ground(plan);
    }

    void finish() override {}

    void finish_and_read(visuals::scene::Picture& /*picture*/) override {}

    int draw_calls() const override { return 1; }

    void set_window_target(const glm::ivec2& /*window_px*/) override {}

    bool is_drawn_to_window() const override { return false; }

    void copy_to_window(const glm::ivec2& /*size_px*/) override {}

private:
    void called(const std::string& call);
    void add_ground(const visuals::scene::FramePlan& plan);

    std::shared_ptr<RendererLog> log_;
    visuals::scene::RendererInfo info_{"fake", "nothing", true};
};

} // namespace octant::tests
