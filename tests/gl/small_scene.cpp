#include "tests/gl/small_scene.h"

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
                model.vertices.push_back({half_m * (normal + corner), normal, colour});
            }
            for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
                model.indices.push_back(first + corner);
            }
        }
    }
    return model;
}

} // namespace

FullScene::FullScene()
    : models_{box_model({6.0F, 1.0F, 1.5F}), box_model({1.0F, 5.0F, 0.2F})} {
    const gl::BareGrid grid = gl::bare_grid(2000, empty_plan().view_to_clip);
    ground_ = {grid.vertices, grid.indices};
    for (models::ColourVertex& vertex : ground_.vertices) {
        vertex.position_m.y -= 0.4F * -vertex.position_m.z; // lowers the horizon into view
    }
    sky_.add({-1.0F, -1.0F, 1.0F, 0.5F}, 1.0F, {0.7F, 0.8F, 0.9F})
        .add({-1.0F, 0.5F, 1.0F, 1.0F}, 1.0F, {0.3F, 0.5F, 0.9F});
    for (std::size_t vertex : {2U, 3U}) {
        sky_.vertices[vertex].colour = models::packed_colour({0.3F, 0.5F, 0.9F});
    }
}

scene::FramePlan FullScene::plan(scene::HiddenSurface way) const {
    scene::FramePlan plan = empty_plan();
    plan.hidden_surface = way;
    plan.ground = ground_.draw();
    plan.sky = sky_.draw();
    plan.haze = {{0.7F, 0.8F, 0.9F}, 1500.0F};
    plan.ambient = glm::vec3(0.45F);
    plan.sunlight = glm::vec3(0.65F);
    for (const int i : {2, 1, 0}) {
        scene::AircraftDraw aircraft;
        aircraft.model = static_cast<std::uint32_t>(i % 2);
        aircraft.index_count = 36;
        const auto turn = static_cast<float>(i) + 0.5F;
        aircraft.body_to_eye_world = glm::rotate(
            glm::translate(glm::mat4(1.0F), glm::vec3(3.0F * turn - 6.0F, 2.0F, -15.0F * turn)),
            turn,
            glm::normalize(glm::vec3(0.3F, 1.0F, 0.2F)));
        aircraft.sun_in_body = glm::normalize(
            glm::transpose(glm::mat3(aircraft.body_to_eye_world)) * glm::vec3(0.4F, 0.7F, 0.6F));
        plan.aircraft.push_back(aircraft);
    }
    return plan;
}

std::uint64_t hash_of_full_scene(Studio& studio) {
    const FullScene full;
    studio.context().make_current();
    studio.renderer().load_models(full.models());
    Hash hash;
    for (const scene::HiddenSurface way :
         {scene::HiddenSurface::Octant,
          scene::HiddenSurface::DepthBuffer,
          scene::HiddenSurface::BackFace}) {
        const gl::Picture picture = studio.picture(full.plan(way));
        hash.add(std::as_bytes(std::span(picture.rgba)));
    }
    return hash.value();
}

} // namespace octant::tests
