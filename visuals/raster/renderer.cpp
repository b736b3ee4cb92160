// Draws a picture. The files in the order in which a FramePlan becomes pixels; draw_into() below begins with 4 and ends
// with 5:
//   1 frame_draws      the plan's steps become slices of triangles, and blocks of vertices that are projected alike
//   2 vertex_stage     vertices are projected to the screen, lit and hazed; ground_vertices does so for ground
//   3 triangle_setup   triangles are clipped and get their edges and gradients, which triangle_planes computes
//   4 triangle_binner  runs step 1, then 2 and 3 on all threads, and sorts the triangles into tiles
//   5 tile_painter     paints one tile, the plan's order in reverse: from the nearest triangle to the farthest
//   6 *-inl.h          spans and texels of one triangle within a tile; tile_painter.cpp lists them
#include "visuals/raster/renderer.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <utility>

namespace octant::visuals::raster {

namespace {

constexpr int max_samples = 16;
constexpr std::array<std::uint8_t, 4> inset_frame{20, 23, 26, 255};
constexpr std::array<std::uint8_t, 4> inset_frame_blue_first{26, 23, 20, 255};
constexpr int frame_rows = 360; ///< of the picture for each pixel of the frame's width

std::uint8_t byte_of(float share) { return static_cast<std::uint8_t>(std::clamp(share, 0.0F, 1.0F) * 255.0F + 0.5F); }

/// Colour of the haze in the middle of the picture, which textured ground has all over.
glm::vec3 haze_ahead(const scene::FramePlan& plan) {
    const glm::vec3 ahead(-plan.world_to_view[0].z, -plan.world_to_view[1].z, -plan.world_to_view[2].z);
    const float towards = std::max(glm::dot(glm::vec2(ahead), plan.haze.horizontal_to_sun), 0.0F);
    return glm::mix(plan.haze.colour, plan.haze.sunward_colour, towards * towards);
}

} // namespace

Renderer::Renderer(std::shared_ptr<ThreadPool> workers, const glm::ivec2& size_px, int samples,
    std::shared_ptr<scene::WindowPicture> window)
    : workers_(std::move(workers)), window_(std::move(window)), samples_(samples), lanes_(sample_pattern(samples)),
      binner_(sample_pattern(samples), *workers_) {
    info_.description = fmt::format("raster, {} threads", workers_->threads());
    info_.device = "processor";
    info_.is_software = true;
    for (int i = 0; i < workers_->threads(); ++i) { thread_scratch_.push_back(std::make_unique<ThreadScratch>()); }
    detail_image(); // built now, not in the first frame
    resize(size_px, samples);
}

std::unique_ptr<scene::Renderer> Renderer::sibling(const glm::ivec2& size_px, int samples) const {
    return std::make_unique<Renderer>(workers_, size_px, samples);
}

void Renderer::resize(const glm::ivec2& size_px, std::optional<int> wanted) {
    const int samples = wanted.value_or(max_samples);
    if (samples != samples_) {
        samples_ = samples;
        lanes_ = SampleLanes(sample_pattern(samples));
        binner_.use(sample_pattern(samples));
    }
    size_px_ = size_px;
    begin_picture();
}

/// Makes room for a picture, unless there is.
void Renderer::begin_picture() {
    is_drawn_to_window_ = targets_window_;
    if (is_drawn_to_window_) {
        pixels_ = window_->begin(size_px_);
        return;
    }
    picture_.width = size_px_.x;
    picture_.height = size_px_.y;
    picture_.rgba.resize(byte_at(0, size_px_.y));
    pixels_ = picture_.rgba.data();
}

std::size_t Renderer::byte_at(int x, int y) const {
    return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(size_px_.x) + static_cast<std::size_t>(x));
}

void Renderer::load_models(std::span<const scene::ModelBuffers> models) {
    models_.assign(models.begin(), models.end());
}

void Renderer::load_ground_texture(const scene::GroundTexture& texture) { ground_.emplace().load(texture); }

void Renderer::draw(const scene::FramePlan& plan) {
    draw_calls_ = 0;
    begin_picture();
    draw_into(plan, {0, 0, size_px_.x, size_px_.y});
}

void Renderer::draw_inset(const scene::FramePlan& plan, const scene::PixelRect& rect) {
    assert(rect.width > 0 && rect.height > 0 && rect.x >= 0 && rect.y >= 0);
    assert(rect.x + rect.width <= size_px_.x && rect.y + rect.height <= size_px_.y);
    const int frame = std::max(size_px_.y / frame_rows, 1);
    const int last_x = std::min(rect.x + rect.width + frame, size_px_.x);
    const int last_y = std::min(rect.y + rect.height + frame, size_px_.y);
    for (int y = std::max(rect.y - frame, 0); y < last_y; ++y) {
        for (int x = std::max(rect.x - frame, 0); x < last_x; ++x) {
            std::ranges::copy(is_drawn_to_window_ ? inset_frame_blue_first : inset_frame, pixels_ + byte_at(x, y));
        }
    }
    draw_into(plan, rect);
}

void Renderer::draw_into(const scene::FramePlan& plan, const scene::PixelRect& rect) {
    binner_.prepare({plan, models_, ground_ ? &*ground_ : nullptr, {rect.width, rect.height}});
    draw_calls_ += static_cast<int>(plan.steps.size());
    const glm::ivec2 tiles = binner_.tiles();
    workers_->run(tiles.x * tiles.y, [&](int tile, int thread) {
        ThreadScratch& scratch = *thread_scratch_[static_cast<std::size_t>(thread)];
        TileJob job;
        job.first_px = glm::ivec2(tile % tiles.x, tile / tiles.x) * glm::ivec2(tile_width, tile_height);
        job.size_px = glm::min(glm::ivec2(tile_width, tile_height), glm::ivec2(rect.width, rect.height) - job.first_px);
        job.triangles = binner_.triangles_of(tile, scratch.triangles);
        job.overlay = binner_.overlay_of(tile, scratch.overlay);
        job.background = {byte_of(plan.background.x), byte_of(plan.background.y), byte_of(plan.background.z)};
        job.ground = ground_ ? &*ground_ : nullptr;
        job.haze = haze_ahead(plan) * 255.0F;
        job.detail_texture = plan.detail_texture ? &binner_.detail_rays() : nullptr;
        job.light = &binner_.light();
        job.far_to_near = paint_direction_ == PaintDirection::FarToNear;
        job.tints_mesh_levels = plan.mesh_display == scene::MeshDisplay::Levels;
        job.blue_first = is_drawn_to_window_;
        job.rgba = pixels_ + byte_at(rect.x + job.first_px.x, rect.y + job.first_px.y);
        job.row_bytes = std::size_t{4} * static_cast<std::size_t>(size_px_.x);
        paint_tile(job, lanes_, scratch.buffer);
    });
}

void Renderer::finish_and_read(scene::Picture& picture) {
    assert(!is_drawn_to_window_);
    std::swap(picture, picture_);
}

void Renderer::finish_and_copy(scene::Picture& picture) {
    picture.width = size_px_.x;
    picture.height = size_px_.y;
    picture.rgba.resize(byte_at(0, size_px_.y));
    std::copy_n(pixels_, picture.rgba.size(), picture.rgba.data());
    if (is_drawn_to_window_) { // where blue comes first
        for (std::size_t i = 0; i < picture.rgba.size(); i += 4) { std::swap(picture.rgba[i], picture.rgba[i + 2]); }
    }
}

void Renderer::copy_to_window(const glm::ivec2& size_px) {
    assert(is_drawn_to_window_);
    window_->show(size_px);
}

} // namespace octant::visuals::raster
