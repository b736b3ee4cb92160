#include "ui/window/panels.h"
#include "visuals/draworder/octant_order.h"
#include "visuals/planning/placed_aircraft.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <imgui.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <vector>

namespace octant::ui::window {

namespace planning = visuals::planning;
namespace scene = visuals::scene;

namespace {

/// Area that a polygon must have on the screen to get a number: on smaller ones numbers would cover each other.
constexpr double min_area_px = 40.0;

/// Projects points, in world axes with the eye at the origin, to places on the screen in ImGui's coordinates. The
/// picture fills the window, however many pixels it has.
class ScreenPositions {
public:
    ScreenPositions(const scene::Camera& camera, const glm::ivec2& picture_px)
        : eye_world_to_clip_(
              scene::view_to_clip(camera, static_cast<double>(picture_px.x) / static_cast<double>(picture_px.y)) *
              scene::world_to_view(camera)),
          size_(ImGui::GetIO().DisplaySize) {}

    /// Returns nothing for a point behind the near plane.
    std::optional<ImVec2> of(const glm::dvec3& at_m) const {
        const glm::vec4 clip = eye_world_to_clip_ * glm::vec4(glm::vec3(at_m), 1.0F);
        if (clip.w <= 0.0F || clip.z > clip.w) { return std::nullopt; }
        return ImVec2((0.5F + 0.5F * clip.x / clip.w) * size_.x, (0.5F - 0.5F * clip.y / clip.w) * size_.y);
    }

private:
    glm::mat4 eye_world_to_clip_;
    ImVec2 size_;
};

glm::dvec3 centroid_of(const planning::ViewPolygon& polygon) {
    glm::dvec3 sum(0.0);
    for (const planning::ViewVertex& corner : polygon) { sum += corner.at_m; }
    return sum / static_cast<double>(polygon.size());
}

bool faces_eye(const planning::ViewPolygon& polygon) {
    glm::dvec3 normal(0.0);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        normal += glm::cross(polygon[i].at_m, polygon[(i + 1) % polygon.size()].at_m);
    }
    return glm::dot(normal, polygon.front().at_m) < 0.0;
}

/// Returns the area on the screen; 0 where a corner is not in front of the eye.
double area_px(const planning::ViewPolygon& polygon, const ScreenPositions& positions) {
    double twice = 0.0;
    std::optional<ImVec2> before = positions.of(polygon.back().at_m);
    for (const planning::ViewVertex& corner : polygon) {
        const auto at = positions.of(corner.at_m);
        if (!at || !before) { return 0.0; }
        twice += static_cast<double>(before->x * at->y - before->y * at->x);
        before = at;
    }
    return 0.5 * std::abs(twice);
}

void write_number(int number, const ImVec2& at) {
    std::array<char, 12> text{};
    std::snprintf(text.data(), text.size(), "%d", number);
    const ImVec2 extent = ImGui::CalcTextSize(text.data());
    const ImVec2 from(at.x - 0.5F * extent.x, at.y - 0.5F * extent.y);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const std::array<ImVec2, 4> around{
        ImVec2{-1.0F, 0.0F}, ImVec2{1.0F, 0.0F}, ImVec2{0.0F, -1.0F}, ImVec2{0.0F, 1.0F}};
    for (const ImVec2& aside : around) {
        list.AddText({from.x + aside.x, from.y + aside.y}, IM_COL32(0, 0, 0, 220), text.data());
    }
    list.AddText(from, IM_COL32(255, 240, 120, 255), text.data());
}

} // namespace

void write_order_numbers(const flight::Session& session) {
    const world::World& world = session.world();
    if (session.states().empty() || session.settings().view.kind == scene::View::Cockpit) { return; }
    const planning::AircraftModel& model = world.scene.model_of(0);
    const sim::AircraftState& state = session.states().front();
    const scene::Camera& camera = session.camera();

    glm::dmat4 body_to_eye_world(glm::mat3_cast(state.body_to_world));
    body_to_eye_world[3] = glm::dvec4(state.position_m - camera.eye_m, 1.0);
    std::vector<glm::dmat4> parts(model.polygons.pivots.size() + 1);
    planning::place_parts(model.polygons, body_to_eye_world, state.time_s, parts);
    planning::PlacedAircraft placed;
    placed.model = &model;
    placed.parts = parts;

    const ScreenPositions positions(camera, session.settings().view.size_px);
    visuals::draworder::DrawOrder::Walk walk;
    std::vector<std::uint32_t> list;
    model.order.append_painted(
        visuals::draworder::eye_in_body(camera.eye_m, state.position_m, state.body_to_world), walk, list);
    planning::ViewPolygon polygon;
    int painted = 0;
    for (const std::uint32_t number : list) {
        planning::place_polygon(placed, number, polygon);
        if (!faces_eye(polygon)) { continue; }
        ++painted;
        if (area_px(polygon, positions) < min_area_px) { continue; }
        if (const auto at = positions.of(centroid_of(polygon))) { write_number(painted, *at); }
    }
}

} // namespace octant::ui::window
