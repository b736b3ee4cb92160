#include "visuals/planning/step_writer.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

namespace octant::visuals::planning {

namespace {

/// Plane through the eye and an edge, `inside` in front of it; zero for an edge seen end-on.
glm::dvec3 edge_normal(const glm::dvec3& from_m, const glm::dvec3& to_m, const glm::dvec3& inside_m) {
    const glm::dvec3 across = glm::cross(from_m, to_m);
    const double size = glm::length(across);
    if (size <= 1e-14 * glm::length(from_m) * glm::length(to_m)) { return glm::dvec3(0.0); }
    return across * ((glm::dot(across, inside_m) < 0.0 ? -1.0 : 1.0) / size);
}

} // namespace

StepWriter::Checkpoint StepWriter::checkpoint() const {
    return {plan_.steps.size(), plan_.steps.empty() ? 0 : plan_.steps.back().count, plan_.aircraft.size(),
        plan_.clips.size(), plan_.repaint_indices.size()};
}

void StepWriter::roll_back(const Checkpoint& checkpoint) {
    plan_.steps.resize(checkpoint.steps);
    if (checkpoint.steps > 0) { plan_.steps.back().count = static_cast<std::uint32_t>(checkpoint.last_count); }
    plan_.aircraft.resize(checkpoint.aircraft);
    plan_.clips.resize(checkpoint.clips);
    plan_.repaint_indices.resize(checkpoint.repaint_indices);
}

void StepWriter::clear_depth(const scene::PixelBox& box) {
    const auto place = static_cast<std::uint32_t>(plan_.depth_boxes.size());
    plan_.depth_boxes.push_back(box);
    plan_.steps.push_back({scene::PaintStep::Content::ClearDepth, place, 1});
}

void StepWriter::add_range(
    scene::PaintStep::Content content, std::size_t first, std::size_t count, scene::DepthUse depth) {
    if (count > 0) {
        plan_.steps.push_back({content, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count),
            scene::PaintStep::no_clip, depth});
    }
}

void StepWriter::add_sky(scene::DepthUse depth) {
    add_range(scene::PaintStep::Content::Sky, 0, plan_.sky.indices.size(), depth);
}

void StepWriter::add_ground() {
    add_range(scene::PaintStep::Content::Ground, 0, plan_.ground.indices.size(), scene::DepthUse::None);
}

void StepWriter::add_ground_by_depth(std::size_t edge_on_indices) {
    const std::size_t facing = plan_.ground.indices.size() - edge_on_indices;
    add_range(scene::PaintStep::Content::Ground, 0, facing, scene::DepthUse::Nearest);
    add_range(scene::PaintStep::Content::Ground, facing, edge_on_indices, scene::DepthUse::EdgeOn);
}

void StepWriter::add_shadows_by_depth(const GroundFrame& ground) {
    const std::size_t first = plan_.repaint_indices.size();
    const auto pieces = ground.shadow_indices;
    plan_.repaint_indices.insert(plan_.repaint_indices.end(), pieces.begin(), pieces.end());
    add_range(scene::PaintStep::Content::GroundRepaint, first, pieces.size(), scene::DepthUse::OnGround);
}

void StepWriter::add_transparent_range(std::size_t first, std::size_t count) {
    add_range(scene::PaintStep::Content::Transparent, first, count, scene::DepthUse::None);
}

void StepWriter::add_overlay(std::size_t first) {
    add_range(scene::PaintStep::Content::Overlay, first, plan_.overlay.indices.size() - first, scene::DepthUse::None);
}

void StepWriter::add(const scene::AircraftDraw& draw, scene::DepthUse depth) {
    const auto place = static_cast<std::uint32_t>(plan_.aircraft.size());
    plan_.aircraft.push_back(draw);
    if (!plan_.steps.empty()) {
        scene::PaintStep& last = plan_.steps.back();
        if (last.content == scene::PaintStep::Content::Aircraft && last.clip == scene::PaintStep::no_clip &&
            last.depth == depth && last.opacity == 1.0F && last.first + last.count == place) {
            ++last.count;
            return;
        }
    }
    plan_.steps.push_back({scene::PaintStep::Content::Aircraft, place, 1, scene::PaintStep::no_clip, depth});
}

void StepWriter::add_transparent(const scene::AircraftDraw& draw, float opacity) {
    const auto place = static_cast<std::uint32_t>(plan_.aircraft.size());
    plan_.aircraft.push_back(draw);
    scene::PaintStep& step = plan_.steps.emplace_back();
    step.content = scene::PaintStep::Content::Aircraft;
    step.first = place;
    step.count = 1;
    step.depth = scene::DepthUse::Nearest;
    step.opacity = opacity;
}

void StepWriter::add(const scene::RefinedDraw& draw) {
    const auto place = static_cast<std::uint32_t>(plan_.refined.size());
    plan_.refined.push_back(draw);
    plan_.steps.push_back(
        {scene::PaintStep::Content::Refined, place, 1, scene::PaintStep::no_clip, scene::DepthUse::Nearest});
}

std::uint32_t StepWriter::add_clip(std::span<const glm::dvec3> normals) {
    assert(normals.size() <= std::size_t{scene::Clip::max_planes});
    scene::Clip& clip = plan_.clips.emplace_back();
    for (const glm::dvec3& normal : normals) {
        clip.planes[static_cast<std::size_t>(clip.count++)] = glm::vec4(glm::vec3(normal), 0.0F);
    }
    return static_cast<std::uint32_t>(plan_.clips.size() - 1);
}

template <class Paint>
void StepWriter::for_each_clip(const ViewPolygon& region, const Paint& paint) {
    constexpr std::size_t most = scene::Clip::max_planes;
    const auto cuts =
        static_cast<std::size_t>(std::ranges::count_if(region, [](const ViewVertex& corner) { return corner.cut; }));
    const auto add_edges = [&](const ViewPolygon& piece, bool all) {
        normals_.clear();
        const glm::dvec3 middle_m = middle_of(piece);
        for (std::size_t i = 0; i < piece.size(); ++i) {
            const glm::dvec3 normal =
                edge_normal(piece[i].at_m, piece[i + 1 < piece.size() ? i + 1 : 0].at_m, middle_m);
            if ((all || piece[i].cut) && normal != glm::dvec3(0.0)) { normals_.push_back(normal); }
        }
        paint(add_clip(normals_));
    };
    if (cuts <= most) {
        add_edges(region, false);
        return;
    }
    // A fan of pieces with few edges each.
    for (std::size_t from = 1; from + 1 < region.size(); from += most - 2) {
        const std::size_t to = std::min(from + most - 2, region.size() - 1);
        piece_.assign(1, region[0]);
        for (std::size_t i = from; i <= to; ++i) { piece_.push_back(region[i]); }
        add_edges(piece_, true);
    }
}

void StepWriter::add_within(const scene::AircraftDraw& draw, const ViewPolygon& region) {
    const auto place = static_cast<std::uint32_t>(plan_.aircraft.size());
    plan_.aircraft.push_back(draw);
    for_each_clip(region, [&](std::uint32_t clip) {
        plan_.steps.push_back({scene::PaintStep::Content::Aircraft, place, 1, clip});
    });
}

void StepWriter::add_indices(const GroundFrame& ground, std::uint32_t triangle) {
    const auto own = ground.all.indices.subspan(std::size_t{3} * triangle, 3);
    plan_.repaint_indices.insert(plan_.repaint_indices.end(), own.begin(), own.end());
    for (const ShadowPieces& shadow : shadows_on(ground, triangle)) {
        const auto pieces = ground.shadow_indices.subspan(shadow.first, shadow.count);
        plan_.repaint_indices.insert(plan_.repaint_indices.end(), pieces.begin(), pieces.end());
    }
}

void StepWriter::add_in_front(const GroundFrame& ground, std::span<const GroundInFrontTriangle> triangles,
    const OrientedBox& box, const ViewCone& cone) {
    std::uint32_t cone_clip = scene::PaintStep::no_clip;
    bool continues = false; // the last step, with the cone alone
    for (const GroundInFrontTriangle& near : triangles) {
        if (near.intersects) {
            add_outside(ground, near.triangle, box, cone);
            continues = false;
            continue;
        }
        const auto first = static_cast<std::uint32_t>(plan_.repaint_indices.size());
        add_indices(ground, near.triangle);
        const auto count = static_cast<std::uint32_t>(plan_.repaint_indices.size()) - first;
        if (continues) {
            plan_.steps.back().count += count;
            continue;
        }
        cone_clip = cone_clip == scene::PaintStep::no_clip ? add_clip(cone.planes()) : cone_clip;
        plan_.steps.push_back({scene::PaintStep::Content::GroundRepaint, first, count, cone_clip});
        continues = true;
    }
}

/// A sight line enters a box through the last of the sides that face the eye, so that a point in the cone lies before
/// the box if it lies outside any of them.
void StepWriter::add_outside(
    const GroundFrame& ground, std::uint32_t triangle, const OrientedBox& box, const ViewCone& cone) {
    const auto first = static_cast<std::uint32_t>(plan_.repaint_indices.size());
    std::uint32_t count = 0;
    for (int side = 0; side < 6; ++side) {
        const Plane plane = side_of(box, side);
        if (plane.offset_m <= 0.0) { continue; }
        place_triangle(ground.all, triangle, piece_);
        clip_to_front(piece_, plane, 0.0, scratch_);
        clip_to_cone(piece_, cone.planes(), scratch_);
        if (solid_angle_sr(piece_) < min_solid_angle_sr) { continue; }
        if (count == 0) {
            add_indices(ground, triangle);
            count = static_cast<std::uint32_t>(plan_.repaint_indices.size()) - first;
        }
        const std::uint32_t index = add_clip(cone.planes());
        scene::Clip& clip = plan_.clips[index];
        clip.planes[static_cast<std::size_t>(clip.count++)] =
            glm::vec4(glm::vec3(plane.normal), static_cast<float>(plane.offset_m));
        plan_.steps.push_back({scene::PaintStep::Content::GroundRepaint, first, count, index});
    }
}

void StepWriter::add_within(const GroundFrame& ground, std::uint32_t triangle, const ViewPolygon& region) {
    const auto first = static_cast<std::uint32_t>(plan_.repaint_indices.size());
    add_indices(ground, triangle);
    const auto count = static_cast<std::uint32_t>(plan_.repaint_indices.size()) - first;
    for_each_clip(region, [&](std::uint32_t clip) {
        plan_.steps.push_back({scene::PaintStep::Content::GroundRepaint, first, count, clip});
    });
}

void StepWriter::occlude_by_ground(const GroundFrame& ground, std::span<const std::uint32_t> triangles) {
    const auto first = static_cast<std::uint32_t>(plan_.repaint_indices.size());
    for (const std::uint32_t triangle : triangles) {
        const auto own = ground.all.indices.subspan(std::size_t{3} * triangle, 3);
        plan_.repaint_indices.insert(plan_.repaint_indices.end(), own.begin(), own.end());
    }
    const auto count = static_cast<std::uint32_t>(3 * triangles.size());
    plan_.steps.push_back({scene::PaintStep::Content::GroundRepaint, first, count, scene::PaintStep::no_clip,
        scene::DepthUse::DepthOnly});
}

} // namespace octant::visuals::planning
