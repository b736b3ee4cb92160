#include "visuals/nature/near_ground.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>

namespace octant::visuals::nature {

namespace {

/// The triangle's distance from the eye is less than that; by the box around it.
bool is_nearer(const std::array<glm::vec3, 3>& triangle_m, float reach_m) {
    const glm::vec3 least = glm::min(glm::min(triangle_m[0], triangle_m[1]), triangle_m[2]);
    const glm::vec3 most = glm::max(glm::max(triangle_m[0], triangle_m[1]), triangle_m[2]);
    const glm::vec3 nearest = glm::clamp(glm::vec3(0.0F), least, most);
    return glm::dot(nearest, nearest) < reach_m * reach_m;
}

void reverse_triangles(std::vector<std::uint32_t>& indices) {
    for (std::size_t low = 0, high = indices.size(); low + 3 < high; low += 3) {
        high -= 3;
        std::swap_ranges(
            indices.begin() + static_cast<std::ptrdiff_t>(low),
            indices.begin() + static_cast<std::ptrdiff_t>(low + 3),
            indices.begin() + static_cast<std::ptrdiff_t>(high));
    }
}

} // namespace

/// Goes from near to far, so that what there is no room for is far off.
NearGround::Triangles NearGround::made(
    const terrain::GroundMesh& mesh,
    const FineView& wanted,
    const NearDetail& detail,
    const PlaceColour* colour) {
    FineView view = wanted;
    if (detail.fine_ground) {
        view.long_rad = survey_.long_rad_within(mesh, wanted);
    }
    frame_ = 1 - frame_;
    Frame& frame = frames_[frame_];
    std::swap(fine_.vertices(), frame.vertices); // memory of the frame before the last
    fine_.begin(view, mesh.vertices, detail.scenery ? &scenery_ : nullptr, colour);
    scenery_.begin(view);
    const bool far_first = view.order == terrain::PaintOrder::BackToFront;
    const auto reach_m = static_cast<float>(detail.scenery ? scenery_.reach_m() : 0.0);
    const std::size_t count = mesh.indices.size() / 3;
    frame.indices.clear();
    frame.indices.reserve(mesh.indices.size());
    first_of_.resize(count + 1);
    const auto bears = [&](std::size_t triangle) {
        const std::uint32_t* const corners = &mesh.indices[3 * triangle];
        return reach_m > 0.0F && is_nearer(
                                     {mesh.vertices[corners[0]].position_m,
                                      mesh.vertices[corners[1]].position_m,
                                      mesh.vertices[corners[2]].position_m},
                                     reach_m);
    };
    for (std::size_t step = 0; step < count; ++step) {
        const std::size_t triangle = far_first ? count - 1 - step : step;
        const std::uint32_t* const corners = &mesh.indices[3 * triangle];
        first_of_[far_first ? triangle + 1 : triangle] =
            static_cast<std::uint32_t>(frame.indices.size() / 3);
        const bool is_near = detail.fine_ground && survey_.is_near(triangle);
        const bool is_bearing = bears(triangle);
        if (is_near) {
            fine_.add(corners, is_bearing, frame.indices);
            continue;
        }
        if (is_bearing) {
            scenery_.add(
                {mesh.vertices[corners[0]].position_m,
                 mesh.vertices[corners[1]].position_m,
                 mesh.vertices[corners[2]].position_m},
                fine_.vertices(),
                frame.indices);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            frame.indices.push_back(corners[k]);
        }
    }
    const auto all = static_cast<std::uint32_t>(frame.indices.size() / 3);
    first_of_[far_first ? 0 : count] = all;
    if (far_first) {
        reverse_triangles(frame.indices);
        for (std::uint32_t& first : first_of_) {
            first = all - first;
        }
    }
    std::swap(fine_.vertices(), frame.vertices);
    const std::size_t things = scenery_.added();
    return {frame.vertices, frame.indices, frame.indices.size() / 3 - count - things, things};
}

void NearGround::replace(std::vector<std::uint32_t>& triangles, std::size_t first) const {
    replaced_.clear();
    for (std::size_t i = first; i < triangles.size(); ++i) {
        for (std::uint32_t made = first_of_[triangles[i]]; made < first_of_[triangles[i] + 1];
             ++made) {
            replaced_.push_back(made);
        }
    }
    triangles.resize(first);
    triangles.insert(triangles.end(), replaced_.begin(), replaced_.end());
}

} // namespace octant::visuals::nature
