#include "visuals/planning/placed_aircraft.h"

#include "sim/base/units.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <string>

namespace octant::visuals::planning {

namespace {

glm::dmat4 turned_about(const models::polygons::Pivot& pivot, double angle_rad, const glm::dmat4& body_to_eye_world) {
    const glm::dmat4 there = glm::translate(body_to_eye_world, pivot.point_m);
    return glm::translate(glm::rotate(there, angle_rad, pivot.axis), -pivot.point_m);
}

} // namespace

void place_polygon(const PlacedAircraft& aircraft, std::uint32_t polygon, ViewPolygon& placed) {
    place_polygon(*aircraft.model, aircraft.parts, polygon, placed);
}

void place_polygon(
    const AircraftModel& model, std::span<const glm::dmat4> parts, std::uint32_t polygon, ViewPolygon& placed) {
    const glm::dmat4& part = parts[model.buffers.vertices[model.first_vertices[polygon]].part];
    placed.clear();
    for (const std::uint32_t vertex : model.polygons.corners(polygon)) {
        placed.push_back({glm::dvec3(part * glm::dvec4(model.polygons.vertices_m[vertex], 1.0)), false});
    }
}

std::size_t pivot_in(
    const models::polygons::PolygonModel& model, const models::polygons::PolygonModel& numbered, std::size_t pivot) {
    if (&model == &numbered || pivot >= numbered.pivots.size()) {
        return pivot < numbered.pivots.size() ? pivot : model.pivots.size();
    }
    const std::string& name = numbered.parts[numbered.pivots[pivot].part];
    const auto found = std::ranges::find_if(
        model.pivots, [&](const models::polygons::Pivot& one) { return model.parts[one.part] == name; });
    return static_cast<std::size_t>(found - model.pivots.begin());
}

WorldCircle place_disc(
    const AircraftModel& model, std::span<const glm::dmat4> parts, std::uint32_t disc, std::size_t side) {
    const RotorDisc& own = model.discs[disc];
    const std::uint32_t pivot = own.pivots.front();
    const glm::dmat4& part = parts[pivot + 1];
    return {glm::dvec3(part * glm::dvec4(own.sides[side].centre_m, 1.0)),
        glm::dvec3(part * glm::dvec4(model.polygons.pivots[pivot].axis, 0.0)), own.sides[side].radius_m};
}

scene::AircraftDraw draw_of(const PlacedAircraft& aircraft, std::span<const scene::IndexRange> ranges) {
    if (ranges.size() == 1) { return draw_of(aircraft, ranges.front().first_index, ranges.front().index_count); }
    scene::AircraftDraw draw = draw_of(aircraft, 0, 0);
    draw.ranges = ranges;
    return draw;
}

scene::AircraftDraw draw_of(const PlacedAircraft& aircraft, std::uint32_t first_index, std::uint32_t index_count) {
    scene::AircraftDraw draw;
    draw.model = aircraft.model_index;
    draw.first_index = first_index;
    draw.index_count = index_count;
    draw.first_part = aircraft.first_part;
    draw.first_smooth = aircraft.first_smooth;
    draw.tints = aircraft.tints;
    draw.object = aircraft.object;
    return draw;
}

void place_parts(const models::polygons::PolygonModel& model, const glm::dmat4& body_to_eye_world, double time_s,
    std::span<glm::dmat4> parts) {
    assert(parts.size() == model.pivots.size() + 1);
    parts[0] = body_to_eye_world;
    for (std::size_t i = 0; i < model.pivots.size(); ++i) {
        const models::polygons::Pivot& pivot = model.pivots[i];
        const double turns = pivot.turns_per_s * time_s;
        const double angle_rad = 2.0 * pi * (turns - std::floor(turns));
        parts[i + 1] = turned_about(pivot, angle_rad, body_to_eye_world);
    }
}

void move_parts(const AircraftModel& model, const models::ControlPositions& positions, std::span<glm::dmat4> parts) {
    assert(parts.size() == model.part_count());
    const glm::dmat4 to_body = glm::inverse(parts[0]);
    for (std::size_t i = 0; i < model.moves.size(); ++i) {
        if (model.moves[i].empty()) { continue; }
        const glm::dmat4 moved = parts[0] * models::placement_by(model.moves[i], positions);
        const bool turns = i < model.polygons.pivots.size();
        parts[i + 1] = turns ? moved * (to_body * parts[i + 1]) : moved;
    }
}

void place_articulated_part(const models::polygons::PolygonModel& model, const models::polygons::PolygonModel& numbered,
    const ArticulatedPart& part, std::span<glm::dmat4> parts) {
    const std::size_t pivot = pivot_in(model, numbered, part.pivot);
    if (pivot >= model.pivots.size()) { return; }
    const models::polygons::Pivot& axis = model.pivots[pivot];
    const glm::dvec3 about(part.turn.x, part.turn.y, part.turn.z);
    const double angle_rad = 2.0 * std::atan2(glm::dot(about, axis.axis), part.turn.w);
    parts[pivot + 1] = turned_about(axis, angle_rad, glm::translate(parts[0], part.offset_m));
}

} // namespace octant::visuals::planning
