#include "visuals/planning/placed_aircraft.h"

#include "sim/base/units.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cassert>
#include <cmath>

namespace octant::visuals::planning {

namespace {

glm::dmat4 turned_about(
    const models::polygons::Pivot& pivot, double angle_rad, const glm::dmat4& body_to_eye_world) {
    const glm::dmat4 there = glm::translate(body_to_eye_world, pivot.point_m);
    return glm::translate(glm::rotate(there, angle_rad, pivot.axis), -pivot.point_m);
}

} // namespace

void place_polygon(const PlacedAircraft& aircraft, std::uint32_t polygon, SightPolygon& placed) {
    const models::polygons::PolygonModel& model = aircraft.model->polygons;
    const std::uint32_t first_vertex = aircraft.model->first_vertices[polygon];
    const glm::dmat4& part = aircraft.parts[aircraft.model->buffers.vertices[first_vertex].part];
    placed.clear();
    for (const std::uint32_t vertex : model.corners(polygon)) {
        placed.push_back({glm::dvec3(part * glm::dvec4(model.vertices_m[vertex], 1.0)), false});
    }
}

scene::AircraftDraw draw_of(const PlacedAircraft& aircraft) {
    if (aircraft.ranges.size() == 1) {
        const scene::IndexRange& range = aircraft.ranges.front();
        return draw_of(aircraft, range.first_index, range.index_count);
    }
    scene::AircraftDraw draw = draw_of(aircraft, 0, 0);
    draw.ranges = aircraft.ranges;
    return draw;
}

scene::AircraftDraw
draw_of(const PlacedAircraft& aircraft, std::uint32_t first_index, std::uint32_t index_count) {
    scene::AircraftDraw draw;
    draw.model = aircraft.model_index;
    draw.first_index = first_index;
    draw.index_count = index_count;
    draw.first_part = aircraft.first_part;
    draw.first_smooth = aircraft.first_smooth;
    draw.tints = aircraft.tints;
    return draw;
}

void place_parts(
    const models::polygons::PolygonModel& model,
    const glm::dmat4& body_to_eye_world,
    double time_s,
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

void place_turned_part(
    const models::polygons::PolygonModel& model,
    const TurnedPart& turned,
    std::span<glm::dmat4> parts) {
    if (turned.pivot >= model.pivots.size()) {
        return;
    }
    const models::polygons::Pivot& pivot = model.pivots[turned.pivot];
    const glm::dvec3 about(turned.turn.x, turned.turn.y, turned.turn.z);
    const double angle_rad = 2.0 * std::atan2(glm::dot(about, pivot.axis), turned.turn.w);
    parts[turned.pivot + 1] = turned_about(pivot, angle_rad, parts[0]);
}

} // namespace octant::visuals::planning
