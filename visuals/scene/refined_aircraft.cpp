#include "visuals/scene/refined_aircraft.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <utility>

namespace octant::visuals::scene {

namespace {

refine::ViewRefinerOptions options_of(const Settings& settings) {
    refine::ViewRefinerOptions options;
    options.error_px = settings.aircraft_error_px;
    options.geomorphs = settings.geomorphs;
    return options;
}

} // namespace

RefinedAircraft::RefinedAircraft(
    std::shared_ptr<const refine::ProgressiveMesh> mesh, const Settings& settings)
    : refiner_(std::move(mesh), options_of(settings)) {}

refine::RefinedFrame
RefinedAircraft::update(const glm::dmat4& body_to_eye_world, const RefineLook& look, bool first) {
    const glm::dmat3 turn(body_to_eye_world); // a vector times it is turned back
    refine::RefineView view;
    view.eye_m = -glm::dvec3(body_to_eye_world[3]) * turn;
    view.ahead = look.ahead * turn;
    for (std::size_t i = 0; i < look.frustum.size(); ++i) {
        view.side_normals[i] = look.frustum[i] * turn;
    }
    view.focal_px = 1.0 / look.pixel_rad;
    if (first) {
        refiner_.settle(view);
    }
    return refiner_.update(view);
}

ModelVertex RefinedAircraft::drawn(const refine::RefinedVertex& vertex) const {
    const glm::vec3 origin_m(refiner_.front().mesh().parts().origin_m);
    const glm::vec3 normal = refine::unpacked(vertex.normal);
    return {vertex.position_m + origin_m, normal, normal, vertex.colour, 0, 0};
}

void RefinedAircraft::fill_shared() {
    vertices_.clear();
    for (const refine::RefinedVertex& vertex : refiner_.front().vertices()) {
        vertices_.push_back(drawn(vertex));
    }
}

void RefinedAircraft::fill_apart() {
    vertices_.clear();
    indices_.clear();
    const auto shared = refiner_.front().indices();
    const auto corners = refiner_.front().vertices();
    std::uint32_t polygon = 0;
    for (std::size_t i = 0; i + 2 < shared.size(); i += 3) {
        if (shared[i] == shared[i + 1]) {
            continue; // a place without a face
        }
        std::array<ModelVertex, 3> triangle{
            drawn(corners[shared[i]]),
            drawn(corners[shared[i + 1]]),
            drawn(corners[shared[i + 2]])};
        const glm::vec3 across = glm::cross(
            triangle[1].position_m - triangle[0].position_m,
            triangle[2].position_m - triangle[0].position_m);
        const float size = glm::length(across);
        triangle[0].face_normal = size > 0.0F ? across / size : triangle[0].normal;
        triangle[0].polygon = polygon++;
        for (const ModelVertex& corner : triangle) {
            indices_.push_back(static_cast<std::uint32_t>(vertices_.size()));
            vertices_.push_back(corner);
        }
    }
}

RefinedDraw RefinedAircraft::draw(bool smooth) {
    RefinedDraw draw;
    if (smooth) {
        fill_shared();
        draw.indices = refiner_.front().indices();
    } else {
        fill_apart();
        draw.indices = indices_;
    }
    draw.vertices = vertices_;
    return draw;
}

} // namespace octant::visuals::scene
