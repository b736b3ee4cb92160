#pragma once

#include "sim/base/thread_pool.h"
#include "visuals/raster/lit_ground_texture.h"
#include "visuals/raster/projection.h"
#include "visuals/raster/tile.h"
#include "visuals/raster/triangle_setup.h"
#include "visuals/raster/vertex_stage.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/model_buffers.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace octant::visuals::raster {

/// Triangles of one slice, and so of one task, at most.
constexpr std::size_t batch_triangles = 2048;

/// Inputs of a plan's triangles other than the plan.
struct FrameInput {
    const scene::FramePlan& plan;
    std::span<const scene::ModelBuffers> models;
    LitGroundTexture* ground = nullptr; ///< none loaded
    glm::ivec2 size_px{0};
};

/// Corners that are placed alike, and where they go in the list of all corners.
struct VertexBlock {
    enum class Kind { Ground, Textured, Sky, Aircraft } kind = Kind::Ground;
    std::span<const models::ColourVertex> coloured;
    std::span<const scene::ModelVertex> of_model;
    AircraftDrawState look;
    std::size_t first = 0;
    std::size_t first_flat = 0; ///< among those of aircraft alone
};

/// Triangles of one step.
struct DrawSlice {
    std::span<const std::uint32_t> indices;
    DrawStyle style;
    // What is added to an index for its place, which may be less than nothing.
    std::int64_t first_vertex = 0; ///< among all corners
    std::int64_t first_flat = 0;   ///< among those of aircraft
    bool is_aircraft = false;
};

/// The steps of a plan as slices in painting order, and the corners that they name. Spans point into the plan and the
/// models.
class FrameDraws {
public:
    void collect(const FrameInput& input);

    const std::vector<VertexBlock>& blocks() const { return blocks_; }

    const std::vector<DrawSlice>& slices() const { return slices_; }

    std::size_t vertex_count() const { return vertex_count_; }

    std::size_t flat_vertex_count() const { return flat_vertex_count_; }

private:
    void add_step(const FrameInput& input, const scene::PaintStep& step, DrawStyle style);
    void add_on_ground(VertexBlock::Kind ground, std::span<const models::ColourVertex> corners);
    void add_ground(const scene::FramePlan& plan, std::span<const std::uint32_t> indices, DrawStyle style);
    VertexBlock& add_block(VertexBlock::Kind kind, std::size_t corners);
    void add_aircraft(const FrameInput& input, const scene::AircraftDraw& draw, const DrawStyle& style);
    void add_mesh(std::span<const std::span<const std::uint32_t>> ranges, std::span<const scene::ModelVertex> vertices,
        const AircraftDrawState& look, const DrawStyle& style);
    void add_slice(const DrawSlice& slice);

    std::vector<VertexBlock> blocks_;
    std::vector<DrawSlice> slices_;
    std::size_t vertex_count_ = 0;
    std::size_t flat_vertex_count_ = 0;
    std::int64_t first_sky_ = 0;
    bool has_paint_ = false;                             ///< on textured ground
    std::vector<std::span<const std::uint32_t>> ranges_; ///< of the aircraft at hand
};

/// The triangles of one picture, sorted into tiles. Keeps its memory from picture to picture.
///
/// A plan becomes slices: triangles of one step with one list of corners. Corners are placed by all threads, then
/// slices in batches of about two thousand triangles are set up and binned, each batch by itself; since batches follow
/// each other in painting order, so do the triangles of a tile, on however many threads.
class TriangleBinner {
public:
    TriangleBinner(const SamplePattern& samples, ThreadPool& workers) : samples_(samples), workers_(workers) {}

    /// The plan's memory is not read any more after this.
    void prepare(const FrameInput& input);

    /// Samples of the pictures that follow.
    void use(const SamplePattern& samples) { samples_ = samples; }

    glm::ivec2 tiles() const { return tiles_; }

    const Light& light() const { return light_; }

    /// For a plan with a detail texture.
    const DetailRays& detail_rays() const { return detail_rays_; }

    /// Triangles that may cover a tile, in painting order; valid until `list` is used again.
    std::span<const TileTriangle> triangles_of(int tile, std::vector<TileTriangle>& list) const;

    /// The same of what lies over the picture.
    std::span<const TileTriangle> overlay_of(int tile, std::vector<TileTriangle>& list) const;

private:
    /// Slices first .. end - 1, and what became of them.
    struct Batch {
        std::size_t first = 0;
        std::size_t end = 0;
        TriangleList list;
        std::vector<std::uint32_t> tile_first; ///< for each tile, and one more
        std::vector<std::uint32_t> by_tile;    ///< indices of triangles
    };

    void make_batches();
    void project_vertices(const FrameInput& input);
    void set_up(const FrameInput& input, Batch& batch, TriangleSetup& setup);
    void set_up_overlay(const FrameInput& input);
    void bin(Batch& batch) const;
    void append(const Batch& batch, int tile, std::vector<TileTriangle>& list) const;

    SamplePattern samples_;
    ThreadPool& workers_;
    Projection projection_;
    Light light_;
    DetailRays detail_rays_;
    glm::ivec2 tiles_{0};
    FrameDraws slices_;
    std::vector<ScreenVertex> vertices_;
    std::vector<ClipPosition> clip_;
    std::vector<FlatColour> flat_;
    std::vector<LitVertex> lit_; ///< as vertices_, where pixels are lit; else empty
    std::vector<std::unique_ptr<Batch>> batches_;
    std::size_t batch_count_ = 0;
    Batch overlay_;
};

} // namespace octant::visuals::raster
