#pragma once

#include "visuals/raster/lit_ground_texture.h"
#include "visuals/raster/mesh_texture.h"
#include "visuals/raster/triangle_setup.h"
#include "visuals/raster/vertex_stage.h"
#include "visuals/scene/frame_plan.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::raster {

/// The maximum of triangles in a slice, and so in a task of one thread.
constexpr std::size_t batch_triangles = 2048;

/// Triangle::source: the number of its slice, and in the lowest bits that of the triangle in it.
constexpr unsigned source_index_bits = 11;
constexpr std::uint32_t source_index_mask = (1U << source_index_bits) - 1U;
static_assert(batch_triangles <= source_index_mask + 1U);

/// A frame plan, and the buffers that it refers to.
struct FrameInput {
    const scene::FramePlan& plan;
    std::span<const scene::ModelBuffers> models;
    LitGroundTexture* ground = nullptr; ///< null = no texture is loaded
    glm::ivec2 size_px{0};
    std::span<const std::vector<MeshTexture>> textures{}; ///< of each model; none = they show their colours
};

/// Vertices that the same function of vertex_stage.h projects, and their place in the list of all vertices.
struct VertexBlock {
    enum class Kind { Ground, Textured, Sky, Aircraft } kind = Kind::Ground;
    std::span<const models::ColourVertex> coloured;
    std::span<const scene::ModelVertex> of_model;
    AircraftDrawState state;
    std::size_t first = 0;
    std::size_t first_flat = 0; ///< index of the first among the vertices of aircraft
};

/// Triangles of one step.
struct DrawSlice {
    std::span<const std::uint32_t> indices{};
    DrawStyle style{};
    // Added to an index; may be negative.
    std::int64_t first_vertex = 0; ///< gives the index among all vertices
    std::int64_t first_flat = 0;   ///< gives the index among the vertices of aircraft
    bool is_aircraft = false;
    std::span<const MeshTexture> textures{}; ///< as scene::ModelBuffers
    scene::PolygonTints tints{};
    // What the truth of the picture needs.
    scene::PaintStep::Content content = scene::PaintStep::Content::Ground;
    std::span<const scene::ModelVertex> of_model{}; ///< what `indices` count in, of aircraft and refined meshes
    std::uint32_t first_part = 0;                   ///< as scene::AircraftDraw
    std::uint32_t object = 0;                       ///< as scene::AircraftDraw
};

/// The steps of a plan as slices in painting order, and the vertices that they index. Spans point into the plan and the
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
    void add_mesh(
        std::span<const std::span<const std::uint32_t>> ranges, const AircraftDrawState& state, DrawSlice slice);
    void add_slice(const DrawSlice& slice);

    std::vector<VertexBlock> blocks_;
    std::vector<DrawSlice> slices_;
    std::size_t vertex_count_ = 0;
    std::size_t flat_vertex_count_ = 0;
    std::int64_t first_sky_ = 0;
    bool has_own_colours_ = false; ///< some triangles on textured ground have colours of their own
    std::vector<std::span<const std::uint32_t>> ranges_; ///< of the aircraft at hand
};

} // namespace octant::visuals::raster
