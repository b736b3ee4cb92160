// Draws a picture. The files in the order in which a FramePlan becomes pixels; draw_into() below begins with 4 and ends
// with 5:
//   1 frame_draws      the plan's steps become slices of triangles, and blocks of vertices that are projected alike
//   2 vertex_stage     vertices are projected to the screen, lit and hazed
//   3 triangle_setup   triangles are clipped and get their edges and gradients, which triangle_planes computes
//   4 triangle_binner  runs step 1, then 2 and 3 on all threads, and sorts the triangles into tiles
//   5 tile_painter     paints one tile, the plan's order in reverse: from the nearest triangle to the farthest
//   6 *-inl.h          spans and texels of one triangle within a tile; tile_painter.cpp lists them
// draw_truth() writes what the pixels show as numbers: truth_middles finds the triangles of the same lists that pixel
// middles show, truth_surfaces computes from their planes what each pixel says.
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

constexpr float share_of_samples(std::uint16_t samples) { return static_cast<float>(samples) / 16.0F; }

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
    prepared_plan_ = nullptr;
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
    textures_.clear();
    for (const scene::ModelBuffers& model : models_) {
        textures_.emplace_back(model.textures.begin(), model.textures.end());
    }
}

void Renderer::load_ground_texture(const scene::GroundTexture& texture) { ground_.emplace().load(texture); }

void Renderer::draw(const scene::FramePlan& plan) {
    draw_calls_ = 0;
    begin_picture();
    draw_into(plan, {0, 0, size_px_.x, size_px_.y});
}

void Renderer::draw_deep(const scene::FramePlan& plan, std::span<std::uint16_t> colours) {
    assert(colours.size() == byte_at(0, size_px_.y) / 4 * 3);
    deep_ = colours.data();
    draw(plan);
    deep_ = nullptr;
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

void Renderer::prepare(const scene::FramePlan& plan, const scene::PixelRect& rect) {
    binner_.prepare({plan, models_, ground_ ? &*ground_ : nullptr, {rect.width, rect.height}, textures_});
    prepared_plan_ = rect.width == size_px_.x && rect.height == size_px_.y ? &plan : nullptr;
}

void Renderer::draw_into(const scene::FramePlan& plan, const scene::PixelRect& rect) {
    prepare(plan, rect);
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
        job.row_deep = std::size_t{3} * static_cast<std::size_t>(size_px_.x);
        if (deep_ != nullptr) { job.deep = deep_ + byte_at(job.first_px.x, job.first_px.y) / 4 * 3; }
        paint_tile(job, lanes_, scratch.buffer);
    });
}

void Renderer::prepare_truth(const scene::FramePlan& plan) { prepare(plan, {0, 0, size_px_.x, size_px_.y}); }

void Renderer::draw_truth(
    const scene::FramePlan& plan, const scene::TruthArrays& to, std::span<const glm::vec2> at_px) {
    assert(prepared_plan_ == &plan);
    truth_surfaces_.begin(plan, binner_.draws(), size_px_, to.flow_px != nullptr || to.previous_px != nullptr);
    const glm::ivec2 tiles = binner_.tiles();
    const int count = tiles.x * tiles.y;
    const bool has_coverage = to.coverage != nullptr;
    if (at_px.empty()) {
        workers_->run(count, [&](int tile, int thread) {
            TileTruth& truth = thread_scratch_[static_cast<std::size_t>(thread)]->truth;
            find_truth(tile, thread, has_coverage, truth);
            write_tile(tile, truth, to);
        });
        return;
    }
    while (tile_truths_.size() < static_cast<std::size_t>(count)) {
        tile_truths_.push_back(std::make_unique<TileTruth>());
    }
    workers_->run(count, [&](int tile, int thread) {
        find_truth(tile, thread, has_coverage, *tile_truths_[static_cast<std::size_t>(tile)]);
    });
    write_at(at_px, to);
}

/// Finds the surfaces of a tile.
void Renderer::find_truth(int tile, int thread, bool has_coverage, TileTruth& truth) {
    ThreadScratch& scratch = *thread_scratch_[static_cast<std::size_t>(thread)];
    const glm::ivec2 first_px = first_px_of(tile);
    const glm::ivec2 size_px = glm::min(glm::ivec2(tile_width, tile_height), size_px_ - first_px);
    const auto triangles = binner_.triangles_of(tile, scratch.triangles);
    find_middles(first_px, size_px, triangles, truth_surfaces_, scratch.middles);
    scratch.place_of.assign(triangles.size() + 1, 0);
    truth.surfaces.clear();
    for (int row = 0; row < size_px.y; ++row) {
        const auto from = static_cast<std::size_t>(row) * tile_width;
        for (std::size_t pixel = from; pixel < from + static_cast<std::size_t>(size_px.x); ++pixel) {
            const std::uint32_t shown = scratch.middles.shown[pixel];
            std::uint16_t& place = scratch.place_of[shown];
            if (place == 0) {
                truth.surfaces.push_back(shown == 0 ? truth_surfaces_.nothing()
                                                    : truth_surfaces_.surface(triangles[shown - 1].triangle->source));
                place = static_cast<std::uint16_t>(truth.surfaces.size());
            }
            truth.surface_of[pixel] = static_cast<std::uint16_t>(place - 1);
        }
    }
    if (has_coverage) { count_coverage({first_px, size_px}, triangles, scratch, truth); }
}

/// Fills in TileTruth::samples.
void Renderer::count_coverage(const std::array<glm::ivec2, 2>& box_px, std::span<const TileTriangle> triangles,
    ThreadScratch& scratch, TileTruth& truth) const {
    const auto& [first_px, size_px] = box_px;
    scratch.keys.assign(1, 0);
    scratch.place_of.clear(); // of each surface in the keys
    for (const SeenSurface& seen : truth.surfaces) {
        const auto found = std::ranges::find(scratch.keys, TruthSurfaces::key(seen));
        scratch.place_of.push_back(static_cast<std::uint16_t>(found - scratch.keys.begin()));
        if (found == scratch.keys.end()) { scratch.keys.push_back(TruthSurfaces::key(seen)); }
    }
    scratch.owners.assign(TileBuffer::pixels + TileBuffer::padding, 0);
    for (int row = 0; row < size_px.y; ++row) {
        const auto from = static_cast<std::size_t>(row) * tile_width;
        for (std::size_t pixel = from; pixel < from + static_cast<std::size_t>(size_px.x); ++pixel) {
            scratch.owners[pixel] = scratch.place_of[truth.surface_of[pixel]];
        }
    }
    TileJob job;
    job.first_px = first_px;
    job.size_px = size_px;
    job.triangles = triangles;
    count_samples(job, lanes_, {scratch.keys, scratch.owners, &truth_surfaces_}, scratch.buffer);
    std::copy_n(scratch.buffer.sums[0].begin(), TileMiddles::pixels, truth.samples.begin());
}

glm::ivec2 Renderer::first_px_of(int tile) const {
    const int across = binner_.tiles().x;
    return glm::ivec2(tile % across, tile / across) * glm::ivec2(tile_width, tile_height);
}

void Renderer::write_tile(int tile, const TileTruth& truth, const scene::TruthArrays& to) const {
    const glm::ivec2 first_px = first_px_of(tile);
    const glm::ivec2 size_px = glm::min(glm::ivec2(tile_width, tile_height), size_px_ - first_px);
    for (int row = 0; row < size_px.y; ++row) {
        const std::uint16_t* const surface_of = truth.surface_of.data() + row * tile_width;
        const std::size_t first = byte_at(first_px.x, first_px.y + row) / 4;
        for (int column = 0; column < size_px.x;) {
            int end = column + 1;
            while (end < size_px.x && surface_of[end] == surface_of[column]) { ++end; }
            truth_surfaces_.write(truth.surfaces[surface_of[column]], {first_px.x + column, first_px.y + row},
                first + static_cast<std::size_t>(column), static_cast<std::size_t>(end - column), to);
            column = end;
        }
        if (to.coverage == nullptr) { continue; }
        for (int column = 0; column < size_px.x; ++column) {
            to.coverage[first + static_cast<std::size_t>(column)] =
                share_of_samples(truth.samples[static_cast<std::size_t>(row * tile_width + column)]);
        }
    }
}

/// Writes pixels that show other places of the picture, from tile_truths_.
void Renderer::write_at(std::span<const glm::vec2> at_px, const scene::TruthArrays& to) {
    constexpr std::size_t at_once = 4096;
    const int across = binner_.tiles().x;
    const auto tasks = static_cast<int>((at_px.size() + at_once - 1) / at_once);
    workers_->run(tasks, [&](int task, int) {
        const std::size_t first = static_cast<std::size_t>(task) * at_once;
        for (std::size_t pixel = first; pixel < std::min(first + at_once, at_px.size()); ++pixel) {
            const glm::vec2& at = at_px[pixel];
            const glm::vec2 end(size_px_);
            if (!(at.x >= -0.5F && at.y >= -0.5F && at.x < end.x - 0.5F && at.y < end.y - 0.5F)) {
                TruthSurfaces::write_unknown(pixel, to);
                continue;
            }
            const glm::ivec2 nearest = glm::min(glm::ivec2(at + 0.5F), size_px_ - 1);
            const glm::ivec2 tile = nearest / glm::ivec2(tile_width, tile_height);
            const glm::ivec2 in_tile = nearest - tile * glm::ivec2(tile_width, tile_height);
            const TileTruth& truth = *tile_truths_[static_cast<std::size_t>(tile.y * across + tile.x)];
            const auto place = static_cast<std::size_t>(in_tile.y * tile_width + in_tile.x);
            truth_surfaces_.write(truth.surfaces[truth.surface_of[place]], glm::dvec2(at), pixel, 1, to);
            if (to.coverage != nullptr) { to.coverage[pixel] = share_of_samples(truth.samples[place]); }
        }
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
