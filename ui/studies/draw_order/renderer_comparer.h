#pragma once

#include "ui/settings/settings.h"
#include "ui/studies/draw_order/ray_renderer.h"
#include "ui/studies/draw_order/study_renderer.h"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>

namespace octant::ui::studies::draw_order {

/// The renderers whose pictures are held against rays, in this order everywhere.
inline constexpr std::array compared_renderers = {
    settings::RendererKind::Raster, settings::RendererKind::Gl};

/// How far a pixel's middle may lie from what it shows, pixels. Corners are rounded to 1/256 pixel
/// and what is painted again is cut 1/100 pixel too wide where only that rounding could tell.
inline constexpr double rounding_reach_px = 1.0 / 256.0 + 0.01;

/// In place of a session's renderer: draws each plan, of polygon numbers painted in their order, by
/// every renderer that is held against rays, and compares the pictures with what rays have found of
/// the same frame. The session's own picture is that of the first one.
class RendererComparer final : public StudyRenderer {
public:
    /// `rays` must have drawn the frame, hidden by depth, before this draws it, and must outlive
    /// this. Throws Error.
    RendererComparer(const settings::RunSettings& settings, const RayRenderer& rays);

    using Differences = std::array<RayRenderer::Difference, compared_renderers.size()>;

    /// How the pictures of the last plan differ from the rays; wrong is what no rounding explains.
    const Differences& differences() const { return differences_; }

    const visuals::scene::RendererInfo& info() const override { return renderers_.front()->info(); }

    std::unique_ptr<visuals::scene::Renderer>
    sibling(const glm::ivec2& size_px, int samples) const override;
    void resize(const glm::ivec2& size_px, std::optional<int> samples) override;
    void load_models(std::span<const visuals::scene::ModelBuffers> models) override;
    void load_ground_texture(const visuals::scene::GroundTexture& texture) override;
    void warm_up() override;
    void draw(const visuals::scene::FramePlan& plan) override;

    void finish_and_read(visuals::scene::Picture& picture) override { picture = picture_; }

private:
    RayRenderer::Difference
    difference_to_rays(const visuals::scene::FramePlan& plan, const visuals::scene::Picture& picture);

    settings::RunSettings settings_;
    const RayRenderer& rays_;
    std::array<std::unique_ptr<visuals::scene::Renderer>, compared_renderers.size()> renderers_;
    /// The plan painted in its order, but without rounding.
    RayRenderer unrounded_;
    bool is_unrounded_drawn_ = false; ///< Of the plan at hand.
    visuals::scene::Picture picture_;
    Differences differences_;
};

} // namespace octant::ui::studies::draw_order
