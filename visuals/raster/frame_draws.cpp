// Step 1 of a picture (renderer.cpp): the steps of a FramePlan become slices of triangles in painting order, and blocks
// of vertices that are projected alike. Next: vertex_stage.cpp.
#include "visuals/raster/frame_draws.h"

#include "visuals/scene/frame_plan.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

namespace octant::visuals::raster {

using scene::FramePlan;
using scene::PaintStep;

namespace {

/// The depth group of each step, from 1; 0 = drawn without depth. A group begins where depth is cleared, or where it is
/// first used, and ends with the last step that uses it before it is cleared again; what is drawn without depth in
/// between belongs to it, since its samples may be drawn over.
std::vector<std::uint16_t> depth_groups(std::span<const scene::PaintStep> steps) {
    std::vector<std::uint16_t> groups(steps.size(), 0);
    std::uint16_t group = 1;
    std::size_t last = steps.size(); // that used this group's depth; none yet
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (steps[i].content == PaintStep::Content::ClearDepth) {
            ++group;
            last = steps.size();
        } else if (steps[i].depth != scene::DepthUse::None) {
            const std::size_t from = last == steps.size() ? i : last + 1;
            std::fill(groups.begin() + static_cast<std::ptrdiff_t>(from),
                groups.begin() + static_cast<std::ptrdiff_t>(i + 1), group);
            last = i;
        }
    }
    return groups;
}

/// Refined meshes of tests have no model.
std::span<const MeshTexture> textures_of(const FrameInput& input, std::uint32_t model) {
    if (model >= input.textures.size()) { return {}; }
    return input.textures[model];
}

/// Whether a corner of textured ground has its own colour: FramePlan::ground_texture.
bool has_own_colour(const models::ColourVertex& vertex) { return vertex.colour >> 24U == 0; }

} // namespace

/// Ground, shadows and sky have one list of corners each; their slices are the steps.
void FrameDraws::collect(const FrameInput& input) {
    const FramePlan& plan = input.plan;
    blocks_.clear();
    slices_.clear();
    vertex_count_ = 0;
    flat_vertex_count_ = 0;
    using Kind = VertexBlock::Kind;
    assert(!plan.ground_texture || input.ground != nullptr);
    const Kind ground = plan.ground_texture ? Kind::Textured : Kind::Ground;
    add_block(ground, plan.ground.vertices.size()).coloured = plan.ground.vertices;
    has_own_colours_ = false;
    add_on_ground(ground, plan.shadow_vertices);
    first_sky_ = static_cast<std::int64_t>(vertex_count_);
    add_block(Kind::Sky, plan.sky.vertices.size()).coloured = plan.sky.vertices;
    const std::vector<std::uint16_t> groups = depth_groups(plan.steps);
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        const PaintStep& step = plan.steps[i];
        DrawStyle style{.fill = Fill::Gouraud, .depth = step.depth, .group = groups[i]};
        style.opacity = step.opacity;
        if (step.clip != PaintStep::no_clip) {
            const scene::Clip& clip = plan.clips[step.clip];
            style.clip_planes = std::span(clip.planes).first(static_cast<std::size_t>(clip.count));
        }
        add_step(input, step, style);
    }
}

void FrameDraws::add_step(const FrameInput& input, const PaintStep& step, DrawStyle style) {
    const FramePlan& plan = input.plan;
    switch (step.content) {
    case PaintStep::Content::ClearDepth:
    case PaintStep::Content::Overlay:
        break;
    case PaintStep::Content::Transparent:
        style.fill = Fill::Transparent;
        style.is_cloud = step.first >= plan.truth.first_cloud_index &&
                         step.first - plan.truth.first_cloud_index < plan.truth.cloud_index_count;
        add_slice({.indices = plan.overlay.indices.subspan(step.first, step.count),
            .style = style,
            .content = PaintStep::Content::Transparent});
        break;
    case PaintStep::Content::Sky:
        style.has_detail_texture = plan.detail_texture.has_value();
        style.is_sky = true;
        style.is_land = true;
        add_slice({.indices = plan.sky.indices.subspan(step.first, step.count),
            .style = style,
            .first_vertex = first_sky_,
            .content = PaintStep::Content::Sky});
        break;
    case PaintStep::Content::Ground:
        add_ground(plan, plan.ground.indices.subspan(step.first, step.count), style);
        break;
    case PaintStep::Content::GroundRepaint:
        add_ground(plan, std::span(plan.repaint_indices).subspan(step.first, step.count), style);
        break;
    case PaintStep::Content::Aircraft:
        style.culls_back_faces = true;
        for (std::uint32_t i = step.first; i < step.first + step.count; ++i) {
            add_aircraft(input, plan.aircraft[i], style);
        }
        break;
    case PaintStep::Content::Refined:
        style.culls_back_faces = true;
        for (std::uint32_t i = step.first; i < step.first + step.count; ++i) {
            const scene::RefinedDraw& draw = plan.refined[i];
            const AircraftDrawState state{std::span(plan.parts).subspan(draw.first_part),
                std::span(plan.smooth).subspan(draw.first_smooth), draw.tints, !textures_of(input, draw.model).empty()};
            add_mesh(std::array{draw.indices}, state,
                {.style = style,
                    .is_aircraft = true,
                    .textures = textures_of(input, draw.model),
                    .tints = draw.tints,
                    .content = PaintStep::Content::Refined,
                    .of_model = draw.vertices,
                    .first_part = draw.first_part,
                    .object = draw.object});
        }
        break;
    }
}

/// Corners of what lies on the ground, whose numbers follow those of the ground's own. On textured ground each run of
/// them that have their own colours is a block.
void FrameDraws::add_on_ground(VertexBlock::Kind ground, std::span<const models::ColourVertex> corners) {
    while (!corners.empty()) {
        const bool is_own_colour = ground == VertexBlock::Kind::Textured && has_own_colour(corners[0]);
        const auto end = std::ranges::find_if(corners, [&](const models::ColourVertex& corner) {
            return ground == VertexBlock::Kind::Textured && has_own_colour(corner) != is_own_colour;
        });
        const auto count = static_cast<std::size_t>(end - corners.begin());
        add_block(is_own_colour ? VertexBlock::Kind::Ground : ground, count).coloured = corners.first(count);
        corners = corners.subspan(count);
        has_own_colours_ = has_own_colours_ || is_own_colour;
    }
}

void FrameDraws::add_ground(const FramePlan& plan, std::span<const std::uint32_t> indices, DrawStyle style) {
    const bool shows_mesh = plan.mesh_display != scene::MeshDisplay::None;
    const Fill usual = shows_mesh ? Fill::MeshEdges : plan.ground_texture ? Fill::TextureInPerspective : Fill::Gouraud;
    const std::size_t own = plan.ground.vertices.size();
    const auto is_own_colour = [&](std::size_t i) {
        return indices[i] >= own && has_own_colour(plan.shadow_vertices[indices[i] - own]);
    };
    style.is_land = true;
    std::size_t first = 0;
    while (first < indices.size()) {
        const bool painted = has_own_colours_ && is_own_colour(first);
        std::size_t end = has_own_colours_ ? first + 3 : indices.size();
        while (end < indices.size() && is_own_colour(end) == painted) { end += 3; }
        style.fill = painted && !shows_mesh ? Fill::Gouraud : usual;
        style.has_detail_texture = style.fill == Fill::Gouraud && plan.detail_texture;
        add_slice({.indices = indices.subspan(first, end - first), .style = style});
        first = end;
    }
}

VertexBlock& FrameDraws::add_block(VertexBlock::Kind kind, std::size_t corners) {
    VertexBlock& block = blocks_.emplace_back();
    block.kind = kind;
    block.first = vertex_count_;
    block.first_flat = flat_vertex_count_;
    vertex_count_ += corners;
    flat_vertex_count_ += kind == VertexBlock::Kind::Aircraft ? corners : 0;
    return block;
}

void FrameDraws::add_aircraft(const FrameInput& input, const scene::AircraftDraw& draw, const DrawStyle& style) {
    const scene::ModelBuffers& model = input.models[draw.model];
    const AircraftDrawState state{std::span(input.plan.parts).subspan(draw.first_part),
        std::span(input.plan.smooth).subspan(draw.first_smooth), draw.tints, !textures_of(input, draw.model).empty()};
    const std::span<const std::uint32_t> all(model.indices);
    const DrawSlice slice{.style = style,
        .is_aircraft = true,
        .textures = textures_of(input, draw.model),
        .tints = draw.tints,
        .content = PaintStep::Content::Aircraft,
        .of_model = model.vertices,
        .first_part = draw.first_part,
        .object = draw.object};
    if (draw.ranges.empty()) {
        const auto indices = all.subspan(draw.first_index, draw.index_count);
        add_mesh(std::array{indices}, state, slice);
        return;
    }
    ranges_.clear();
    for (const scene::IndexRange& range : draw.ranges) {
        ranges_.push_back(all.subspan(range.first_index, range.index_count));
    }
    add_mesh(ranges_, state, slice);
}

/// Adds triangles of an aircraft. The corners between the first and the last that they name are projected once for all
/// ranges, because an order that splits polygons may paint thousands of ranges.
void FrameDraws::add_mesh(
    std::span<const std::span<const std::uint32_t>> ranges, const AircraftDrawState& state, DrawSlice slice) {
    std::uint32_t min = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t max = 0;
    for (const std::span<const std::uint32_t> indices : ranges) {
        for (const std::uint32_t index : indices) {
            min = std::min(min, index);
            max = std::max(max, index);
        }
    }
    if (min > max) {
        return; // no triangles
    }
    VertexBlock& block = add_block(VertexBlock::Kind::Aircraft, max - min + 1);
    block.of_model = slice.of_model.subspan(min, max - min + 1);
    block.state = state;
    slice.first_vertex = static_cast<std::int64_t>(block.first) - min;
    slice.first_flat = static_cast<std::int64_t>(block.first_flat) - min;
    for (const std::span<const std::uint32_t> indices : ranges) {
        slice.indices = indices;
        add_slice(slice);
    }
}

void FrameDraws::add_slice(const DrawSlice& slice) {
    constexpr std::size_t max = 3 * batch_triangles;
    for (std::size_t first = 0; first < slice.indices.size(); first += max) {
        DrawSlice& part = slices_.emplace_back(slice);
        part.indices = slice.indices.subspan(first, std::min(max, slice.indices.size() - first));
    }
}

} // namespace octant::visuals::raster
