#include "tests/visuals/gl/small_scene.h"

#include "sim/base/hash.h"
#include "visuals/gl/bare_grid.h"

#include <glm/gtc/matrix_transform.hpp>

namespace octant::tests {
namespace {

/// A box of six faces with its own colours, triangles facing outwards.
scene::ModelBuffers box_model(const glm::vec3& half_m) {
    scene::ModelBuffers model;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0F, 1.0F}) {
            glm::vec3 normal(0.0F);
            glm::vec3 right(0.0F);
            normal[axis] = side;
            right[(axis + 1) % 3] = 1.0F;
            const glm::vec3 up = glm::cross(normal, right);
            const auto first = static_cast<std::uint32_t>(model.vertices.size());
            const std::uint32_t colour = models::packed_colour(0.5F + 0.3F * (normal + right));
            for (const glm::vec3& corner : {-right - up, right - up, right + up, up - right}) {
                model.vertices.push_back({half_m * (normal + corner), normal, normal, colour, colour});
            }
            for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) { model.indices.push_back(first + corner); }
        }
    }
    return model;
}

} // namespace

void append(scene::ModelBuffers& model, const scene::ModelBuffers& other) {
    const auto first = static_cast<std::uint32_t>(model.vertices.size());
    model.vertices.insert(model.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const std::uint32_t index : other.indices) { model.indices.push_back(first + index); }
}

scene::FramePlan framed(scene::FramePlan plan, HiddenSurfaceMode mode, int shadow_indices) {
    using Content = scene::PaintStep::Content;
    using scene::DepthUse;
    constexpr std::uint32_t whole = scene::PaintStep::no_clip;
    const auto size = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
    const scene::PaintStep overlay{Content::Overlay, 0, size(plan.overlay.indices)};
    if (mode == HiddenSurfaceMode::InOrder) {
        std::vector<scene::PaintStep> steps{
            {Content::Sky, 0, size(plan.sky.indices)}, {Content::Ground, 0, size(plan.ground.indices)}};
        steps.insert(steps.end(), plan.steps.begin(), plan.steps.end());
        steps.push_back(overlay);
        plan.steps = steps;
        return plan;
    }
    const auto shadows = static_cast<std::uint32_t>(shadow_indices);
    const std::uint32_t first_shadow = size(plan.repaint_indices) - shadows;
    plan.depth_boxes = {{glm::ivec2(0), glm::ivec2(1 << 14)}}; // beyond any picture
    plan.steps = {{Content::ClearDepth, 0, 1}, {Content::Aircraft, 0, size(plan.aircraft), whole, DepthUse::Nearest},
        {Content::Refined, 0, size(plan.refined), whole, DepthUse::Nearest},
        {Content::Ground, 0, size(plan.ground.indices), whole, DepthUse::Nearest},
        {Content::GroundRepaint, first_shadow, shadows, whole, DepthUse::OnGround},
        {Content::Sky, 0, size(plan.sky.indices), whole, DepthUse::InfinitelyFar}, overlay};
    return plan;
}

void add_square(scene::FramePlan& plan, std::uint32_t model, const glm::mat4& body_to_eye_world) {
    const auto first_part = static_cast<std::uint32_t>(plan.parts.size());
    plan.parts.push_back(body_to_eye_world);
    plan.aircraft.push_back({model, 0, 6, first_part});
    const auto count = static_cast<std::uint32_t>(plan.aircraft.size());
    plan.steps = {{scene::PaintStep::Content::Aircraft, 0, count, scene::PaintStep::no_clip}};
}

void set_square(scene::FramePlan& plan, std::uint32_t model, const glm::mat4& body_to_eye_world) {
    plan.aircraft.clear();
    plan.parts.clear();
    add_square(plan, model, body_to_eye_world);
}

void load_squares(Studio& studio, bool as_meshes) {
    std::array<scene::ModelBuffers, 3> models{square_model(red), square_model(green), square_model(blue)};
    for (scene::ModelBuffers& model : models) { model.has_depth_drawn_meshes = as_meshes; }
    studio.renderer().load_models(models);
}

int count_of(const scene::Picture& picture, const Pixel& colour) {
    int count = 0;
    for (int row = 0; row < picture.height; ++row) {
        for (int column = 0; column < picture.width; ++column) {
            count += pixel(picture, column, row) == colour ? 1 : 0;
        }
    }
    return count;
}

int differing(const scene::Picture& a, const scene::Picture& b, int tolerance) {
    int pixels = 0;
    for (int row = 0; row < a.height; ++row) {
        for (int column = 0; column < a.width; ++column) {
            const Pixel one = pixel(a, column, row);
            const Pixel other = pixel(b, column, row);
            bool differs = false;
            for (std::size_t part = 0; part < 4; ++part) {
                differs = differs || std::abs(one[part] - other[part]) > tolerance;
            }
            pixels += differs ? 1 : 0;
        }
    }
    return pixels;
}

FullScene::FullScene() : models_{box_model({6.0F, 1.0F, 1.5F}), box_model({1.0F, 5.0F, 0.2F})} {
    const gl::BareGrid grid = gl::bare_grid(2000, empty_plan().view_to_clip);
    ground_ = {grid.vertices, grid.indices};
    for (std::size_t corner = 0; corner < 4; ++corner) { models_[1].vertices[corner].part = 1; }
    for (models::ColourVertex& vertex : ground_.vertices) {
        vertex.position_m.y -= 0.4F * -vertex.position_m.z; // lowers the horizon into view
    }
    sky_.add({-1.0F, -1.0F, 1.0F, 0.5F}, 1.0F, {0.7F, 0.8F, 0.9F})
        .add({-1.0F, 0.5F, 1.0F, 1.0F}, 1.0F, {0.3F, 0.5F, 0.9F});
    for (std::size_t vertex : {2U, 3U}) { sky_.vertices[vertex].colour = models::packed_colour({0.3F, 0.5F, 0.9F}); }
}

scene::FramePlan FullScene::plan() const {
    scene::FramePlan plan = empty_plan();
    plan.ground = ground_.draw();
    plan.sky = sky_.draw();
    plan.haze = {{0.7F, 0.8F, 0.9F}, 1500.0F};
    plan.ambient = glm::vec3(0.45F);
    plan.sunlight = glm::vec3(0.65F);
    plan.to_sun = glm::normalize(glm::vec3(0.4F, 0.7F, 0.6F));
    using Content = scene::PaintStep::Content;
    for (const int i : {2, 1, 0}) {
        const auto turn = static_cast<float>(i) + 0.5F;
        const glm::mat4 body_to_eye_world =
            glm::rotate(glm::translate(glm::mat4(1.0F), glm::vec3(3.0F * turn - 6.0F, 2.0F, -15.0F * turn)), turn,
                glm::normalize(glm::vec3(0.3F, 1.0F, 0.2F)));
        const auto first_part = static_cast<std::uint32_t>(plan.parts.size());
        plan.parts.push_back(body_to_eye_world);
        plan.parts.push_back(glm::rotate(body_to_eye_world, 0.3F, glm::vec3(1.0F, 0.0F, 0.0F)));
        plan.aircraft.push_back({static_cast<std::uint32_t>(i % 2), 0, 36, first_part});
    }
    plan.shadow_vertices = {{glm::vec3(-5.0F, -6.0F, -20.0F), 0xff202020U},
        {glm::vec3(5.0F, -6.0F, -20.0F), 0xff202020U}, {glm::vec3(0.0F, -7.0F, -40.0F), 0xff202020U}};
    const auto first_shadow = static_cast<std::uint32_t>(ground_.vertices.size());
    plan.repaint_indices = {0, 1, 2, first_shadow, first_shadow + 1, first_shadow + 2};
    plan.clips.push_back({{glm::vec4(0.7F, 0.7F, 0.0F, 1.0F), glm::vec4(-1.0F, 0.0F, 0.0F, 3.0F)}, 2});
    constexpr std::uint32_t whole = scene::PaintStep::no_clip;
    plan.steps = {{Content::Aircraft, 0, 2, whole}, {Content::GroundRepaint, 0, 6, 0}, {Content::Aircraft, 2, 1, whole},
        {Content::Aircraft, 0, 1, 0}};
    return plan;
}

std::uint64_t hash_of_full_scene(Studio& studio) {
    const FullScene full;
    studio.renderer().load_models(full.models());
    Hash hash;
    for (const HiddenSurfaceMode mode : all_modes) {
        const scene::Picture picture = studio.picture(full.plan(), mode, FullScene::shadow_indices);
        hash.add(std::as_bytes(std::span(picture.rgba)));
    }
    return hash.value();
}

} // namespace octant::tests
