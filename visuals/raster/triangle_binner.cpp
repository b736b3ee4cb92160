// Step 4 of a picture (renderer.cpp): runs step 1 on the calling thread, then step 2 on all threads in tasks of
// vertices, then step 3 on all threads in batches of slices, and sorts the triangles of each batch into tiles. Next:
// tile_painter.cpp.
#include "visuals/raster/triangle_binner.h"

#include "visuals/scene/frame_plan.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <hwy/cache_control.h>
#include <span>
#include <vector>

namespace octant::visuals::raster {

using scene::FramePlan;
using scene::PaintStep;

namespace {

constexpr std::size_t task_vertices = 2048;

/// A corner of the overlay at its place in the picture. `near_m`: the distance of the near plane.
ScreenVertex overlay_vertex(const scene::OverlayVertex& from, float near_m) {
    constexpr float max_distance_px = 16000.0F;
    ScreenVertex vertex;
    if (!(std::abs(from.at_px.x) <= max_distance_px && std::abs(from.at_px.y) <= max_distance_px)) {
        vertex.outcode = beyond_range;
        return vertex;
    }
    constexpr auto steps = static_cast<float>(ScreenVertex::per_px);
    vertex.x = static_cast<std::int32_t>(std::lrintf((from.at_px.x - 0.5F) * steps));
    vertex.y = static_cast<std::int32_t>(std::lrintf((from.at_px.y - 0.5F) * steps));
    vertex.inverse_w = from.depth / near_m;
    for (std::size_t i = 0; i < vertex.value.size(); ++i) {
        vertex.value[i] = static_cast<float>(from.colour >> (8 * i) & 0xffU);
    }
    return vertex;
}

/// Appends triangles of the overlay. `source`: of the first.
void add_overlay(const scene::OverlayDraw& overlay, std::span<const std::uint32_t> indices, std::uint32_t source,
    TriangleSetup& setup, TriangleList& list) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        setup.set_source(source++);
        std::array<ScreenVertex, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = overlay_vertex(overlay.vertices[indices[i + k]], setup.near_m());
        }
        setup.add_overlay(corners[0], corners[1], corners[2], list);
    }
}

/// Says which texture a triangle has that is added next.
void set_surface(const std::array<std::uint32_t, 3>& corners, const DrawSlice& slice, const FlatColour& flat,
    TriangleSurface& surface, TriangleSetup& setup) {
    const std::uint32_t texture = slice.of_model[corners[0]].texture;
    if (texture == 0 || (flat.is_smooth() ? slice.tints.smooth : slice.tints.flat) != 0) {
        setup.set_surface(nullptr);
        return;
    }
    surface.texture = &slice.textures[texture - 1];
    for (std::size_t k = 0; k < 3; ++k) { surface.places[k] = slice.of_model[corners[k]].on_texture; }
    setup.set_surface(&surface);
}

/// Prefetches the vertices of a triangle that is set up later, which lie anywhere in their model.
void prefetch_places(const DrawSlice& slice, std::size_t first_index) {
    constexpr std::size_t ahead = std::size_t{3} * 8;
    for (std::size_t i = first_index + ahead; i < std::min(first_index + ahead + 3, slice.indices.size()); ++i) {
        hwy::Prefetch(&slice.of_model[slice.indices[i]].texture);
    }
}

/// How often the ground's sample spacing is doubled to reach the longest edge of a triangle: log2 of their ratio.
float mesh_level(const glm::vec3& a_m, const glm::vec3& b_m, const glm::vec3& c_m, float sample_spacing_m) {
    const auto across_m = [](const glm::vec3& from_m, const glm::vec3& to_m) {
        return glm::length(glm::vec2(to_m - from_m));
    };
    const float longest_m = std::max({across_m(a_m, b_m), across_m(b_m, c_m), across_m(c_m, a_m)});
    return std::log2(std::max(longest_m / sample_spacing_m, 1.0F));
}

} // namespace

void TriangleBinner::prepare(const FrameInput& input) {
    projection_ = projection_of(input.plan, input.size_px);
    light_ = light_of(input.plan);
    detail_rays_ = input.plan.detail_texture ? raster::detail_rays(input.plan, projection_) : DetailRays();
    tiles_ = (input.size_px + glm::ivec2(tile_width - 1, tile_height - 1)) / glm::ivec2(tile_width, tile_height);
    draws_.collect(input);
    vertices_.resize(draws_.vertex_count());
    clip_.resize(draws_.vertex_count());
    flat_.resize(draws_.flat_vertex_count());
    lit_.resize(input.plan.lights_pixels ? draws_.vertex_count() : 0);
    project_vertices(input);
    make_batches();
    std::vector<TriangleSetup> setups(static_cast<std::size_t>(workers_.threads()),
        TriangleSetup(
            projection_, input.plan, samples_, input.plan.ground_texture ? input.ground->levels().size() : 0));
    workers_.run(static_cast<int>(batch_count_), [&](int batch, int thread) {
        set_up(input, *batches_[static_cast<std::size_t>(batch)], setups[static_cast<std::size_t>(thread)]);
    });
    set_up_overlay(input);
}

void TriangleBinner::project_vertices(const FrameInput& input) {
    struct Task {
        const VertexBlock* block = nullptr;
        std::size_t from = 0;
        std::size_t count = 0;
    };

    std::vector<Task> tasks;
    for (const VertexBlock& block : draws_.blocks()) {
        const std::size_t corners = std::max(block.coloured.size(), block.of_model.size());
        for (std::size_t from = 0; from < corners; from += task_vertices) {
            tasks.push_back({&block, from, std::min(task_vertices, corners - from)});
        }
    }
    TexelTransform to_texels;
    if (input.plan.ground_texture) {
        input.ground->light(light_);
        to_texels = input.ground->texel_transform(input.plan.ground_texture->albedo);
    }
    Light clear_sky = light_;
    clear_sky.per_m = 0.0F;
    workers_.run(static_cast<int>(tasks.size()), [&](int number, int) {
        const Task& task = tasks[static_cast<std::size_t>(number)];
        const VertexBlock& block = *task.block;
        VertexOutputs to{std::span(vertices_).subspan(block.first + task.from, task.count),
            std::span(clip_).subspan(block.first + task.from, task.count), {}};
        switch (block.kind) {
        case VertexBlock::Kind::Ground:
            project_coloured(block.coloured.subspan(task.from, task.count), projection_, light_, to);
            break;
        case VertexBlock::Kind::Sky:
            project_coloured(block.coloured.subspan(task.from, task.count), projection_, clear_sky, to);
            break;
        case VertexBlock::Kind::Textured:
            project_textured(block.coloured.subspan(task.from, task.count), projection_, light_, to_texels, to);
            break;
        case VertexBlock::Kind::Aircraft:
            to.flat = std::span(flat_).subspan(block.first_flat + task.from, task.count);
            if (!lit_.empty()) { to.lit = std::span(lit_).subspan(block.first + task.from, task.count); }
            project_aircraft(block.of_model.subspan(task.from, task.count), block.state, projection_, light_, to);
            break;
        }
    });
}

void TriangleBinner::make_batches() {
    batch_count_ = 0;
    std::size_t indices = 0;
    const std::vector<DrawSlice>& slices = draws_.slices();
    for (std::size_t i = 0; i < slices.size(); ++i) {
        if (batch_count_ == 0 || indices + slices[i].indices.size() > 3 * batch_triangles) {
            if (batch_count_ == batches_.size()) { batches_.push_back(std::make_unique<Batch>()); }
            batches_[batch_count_]->first = i;
            ++batch_count_;
            indices = 0;
        }
        indices += slices[i].indices.size();
        batches_[batch_count_ - 1]->end = i + 1;
    }
}

void TriangleBinner::set_up(const FrameInput& input, Batch& batch, TriangleSetup& setup) {
    batch.list.triangles.clear();
    batch.list.extras.clear();
    batch.list.surfaces.clear();
    const FramePlan& plan = input.plan;
    const auto position_m = [&](std::uint32_t index) {
        return index < plan.ground.vertices.size()
                   ? plan.ground.vertices[index].position_m
                   : plan.shadow_vertices[index - plan.ground.vertices.size()].position_m;
    };
    for (std::size_t s = batch.first; s < batch.end; ++s) {
        const DrawSlice& slice = draws_.slices()[s];
        setup.begin_step(slice.style);
        assert(s >> (32U - source_index_bits) == 0);
        auto source = static_cast<std::uint32_t>(s << source_index_bits);
        if (slice.style.fill == Fill::Transparent) {
            add_overlay(plan.overlay, slice.indices, source, setup, batch.list);
            continue;
        }
        const VertexOutputs corners{vertices_, clip_, {}, lit_};
        TriangleSurface surface;
        if (!slice.textures.empty()) { surface.haze = haze_before(glm::vec3(plan.parts[slice.first_part][3]), light_); }
        const auto vertex = [&](std::uint32_t index) { return static_cast<std::uint32_t>(slice.first_vertex + index); };
        for (std::size_t i = 0; i + 2 < slice.indices.size(); i += 3) {
            const std::uint32_t a = slice.indices[i];
            const std::uint32_t b = slice.indices[i + 1];
            const std::uint32_t c = slice.indices[i + 2];
            if (slice.style.fill == Fill::MeshEdges) {
                setup.set_mesh_level(mesh_level(position_m(a), position_m(b), position_m(c), plan.sample_spacing_m));
            }
            setup.set_source(source++);
            const FlatColour* const flat =
                slice.is_aircraft ? &flat_[static_cast<std::size_t>(slice.first_flat + a)] : nullptr;
            if (slice.style.culls_back_faces && flat != nullptr && flat->is_back_facing()) { continue; }
            if (!slice.textures.empty()) {
                prefetch_places(slice, i);
                set_surface({a, b, c}, slice, *flat, surface, setup);
            }
            setup.add(corners, {vertex(a), vertex(b), vertex(c)}, flat, batch.list);
        }
        setup.set_surface(nullptr);
    }
    bin(batch);
}

void TriangleBinner::set_up_overlay(const FrameInput& input) {
    overlay_.list.triangles.clear();
    overlay_.list.extras.clear();
    const scene::OverlayDraw& overlay = input.plan.overlay;
    std::size_t first = overlay.indices.size();
    std::size_t end = 0;
    for (const PaintStep& step : input.plan.steps) {
        if (step.content == PaintStep::Content::Overlay) {
            first = std::min<std::size_t>(first, step.first);
            end = std::max<std::size_t>(end, std::size_t{step.first} + step.count);
        }
    }
    TriangleSetup setup(projection_, input.plan, samples_, 0);
    setup.begin_step({});
    if (first < end) { add_overlay(overlay, overlay.indices.subspan(first, end - first), 0, setup, overlay_.list); }
    bin(overlay_);
}

/// Counts the triangles of each tile, then writes them there.
void TriangleBinner::bin(Batch& batch) const {
    const auto tiles = static_cast<std::size_t>(tiles_.x) * static_cast<std::size_t>(tiles_.y);
    batch.tile_first.assign(tiles + 1, 0);
    const auto across = static_cast<std::uint32_t>(tiles_.x);
    const auto for_each_tile = [&](const Triangle& triangle, const auto& visit) {
        const auto number = [](std::int32_t px, int size_px) {
            return static_cast<std::uint32_t>(px) / static_cast<std::uint32_t>(size_px);
        };
        const std::uint32_t first_x = number(triangle.left, tile_width);
        const std::uint32_t last_x = number(triangle.right, tile_width);
        const std::uint32_t last_y = number(triangle.last_row, tile_height);
        for (std::uint32_t y = number(triangle.first_row, tile_height); y <= last_y; ++y) {
            for (std::uint32_t x = first_x; x <= last_x; ++x) { visit(y * across + x); }
        }
    };
    for (const Triangle& triangle : batch.list.triangles) {
        for_each_tile(triangle, [&](std::size_t tile) { ++batch.tile_first[tile + 1]; });
    }
    for (std::size_t tile = 0; tile < tiles; ++tile) { batch.tile_first[tile + 1] += batch.tile_first[tile]; }
    batch.by_tile.resize(batch.tile_first[tiles]);
    for (std::uint32_t i = 0; i < batch.list.triangles.size(); ++i) {
        const Triangle& triangle = batch.list.triangles[i];
        const bool is_plain = triangle.extra == Triangle::none && triangle.surface == Triangle::none;
        const std::uint32_t number = 2 * i + (is_plain ? 0 : 1);
        for_each_tile(triangle, [&](std::size_t tile) { batch.by_tile[batch.tile_first[tile]++] = number; });
    }
    // Each place has moved to the beginning of the next tile.
    for (std::size_t tile = tiles; tile > 0; --tile) { batch.tile_first[tile] = batch.tile_first[tile - 1]; }
    batch.tile_first[0] = 0;
}

void TriangleBinner::append(const Batch& batch, int tile, std::vector<TileTriangle>& list) const {
    const auto i = static_cast<std::size_t>(tile);
    for (std::uint32_t k = batch.tile_first[i]; k < batch.tile_first[i + 1]; ++k) {
        const std::uint32_t number = batch.by_tile[k];
        TileTriangle one{.triangle = &batch.list.triangles[number / 2]};
        if (number % 2 != 0) {
            const std::uint32_t extra = one.triangle->extra;
            const std::uint32_t surface = one.triangle->surface;
            if (extra != Triangle::none) { one.extra = &batch.list.extras[extra]; }
            if (surface != Triangle::none) { one.surface = &batch.list.surfaces[surface]; }
        }
        list.push_back(one);
    }
}

std::span<const TileTriangle> TriangleBinner::triangles_of(int tile, std::vector<TileTriangle>& list) const {
    list.clear();
    for (std::size_t i = 0; i < batch_count_; ++i) { append(*batches_[i], tile, list); }
    return list;
}

std::span<const TileTriangle> TriangleBinner::overlay_of(int tile, std::vector<TileTriangle>& list) const {
    list.clear();
    append(overlay_, tile, list);
    return list;
}

} // namespace octant::visuals::raster
