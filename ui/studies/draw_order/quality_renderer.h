#pragma once

#include "ui/settings/settings.h"
#include "ui/studies/draw_order/study_renderer.h"
#include "ui/studies/draw_order/supersampled.h"
#include "visuals/raster/workers.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace octant::ui::studies::draw_order {

/// A renderer with a number of samples a pixel.
struct RenderMode {
    std::string_view name;
    std::string_view file_part;
    settings::RendererKind renderer;
    int samples;
};

/// Whose pictures are measured, in this order everywhere.
inline constexpr std::array render_modes{
    RenderMode{"OpenGL, 1 sample", "gl-1", settings::RendererKind::Gl, 1},
    RenderMode{"OpenGL, 4 samples", "gl-4", settings::RendererKind::Gl, 4},
    RenderMode{"raster, 1 sample", "raster-1", settings::RendererKind::Raster, 1},
    RenderMode{"raster, 4 samples", "raster-4", settings::RendererKind::Raster, 4},
    RenderMode{"raster, 16 samples", "raster-16", settings::RendererKind::Raster, 16}};
inline constexpr std::size_t gl_one_sample = 0; ///< indices into render_modes
inline constexpr std::size_t gl_four_samples = 1;
inline constexpr std::size_t raster_one_sample = 2;
inline constexpr std::size_t raster_sixteen_samples = 4;

/// How far the pictures of one way are from what 8 x 8 samples a pixel show. Sums over pictures.
struct PictureQuality {
    /// From supersampled pictures by OpenGL, and by the way's own renderer.
    double squares_to_gl = 0.0;
    double squares_to_own = 0.0;
    double parts = 0.0;         ///< red, green and blue of each pixel
    double largest_error = 0.0; ///< levels, from its own
    /// Pixels that change by more than 16 levels too much or too little when the picture moves by
    /// half a pixel, once right and once down.
    long false_changes = 0;

    double db_to_gl() const;
    double db_to_own() const;
    void add(const PictureQuality& other);
};

/// In place of a session's renderer: draws each plan in all ways and measures their pictures; the
/// session's own picture is that of the last way. Whatever is drawn over the picture is left out.
class QualityRenderer final : public StudyRenderer {
public:
    /// Throws Error.
    explicit QualityRenderer(const settings::RunSettings& settings);

    /// Of all plans drawn so far.
    const std::array<PictureQuality, render_modes.size()>& quality() const { return quality_; }

    /// Of the last plan.
    const visuals::scene::Picture& picture(std::size_t mode) const { return pictures_[mode]; }

    /// visuals::raster::mask_picture() of the last plan without a ground texture.
    const visuals::scene::Picture& masks() const { return masks_; }

    const visuals::scene::RendererInfo& info() const override { return info_; }

    std::unique_ptr<visuals::scene::Renderer>
    sibling(const glm::ivec2& size_px, int samples) const override;
    void resize(const glm::ivec2& size_px, std::optional<int> samples) override;
    void load_models(std::span<const visuals::scene::ModelBuffers> models) override;
    void load_ground_texture(const visuals::scene::GroundTexture& texture) override;
    void warm_up() override;
    void draw(const visuals::scene::FramePlan& plan) override;

    void finish_and_read(visuals::scene::Picture& picture) override { picture = pictures_.back(); }

private:
    static constexpr std::size_t positions = 3; ///< in place, half a pixel right, half a pixel down
    using References = std::array<Supersampled, positions>;

    void measure(std::size_t mode, const visuals::scene::FramePlan& plan);
    const References& own_references(std::size_t mode) const;

    settings::RunSettings settings_;
    visuals::scene::RendererInfo info_;
    std::array<std::unique_ptr<visuals::scene::Renderer>, render_modes.size()> renderers_;
    std::array<PictureQuality, render_modes.size()> quality_;
    std::array<visuals::scene::Picture, render_modes.size()> pictures_;
    std::vector<visuals::scene::ModelBuffers> models_;
    visuals::raster::Workers workers_{1};
    visuals::scene::Picture masks_;
    References by_gl_;
    References by_raster_;
};

} // namespace octant::ui::studies::draw_order
