#pragma once

#include "sim/base/thread_pool.h"
#include "visuals/raster/frame_draws.h"
#include "visuals/raster/projection.h"
#include "visuals/raster/tile.h"
#include "visuals/raster/triangle_setup.h"
#include "visuals/raster/vertex_stage.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace octant::visuals::raster {

/// The triangles of one picture, sorted into tiles. Keeps its memory from picture to picture.
///
/// A plan becomes slices: triangles of one step with one list of corners. Corners are placed by all threads, then
/// slices in batches of about two thousand triangles are set up and binned, each batch by itself; since batches follow
/// each other in painting order, so do the triangles of a tile, on however many threads.
class TriangleBinner {
public:
    TriangleBinner(const SamplePattern& samples, ThreadPool& workers) : samples_(samples), workers_(workers) {}

    /// The plan's memory is not read any more after this, except through draws().
    void prepare(const FrameInput& input);

    /// Samples of the pictures that follow.
    void use(const SamplePattern& samples) { samples_ = samples; }

    glm::ivec2 tiles() const { return tiles_; }

    const Light& light() const { return light_; }

    /// The slices that Triangle::source counts. They refer to the memory of the plan.
    const FrameDraws& draws() const { return draws_; }

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
        /// Twice the indices of triangles, and one where a triangle has an extra or a surface: of the others nothing is
        /// read, which lie far apart, until they are painted.
        std::vector<std::uint32_t> by_tile;
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
    FrameDraws draws_;
    std::vector<ScreenVertex> vertices_;
    std::vector<ClipPosition> clip_;
    std::vector<FlatColour> flat_;
    std::vector<LitVertex> lit_; ///< as vertices_, where pixels are lit; else empty
    std::vector<std::unique_ptr<Batch>> batches_;
    std::size_t batch_count_ = 0;
    Batch overlay_;
};

} // namespace octant::visuals::raster
