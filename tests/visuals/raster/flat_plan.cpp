#include "tests/visuals/raster/flat_plan.h"

#include <array>
#include <cstddef>
#include <memory>

namespace octant::visuals::raster {

std::vector<FlatTriangle> sheet(const glm::ivec2& size_px, const glm::ivec2& cell_px,
    const std::function<double(const glm::dvec2&)>& inverse_depth, std::uint32_t colour) {
    std::vector<FlatTriangle> triangles;
    for (int y = 0; y < size_px.y; y += cell_px.y) {
        for (int x = 0; x < size_px.x; x += cell_px.x) {
            const glm::ivec2 end(x + cell_px.x, y + cell_px.y);
            for (const std::array<glm::ivec2, 3>& at_px :
                {std::array{glm::ivec2(x, y), glm::ivec2(end.x, y), glm::ivec2(x, end.y)},
                    std::array{glm::ivec2(end.x, y), end, glm::ivec2(x, end.y)}}) {
                FlatTriangle& triangle = triangles.emplace_back();
                triangle.colour.fill(colour);
                for (std::size_t i = 0; i < 3; ++i) {
                    triangle.at_px[i] = glm::vec2(at_px[i]);
                    triangle.depth_m[i] = static_cast<float>(1.0 / inverse_depth(glm::dvec2(at_px[i])));
                }
            }
        }
    }
    return triangles;
}

void add_square(scene::ModelBuffers& model, float half_m, float z_m, std::uint32_t colour) {
    const auto first = static_cast<std::uint32_t>(model.vertices.size());
    for (const glm::vec2 at : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
        scene::ModelVertex& vertex = model.vertices.emplace_back();
        vertex.position_m = glm::vec3(half_m * at, z_m);
        vertex.normal = vertex.face_normal = glm::vec3(0.0F, 0.0F, 1.0F);
        vertex.colour = vertex.face_colour = colour;
    }
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) { model.indices.push_back(first + corner); }
}

FlatPlan::FlatPlan(const glm::ivec2& size_px) : size_px_(size_px) {
    plan_.view_to_clip = glm::mat4(0.0F);
    plan_.view_to_clip[0][0] = 1.0F;
    plan_.view_to_clip[1][1] = 1.0F;
    plan_.view_to_clip[2][3] = -1.0F;
    plan_.view_to_clip[3][2] = 1.0F; // near plane, metres
}

void FlatPlan::paint(const std::vector<FlatTriangle>& triangles, scene::DepthUse depth, std::uint32_t clip) {
    const auto first = static_cast<std::uint32_t>(indices_.size());
    for (const FlatTriangle& triangle : triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const float depth_m = triangle.depth_m[i];
            const glm::vec2 share = triangle.at_px[i] / glm::vec2(size_px_) * 2.0F - 1.0F;
            indices_.push_back(static_cast<std::uint32_t>(vertices_.size()));
            vertices_.push_back({{share.x * depth_m, -share.y * depth_m, -depth_m}, triangle.colour[i]});
        }
    }
    const auto count = static_cast<std::uint32_t>(indices_.size()) - first;
    plan_.steps.push_back({scene::PaintStep::Content::Ground, first, count, clip, depth});
}

scene::FramePlan& FlatPlan::plan() {
    plan_.ground = {vertices_, indices_};
    return plan_;
}

scene::DetailTexture strong_detail() {
    const scene::LandCover dark{glm::vec3(0.2F, 0.25F, 0.15F), 0.1F};
    const scene::LandCover bright{glm::vec3(0.6F, 0.55F, 0.5F), 0.1F};
    return {{glm::vec3(0.2F, 0.6F, 0.3F), glm::vec3(0.9F, 0.1F, 0.8F), glm::vec3(0.4F, 0.7F, 0.1F), glm::vec3(0.5F),
                glm::vec3(0.8F, 0.3F, 0.6F), glm::vec3(0.1F, 0.4F, 0.9F), glm::vec3(0.6F, 0.2F, 0.7F),
                glm::vec3(0.3F, 0.5F, 0.2F)},
        std::make_shared<const scene::LandCoverContrast>(
            std::array{dark, bright, dark, bright}, scene::detail_pattern(2.0))};
}

scene::Picture drawn(const scene::FramePlan& plan, const glm::ivec2& size_px, int samples, int threads,
    const scene::GroundTexture* texture, std::span<const scene::ModelBuffers> models) {
    Renderer renderer(std::make_shared<ThreadPool>(threads), size_px, samples);
    renderer.load_models(models);
    if (texture != nullptr) { renderer.load_ground_texture(*texture); }
    scene::Picture picture;
    renderer.draw(plan);
    renderer.finish_and_read(picture);
    return picture;
}

std::uint64_t below(RandomGenerator& dice, std::uint64_t most) {
    return static_cast<std::uint64_t>(dice.next() * static_cast<double>(most));
}

glm::ivec3 pixel(const scene::Picture& picture, int x, int y) {
    const std::size_t at =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
    return {picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2]};
}

int count_of(const scene::Picture& picture, const glm::ivec3& colour) {
    int count = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) { count += pixel(picture, x, y) == colour ? 1 : 0; }
    }
    return count;
}

} // namespace octant::visuals::raster
