#include "visuals/nature/detailed_ground.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::nature {

namespace {

/// The triangle's distance from the eye is less than that; by the box around it.
bool is_nearer(const std::array<glm::vec3, 3>& triangle_m, float reach_m) {
    const glm::vec3 least = glm::min(glm::min(triangle_m[0], triangle_m[1]), triangle_m[2]);
    const glm::vec3 most = glm::max(glm::max(triangle_m[0], triangle_m[1]), triangle_m[2]);
    const glm::vec3 nearest = glm::clamp(glm::vec3(0.0F), least, most);
    return glm::dot(nearest, nearest) < reach_m * reach_m;
}

/// The triangles of a mesh from near to far.
struct NearToFar {
    std::span<const std::uint32_t> indices;
    bool far_first; ///< in the mesh
    std::size_t count = indices.size() / 3;

    std::size_t triangle(std::size_t step) const { return far_first ? count - 1 - step : step; }

    /// Where the number is kept of what was made before a step's triangle.
    std::size_t place(std::size_t step) const { return far_first ? count - step : step; }

    /// Appends those of some steps as they are.
    void append(
        std::size_t step,
        std::size_t end,
        std::vector<std::uint32_t>& to,
        std::vector<std::uint32_t>& first_of) const {
        std::size_t detailed_mesh = to.size() / 3;
        to.resize(to.size() + 3 * (end - step));
        for (; step < end; ++step, ++detailed_mesh) {
            first_of[place(step)] = static_cast<std::uint32_t>(detailed_mesh);
            std::copy_n(&indices[3 * triangle(step)], 3, &to[3 * detailed_mesh]);
        }
    }
};

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
DetailedGround::Triangles DetailedGround::detailed_mesh(
    const terrain::GroundMesh& mesh,
    const NearDetailView& wanted,
    const NearDetailOptions& detail,
    const ColourAtPoint* colour) {
    NearDetailView view = wanted;
    if (detail.has_subdivision) {
        view.min_edge_rad = histogram_.min_edge_rad_for_budget(mesh, wanted);
    }
    frame_ = 1 - frame_;
    Frame& frame = frames_[frame_];
    std::swap(mesh_builder_.vertices(), frame.vertices); // memory of the frame before the last
    mesh_builder_.begin(view, mesh.vertices, detail.scenery ? &scenery_ : nullptr, colour);
    scenery_.begin(view);
    const bool far_first = view.order == terrain::PaintOrder::BackToFront;
    const NearToFar walk{mesh.indices, far_first};
    const std::size_t count = walk.count;
    const auto reach_m = static_cast<float>(detail.scenery ? scenery_.reach_m() : 0.0);
    frame.indices.clear();
    frame.indices.reserve(mesh.indices.size());
    first_index_of_.resize(count + 1);
    const auto corners_m = [&](std::size_t triangle) {
        const std::uint32_t* const corners = &mesh.indices[3 * triangle];
        return std::array{
            mesh.vertices[corners[0]].position_m,
            mesh.vertices[corners[1]].position_m,
            mesh.vertices[corners[2]].position_m};
    };
    const auto has_scenery = [&](std::size_t triangle) {
        return reach_m > 0.0F && is_nearer(corners_m(triangle), reach_m);
    };
    const auto is_near = [&](std::size_t triangle) {
        return detail.has_subdivision && histogram_.is_near(triangle);
    };
    for (std::size_t step = 0; step < count; ++step) {
        // Most triangles stay as they are.
        const std::size_t first = step;
        while (step < count && !is_near(walk.triangle(step)) && !has_scenery(walk.triangle(step))) {
            ++step;
        }
        walk.append(first, step, frame.indices, first_index_of_);
        if (step == count) {
            break;
        }
        const std::size_t triangle = walk.triangle(step);
        if (is_near(triangle)) {
            first_index_of_[walk.place(step)] = static_cast<std::uint32_t>(frame.indices.size() / 3);
            mesh_builder_.add(&mesh.indices[3 * triangle], has_scenery(triangle), frame.indices);
        } else {
            const auto before = static_cast<std::uint32_t>(frame.indices.size() / 3);
            scenery_.add(corners_m(triangle), mesh_builder_.vertices(), frame.indices);
            walk.append(step, step + 1, frame.indices, first_index_of_);
            first_index_of_[walk.place(step)] = before;
        }
    }
    const auto all = static_cast<std::uint32_t>(frame.indices.size() / 3);
    first_index_of_[far_first ? 0 : count] = all;
    if (far_first) {
        reverse_triangles(frame.indices);
        for (std::uint32_t& first : first_index_of_) {
            first = all - first;
        }
    }
    std::swap(mesh_builder_.vertices(), frame.vertices);
    const std::size_t scenery_triangles = scenery_.triangles_added();
    return {frame.vertices, frame.indices, frame.indices.size() / 3 - count - scenery_triangles, scenery_triangles};
}

void DetailedGround::replace(std::vector<std::uint32_t>& triangles, std::size_t first) const {
    replaced_.clear();
    for (std::size_t i = first; i < triangles.size(); ++i) {
        for (std::uint32_t detailed_mesh = first_index_of_[triangles[i]]; detailed_mesh < first_index_of_[triangles[i] + 1];
             ++detailed_mesh) {
            replaced_.push_back(detailed_mesh);
        }
    }
    triangles.resize(first);
    triangles.insert(triangles.end(), replaced_.begin(), replaced_.end());
}

} // namespace octant::visuals::nature
