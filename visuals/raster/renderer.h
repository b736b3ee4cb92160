#pragma once

#include "sim/base/thread_pool.h"
#include "visuals/raster/lit_ground_texture.h"
#include "visuals/raster/mesh_texture.h"
#include "visuals/raster/tile.h"
#include "visuals/raster/triangle_binner.h"
#include "visuals/raster/truth_middles.h"
#include "visuals/raster/truth_surfaces.h"
#include "visuals/scene/picture.h"
#include "visuals/scene/renderer.h"
#include "visuals/scene/truth.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::raster {

/// Makes pictures of frame plans on the processor, without OpenGL: painting order walked backwards, from the nearest
/// triangle to the farthest, so that each sample is coloured once and no depth is needed (README.md). The same plan
/// gives the same bytes on any number of threads and any processor.
class Renderer final : public scene::Renderer {
public:
    /// Picture size in pixels, at most 8,192 each way; 1, 4 or 16 samples a pixel. Pictures that are aimed at a window
    /// are made in the memory of `window`.
    Renderer(std::shared_ptr<ThreadPool> workers, const glm::ivec2& size_px, int samples,
        std::shared_ptr<scene::WindowPicture> window = nullptr);

    /// Which way painting order is walked.
    enum class PaintDirection {
        NearToFar, ///< each sample is coloured once
        FarToNear  ///< the painter's way, for comparison; with one sample a pixel only
    };

    void set_paint_direction(PaintDirection direction) { paint_direction_ = direction; }

    const scene::RendererInfo& info() const override { return info_; }

    std::unique_ptr<scene::Renderer> sibling(const glm::ivec2& size_px, int samples) const override;
    void resize(const glm::ivec2& size_px, std::optional<int> samples) override;
    void load_models(std::span<const scene::ModelBuffers> models) override;
    void load_ground_texture(const scene::GroundTexture& texture) override;

    void warm_up() override {}

    bool begin_on_idle_thread(std::function<void()> work) override {
        return workers_->begin_on_idle_thread(std::move(work));
    }

    void draw(const scene::FramePlan& plan) override;
    void draw_inset(const scene::FramePlan& plan, const scene::PixelRect& rect) override;

    /// draw() that writes the picture with 16 bits as well: red, green, blue, 65535 = full, rows from the top without
    /// gaps. More than 8 bits are what colours between corners and means of samples give.
    void draw_deep(const scene::FramePlan& plan, std::span<std::uint16_t> colours);

    /// In place of draw() where only the truth of a plan is wanted.
    void prepare_truth(const scene::FramePlan& plan);

    /// Writes the truth of the plan of the last draw() or prepare_truth(), which must still be there (asserted, as far
    /// as can be seen) and have no inset. The arrays have as many pixels as the picture; they have as many as `at_px`
    /// where this is given: for each pixel the column and row of the picture that it shows (pixel middles at whole
    /// numbers), as those of a picture with a lens's distortion. The polygon is then that of the nearest pixel of the
    /// picture; depth, normal and previous place are those of its plane at `at_px`, and the flow is in pixels of this
    /// picture. Outside the picture nothing is known: sky at depth infinity, normal 0, flow NaN, coverage 0. The same
    /// plan gives the same bytes on any number of threads and any processor.
    void draw_truth(const scene::FramePlan& plan, const scene::TruthArrays& to, std::span<const glm::vec2> at_px = {});

    void finish() override {}

    void finish_and_read(scene::Picture& picture) override;
    void finish_and_copy(scene::Picture& picture) override;

    int draw_calls() const override { return draw_calls_; }

    void set_window_target(const glm::ivec2& window_px) override {
        targets_window_ = window_ && window_px != glm::ivec2(0);
    }

    bool is_drawn_to_window() const override { return is_drawn_to_window_; }

    void copy_to_window(const glm::ivec2& size_px) override;

private:
    void begin_picture();
    std::size_t byte_at(int x, int y) const;
    void draw_into(const scene::FramePlan& plan, const scene::PixelRect& rect);
    void prepare(const scene::FramePlan& plan, const scene::PixelRect& rect);

    /// The surfaces that a tile's pixels show, each once, and for each pixel its place in that list.
    struct TileTruth {
        std::vector<SeenSurface> surfaces;
        std::array<std::uint16_t, TileMiddles::pixels> surface_of;
        std::array<std::uint16_t, TileMiddles::pixels> samples; ///< that show what the middle does, of 16
    };

    /// One for each thread.
    struct ThreadScratch {
        TileBuffer buffer;
        std::vector<TileTriangle> triangles;
        std::vector<TileTriangle> overlay;
        // Of the truth.
        TileMiddles middles;
        std::vector<std::uint16_t> place_of; ///< of each triangle of the list, in TileTruth::surfaces, from 1
        TileTruth truth;
        std::vector<std::uint32_t> keys;   ///< SampleOwners::keys
        std::vector<std::uint16_t> owners; ///< SampleOwners::of_pixels
    };

    glm::ivec2 first_px_of(int tile) const;
    void find_truth(int tile, int thread, bool has_coverage, TileTruth& truth);
    void count_coverage(const std::array<glm::ivec2, 2>& box_px, std::span<const TileTriangle> triangles,
        ThreadScratch& scratch, TileTruth& truth) const;
    void write_tile(int tile, const TileTruth& truth, const scene::TruthArrays& to) const;
    void write_at(std::span<const glm::vec2> at_px, const scene::TruthArrays& to);

    std::shared_ptr<ThreadPool> workers_;
    scene::RendererInfo info_;
    std::shared_ptr<scene::WindowPicture> window_;
    int samples_ = 0;
    PaintDirection paint_direction_ = PaintDirection::NearToFar;
    SampleLanes lanes_;
    TriangleBinner binner_;
    std::vector<scene::ModelBuffers> models_;
    std::vector<std::vector<MeshTexture>> textures_; ///< of each model
    std::optional<LitGroundTexture> ground_;

    std::vector<std::unique_ptr<ThreadScratch>> thread_scratch_;
    const scene::FramePlan* prepared_plan_ = nullptr; ///< of which binner_ holds the triangles
    TruthSurfaces truth_surfaces_;
    std::vector<std::unique_ptr<TileTruth>> tile_truths_; ///< of all tiles, for pixels that are elsewhere
    glm::ivec2 size_px_{0};
    scene::Picture picture_;         ///< any other one between finish_and_read() and the next draw()
    std::uint8_t* pixels_ = nullptr; ///< of the picture at hand: the window's or those of picture_
    std::uint16_t* deep_ = nullptr;  ///< of draw_deep()
    bool targets_window_ = false;
    bool is_drawn_to_window_ = false;
    int draw_calls_ = 0;
};

} // namespace octant::visuals::raster
