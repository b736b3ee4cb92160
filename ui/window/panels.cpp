#include "ui/window/panels.h"

#include "sim/base/text_file.h"
#include "sim/base/units.h"
#include "sim/flight_steps.h"
#include "sim/sun_position.h"
#include "ui/base/data_files.h"
#include "ui/flight/frame_renderer.h"
#include "ui/report/statistics.h"
#include "ui/settings/aircraft_entry.h"
#include "ui/settings/setting_rows.h"
#include "ui/window/key_map.h"
#include "ui/window/panel_widgets.h"
#include "ui/window/setting_widgets.h"
#include "ui/window/view_state.h"
#include "ui/world/scene_ground.h"
#include "visuals/scene/settings.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::window {

namespace scene = visuals::scene;
using report::FrameRecord;

namespace {

constexpr ImU32 frame_colour = IM_COL32(150, 150, 150, 255);
constexpr ImU32 control_colour = IM_COL32(255, 220, 120, 255);
constexpr float frame_px = 1.0F;

/// Draws a bar in a frame; `share` from 0 to 1 of it is marked, along its longer side.
void mark_in(const ImVec2& from, const ImVec2& to, float share, float mark_px) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRect(from, to, frame_colour, 0.0F, 0, frame_px);
    const bool upright = to.y - from.y > to.x - from.x;
    const ImVec2 at =
        upright ? ImVec2(from.x, to.y + share * (from.y - to.y)) : ImVec2(from.x + share * (to.x - from.x), from.y);
    const float half = 0.5F * mark_px;
    if (upright) {
        list.AddRectFilled({from.x, at.y - half}, {to.x, at.y + half}, control_colour);
    } else {
        list.AddRectFilled({at.x - half, from.y}, {at.x + half, to.y}, control_colour);
    }
}

/// Draws the stick from above (pulled is down), the rudder below it and the throttle to the right.
void draw_controls(const sim::PilotControls& controls, float size) {
    const float bar = 0.12F * size;
    const float gap = 0.08F * size;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 to(at.x + size, at.y + size);
    const ImVec2 middle(at.x + 0.5F * size, at.y + 0.5F * size);
    list.AddRect(at, to, frame_colour, 0.0F, 0, frame_px);
    list.AddLine({middle.x, at.y}, {middle.x, to.y}, frame_colour, frame_px);
    list.AddLine({at.x, middle.y}, {to.x, middle.y}, frame_colour, frame_px);
    const auto roll = static_cast<float>(controls.roll);
    const auto pitch = static_cast<float>(controls.pitch);
    const auto yaw = static_cast<float>(controls.yaw);
    const float travel = 0.5F * size - 0.5F * bar;
    const ImVec2 stick(middle.x + roll * travel, middle.y + pitch * travel);
    const float half = 0.5F * bar;
    list.AddRectFilled({stick.x - half, stick.y - half}, {stick.x + half, stick.y + half}, control_colour);
    mark_in({at.x, to.y + gap}, {to.x, to.y + gap + bar}, 0.5F + 0.5F * yaw, 0.5F * bar);
    mark_in({to.x + gap, at.y}, {to.x + gap + bar, to.y}, static_cast<float>(controls.throttle), 0.5F * bar);
    ImGui::Dummy({size + gap + bar, size + gap + bar});
}

} // namespace

std::vector<FlightReadout> flight_readouts(
    const sim::AircraftKind& kind, const sim::AircraftState& state, const sim::PilotControls& controls) {
    const glm::dvec3 in_body = glm::conjugate(state.body_to_world) * state.velocity_mps;
    const double alpha_rad = std::atan2(in_body.z, in_body.x);
    const bool rotor = kind.flight_model == sim::FlightModel::Helicopter;
    constexpr double seconds_a_minute = 60.0;
    return {{rotor ? "collective" : "throttle", fmt::format("{:.0f} %", 100.0 * controls.throttle)},
        {"speed", fmt::format("{:.0f} kt", kt_from_mps(glm::length(state.velocity_mps)))},
        {"height", fmt::format("{:.0f} ft", ft_from_m(state.position_m.z))},
        {"climb", fmt::format("{:+.0f} ft/min", seconds_a_minute * ft_from_m(state.velocity_mps.z))},
        {"AoA", fmt::format("{:.1f} deg", deg_from_rad(alpha_rad))},
        {"load", fmt::format("{:.2f} g", state.load_factor)}};
}

namespace {

/// Draws the positions of stick, rudder and throttle, and the readouts.
void show_controls(const sim::AircraftKind& kind, const sim::AircraftState& state, const sim::PilotControls& controls) {
    constexpr float letters = 5.0F;
    constexpr float name_letters = 11.0F;
    ImGui::BeginGroup();
    draw_controls(controls, letters * ImGui::GetFontSize());
    ImGui::EndGroup();
    show_tooltip_on_hover("the stick from above (pulled is down), rudder or pedals below it, throttle or "
                          "collective beside it");
    ImGui::SameLine();
    ImGui::BeginGroup();
    for (const FlightReadout& number : flight_readouts(kind, state, controls)) {
        ImGui::TextDisabled("%s", number.name.c_str());
        ImGui::SameLine(name_letters * ImGui::CalcTextSize("n").x);
        ImGui::TextUnformatted(number.value.c_str());
    }
    ImGui::EndGroup();
}

std::vector<StatusMark> manual_flight_marks(const ManualFlightStatus& status) {
    if (status.ended) { return {{status.off_the_map ? "LEFT THE MAP" : "MET THE GROUND", true}}; }
    std::vector<StatusMark> marks;
    if (status.levelling) { marks.push_back({"levelling off"}); }
    if (status.warnings.stalled) { marks.push_back({"STALL", true}); }
    if (status.warnings.is_at_limit) { marks.push_back({"LIMIT", true}); }
    return marks;
}

std::optional<ManualFlightStatus> manual_flight_status(const flight::Simulation& simulation) {
    if (!simulation.by_hand()) { return std::nullopt; }
    const auto end = simulation.end_of_flight();
    return ManualFlightStatus{simulation.pilot().warnings(), end.has_value(),
        end.has_value() && *end == flight::Simulation::End::OffTheMap, simulation.is_levelling()};
}

} // namespace

std::vector<StatusMark> status_marks(const ViewState& state, const std::optional<ManualFlightStatus>& manual_flight) {
    std::vector<StatusMark> marks;
    if (state.recording) { marks.push_back({fmt::format("REC {}", state.recording->string()), true}); }
    if (!state.playback.playing && !(manual_flight && manual_flight->ended)) { marks.push_back({"paused"}); }
    const double speed = state.playback.speed;
    if (speed != 1.0) { marks.push_back({fmt::format("x{:.3g}", speed)}); }
    if (state.playback.playing && state.real_time_factor.share() < full_speed_share) {
        marks.push_back({fmt::format("x{:.2f} of real time", speed * state.real_time_factor.share()), true});
    }
    if (!manual_flight) { return marks; }
    marks.push_back({"by hand"});
    const auto more = manual_flight_marks(*manual_flight);
    marks.insert(marks.end(), more.begin(), more.end());
    return marks;
}

namespace {

void choose_flight(ViewState& state) {
    constexpr std::array<std::string_view, 1> path{"path"};
    constexpr std::array<std::string_view, 1> terrain{"terrain"};
    constexpr settings::FieldInfo leader_info{
        "aircraft", "NAME|FILE", "the first aircraft and all of its kind: a built-in one or a file"};
    ImGui::BeginDisabled(state.recording.has_value());
    ImGui::BeginGroup();
    edit_settings(state.next_settings, path);
    std::string leader = settings::aircraft_shape(state.next_settings.path.aircraft.front());
    ImGui::PushID("leader");
    ImGui::SetNextItemWidth(value_width());
    if (choose_name(leader_info, leader, base::built_in_models)) {
        state.next_settings.path.aircraft = with_lead_aircraft(state.next_settings.path.aircraft, leader);
    }
    ImGui::SameLine();
    ImGui::TextUnformatted("aircraft");
    ImGui::PopID();
    edit_settings(state.next_settings, terrain);
    ImGui::EndGroup();
    ImGui::EndDisabled();
    if (state.recording) { show_tooltip_on_hover("a recording keeps its path, aircraft and ground"); }
}

/// Makes a button on the line of the previous widget if it fits there, with the key of its command as its tooltip.
/// Returns whether it was pressed.
bool command_button(const ViewState& state, const char* label, ViewCommand command) {
    const bool pressed = next_button(label);
    show_tooltip_on_hover(state.keys.name_of(command));
    return pressed;
}

void play_buttons(ViewState& state) {
    Playback& playback = state.playback;
    // One name for both, so that a click that changes it is a click on one button.
    if (ImGui::Button(playback.playing ? "Pause###play" : "Play###play")) { playback.playing = !playback.playing; }
    show_tooltip_on_hover(state.keys.name_of(ViewCommand::PlayOrPause));
    if (command_button(state, "One frame", ViewCommand::StepFrame)) { state.requests.step_frame = true; }
    if (command_button(state, "To beginning", ViewCommand::ToBeginning)) { state.requests.go_to_s = playback.begin_s; }
    same_line_for(checkbox_width("loop"));
    ImGui::Checkbox("loop", &playback.loops);
    show_tooltip_on_hover(fmt::format("begin again at the path's end ({})", state.keys.name_of(ViewCommand::Loop)));
}

void time_sliders(ViewState& state, bool by_hand) {
    Playback& playback = state.playback;
    double time_s = playback.time_s;
    ImGui::BeginDisabled(by_hand || state.recording.has_value());
    ImGui::SetNextItemWidth(value_width());
    if (ImGui::SliderScalar("time", ImGuiDataType_Double, &time_s, &playback.begin_s, &playback.end_s, "%.2f s",
            ImGuiSliderFlags_AlwaysClamp)) {
        state.requests.go_to_s = time_s;
    }
    ImGui::EndDisabled();
    if (state.recording) {
        show_tooltip_on_hover("a recording goes on in time: stop it first");
    } else if (by_hand) {
        show_tooltip_on_hover("by hand time only goes on: give it back to the path first");
    } else {
        show_tooltip_on_hover("where on the path it is; drag to go there");
    }
    ImGui::SetNextItemWidth(value_width());
    ImGui::SliderScalar("speed", ImGuiDataType_Double, &playback.speed, &Playback::slowest, &Playback::fastest, "x%.2f",
        ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    show_tooltip_on_hover(fmt::format("simulated seconds a second; keys {} and {}",
        state.keys.name_of(ViewCommand::Slower), state.keys.name_of(ViewCommand::Faster)));
}

void choose_view(ViewState& state, const flight::Session& session) {
    struct Choice {
        scene::View view;
        ViewCommand command;
    };

    constexpr std::array<Choice, 5> choices{Choice{scene::View::Cockpit, ViewCommand::Cockpit},
        Choice{scene::View::Chase, ViewCommand::Chase}, Choice{scene::View::Tower, ViewCommand::Tower},
        Choice{scene::View::Orbit, ViewCommand::Orbit}, Choice{scene::View::Free, ViewCommand::Free}};
    for (const Choice& choice : choices) {
        const std::string label =
            fmt::format("{} {}", state.keys.name_of(choice.command), settings::text_of(choice.view));
        if (choice.view != choices.front().view) { same_line_for(checkbox_width(label.c_str())); }
        const bool is_it = state.next_settings.view.kind == choice.view;
        if (ImGui::RadioButton(label.c_str(), is_it) && !is_it) {
            state.next_settings = with_view(state.next_settings, choice.view, session.camera());
        }
    }
    constexpr std::array<std::string_view, 1> inset{"inset"};
    edit_settings(state.next_settings, inset);
}

void show_manual_flight(const ViewState& state, const flight::Simulation& simulation) {
    const sim::PilotedFlight& pilot = simulation.pilot();
    show_controls(base::aircraft_kind_of(settings::aircraft_shape(state.next_settings.path.aircraft.front())),
        pilot.state(), simulation.controls());
    const auto marks = manual_flight_marks(*manual_flight_status(simulation));
    const StatusMark mark = marks.empty() ? StatusMark{} : marks.front();
    // Always one line, so that the widgets below do not move.
    ImGui::TextColored(mark.warns ? warning_colour : ImGui::GetStyleColorVec4(ImGuiCol_Text), "%s", mark.text.c_str());
}

void manual_flight_buttons(ViewState& state, const flight::Simulation& simulation) {
    const bool by_hand = simulation.by_hand();
    if (ImGui::Button(by_hand ? "Back to the path###hand" : "Fly by hand###hand")) {
        state.requests.toggle_manual_flight = true;
    }
    show_tooltip_on_hover(state.keys.name_of(ViewCommand::ManualFlight));
    if (!by_hand) { return; }
    if (command_button(state, "Level off", ViewCommand::LevelOff)) { state.requests.level_off = true; }
    show_manual_flight(state, simulation);
}

void recording_buttons(ViewState& state, const flight::Simulation& simulation) {
    if (ImGui::Button(state.recording ? "Stop recording###record" : "Record###record")) {
        state.requests.toggle_recording = true;
    }
    show_tooltip_on_hover(state.keys.name_of(ViewCommand::Record));
    if (command_button(state, "Screenshot", ViewCommand::Screenshot)) { state.requests.screenshot = true; }
    if (state.recording) {
        ImGui::PushStyleColor(ImGuiCol_Text, warning_colour);
        ImGui::TextWrapped("%.1f s in %s", static_cast<double>(simulation.log().size()) * sim::step_s,
            one_line(state.recording->string()).c_str());
        ImGui::PopStyleColor();
    }
}

} // namespace

void flight_panel(ViewState& state, flight::Session& session) {
    const Panel panel("Flight", state.columns, state.open.flight);
    if (!panel.is_seen()) { return; }
    choose_flight(state);
    ImGui::Separator();
    play_buttons(state);
    time_sliders(state, session.simulation().by_hand());
    ImGui::Separator();
    choose_view(state, session);
    ImGui::Separator();
    manual_flight_buttons(state, session.simulation());
    recording_buttons(state, session.simulation());
}

namespace {

constexpr ImU32 line_colour = IM_COL32(120, 200, 255, 255);
constexpr ImU32 level_colour = IM_COL32(200, 200, 120, 160);
constexpr ImU32 overrun_colour = IM_COL32(255, 90, 70, 255);
constexpr std::size_t recent_frames = 60;

std::span<const FrameRecord> recent_records(std::span<const FrameRecord> records) {
    return records.last(std::min(records.size(), recent_frames));
}

template <class Value>
double mean_of(std::span<const FrameRecord> records, Value value) {
    double sum = 0.0;
    int count = 0;
    for (const FrameRecord& record : records) {
        if (std::isfinite(value(record))) {
            sum += value(record);
            ++count;
        }
    }
    return count == 0 ? 0.0 : sum / count;
}

/// Returns how many pictures were begun in a second of wall time.
double frame_rate_hz(std::span<const FrameRecord> records) {
    const double passed_s = records.back().wall_s - records.front().wall_s;
    return passed_s > 0.0 ? static_cast<double>(records.size() - 1) / passed_s : 0.0;
}

void frame_time_plot(const ViewState& state) {
    constexpr double min_top_ms = 20.0;
    const auto records = state.history.records();
    const auto frame_ms = [](const FrameRecord& record) { return record.frame_ms; };
    const double top_ms = std::max(min_top_ms, state.history.statistics().p99_ms * 1.2);
    const FramePlot plot(ImGui::GetFontSize() * 6.0F, 0.0, top_ms);
    plot.level(1000.0 / 60.0, "16.7 ms", level_colour);
    plot.line(records, frame_ms, line_colour);
    plot.marks(
        records, [](const FrameRecord& record) { return record.overrun != 0; }, overrun_colour);
    if (const std::size_t at = plot.pointed_at(records); at != FramePlot::none) {
        const FrameRecord& record = records[at];
        show_tooltip(fmt::format("frame {}: {:.2f} ms = sim {:.2f} + plan {:.2f} + draw {:.2f} + read {:.2f}",
            record.frame, record.frame_ms, record.sim_ms, record.plan_ms, record.draw_ms, record.read_ms));
    }
}

void show_stages(std::span<const FrameRecord> records) {
    const std::array parts{
        BarPart{"sim", mean_of(records, [](const FrameRecord& r) { return r.sim_ms; }), IM_COL32(240, 180, 80, 255)},
        BarPart{"plan", mean_of(records, [](const FrameRecord& r) { return r.plan_ms; }), IM_COL32(120, 210, 120, 255)},
        BarPart{"draw", mean_of(records, [](const FrameRecord& r) { return r.draw_ms; }), IM_COL32(110, 170, 255, 255)},
        BarPart{
            "show", mean_of(records, [](const FrameRecord& r) { return r.read_ms; }), IM_COL32(210, 130, 230, 255)}};
    ImGui::BeginGroup();
    stacked_bar(parts, 1000.0 / 60.0, "ms");
    ImGui::EndGroup();
    show_tooltip_on_hover("mean of the last 60 frames; the bar's width is 16.7 ms. sim: simulation steps, camera; "
                          "plan: what is drawn, in which order; draw: commands to the renderer; show: picture "
                          "finished and shown, with the wait for the display.");
}

void show_percentiles(const report::Statistics& statistics) {
    constexpr std::array<std::string_view, 5> shown{"p50_ms", "p90_ms", "p99_ms", "max_ms", "low_1pct_fps"};
    constexpr std::array<const char*, 5> names{"p50", "p90", "p99", "max", "1 % low"};
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const auto statistic = std::ranges::find(report::all_statistics(), shown[i], &report::Statistic::key);
        const bool is_rate = shown[i].ends_with("fps");
        ImGui::BeginGroup();
        ImGui::TextDisabled("%s", names[i]);
        ImGui::Text(is_rate ? "%.1f/s" : "%.2f", statistic->value(statistics));
        ImGui::EndGroup();
        show_tooltip_on_hover(fmt::format("{}: {}", statistic->name, statistic->definition));
        if (i + 1 < shown.size()) { ImGui::SameLine(0.0F, ImGui::GetFontSize() * 1.2F); }
    }
}

void show_clock(std::span<const FrameRecord> records) {
    const auto last = recent_records(records);
    ImGui::Text("%.1f frames/s, stress %.2f", frame_rate_hz(last), records.back().stress);
    show_tooltip_on_hover("stress: frame time over the frame's share of time; filtered where the terrain adapts");
    const auto missed = std::ranges::count_if(records, [](const FrameRecord& record) { return record.missed != 0; });
    const auto overruns = std::ranges::count_if(records, [](const FrameRecord& record) { return record.overrun != 0; });
    ImGui::Text("latency %.1f ms, missed %ld, overruns %ld",
        mean_of(last, [](const FrameRecord& record) { return record.latency_ms; }), static_cast<long>(missed),
        static_cast<long>(overruns));
    show_tooltip_on_hover("latency: from the input that a picture shows to the picture finished, mean of the "
                          "last 60 frames. missed: pictures later than the next one was due; overruns: frames "
                          "above 16.67 ms; both of the last 300 frames.");
}

} // namespace

void timing_panel(ViewState& state) {
    const Panel panel("Frame times", state.columns, state.open.timing);
    if (!panel.is_seen()) { return; }
    if (state.history.empty()) {
        ImGui::TextUnformatted("no frames yet");
        return;
    }
    frame_time_plot(state);
    show_percentiles(state.history.statistics());
    show_stages(recent_records(state.history.records()));
    show_clock(state.history.records());
    ImGui::Checkbox("wait for the display (vsync)", &state.vsync);
}

namespace {

constexpr std::array<std::string_view, 8> controls{
    "show-mesh", "terrain-lod", "triangles", "error-px", "adapt", "geomorphs", "mesh-ahead", "earth-curvature"};

void count_plot(std::span<const FrameRecord> records) {
    int most = 1;
    for (const FrameRecord& record : records) { most = std::max(most, record.terrain_triangles); }
    const int target = records.back().triangle_target;
    const FramePlot plot(ImGui::GetFontSize() * 4.0F, 0.0, 1.15 * most);
    plot.level(target, "target", IM_COL32(200, 200, 120, 160));
    plot.line(
        records, [](const FrameRecord& record) { return static_cast<double>(record.terrain_triangles); },
        IM_COL32(120, 210, 120, 255));
}

void change_plot(std::span<const FrameRecord> records) {
    int most = 1;
    for (const FrameRecord& record : records) { most = std::max(most, std::abs(record.triangle_change)); }
    const std::string name = fmt::format("change, +-{}", most);
    const FramePlot plot(ImGui::GetFontSize() * 3.0F, -1.1 * most, 1.1 * most);
    plot.level(0.0, name.c_str(), IM_COL32(200, 200, 200, 160));
    plot.line(
        records, [](const FrameRecord& record) { return static_cast<double>(record.triangle_change); },
        IM_COL32(255, 170, 90, 255));
}

void show_counts(const FrameRecord& last) {
    const bool limited = last.triangle_target < visuals::terrain::unlimited_triangles;
    ImGui::Text("%d triangles, target %s", last.terrain_triangles,
        limited ? fmt::format("{}", last.triangle_target).c_str() : "none");
    ImGui::Text("change %+d, shadows %d", last.triangle_change, last.shadow_triangles);
    if (last.error_px > 0.0) {
        ImGui::Text("error %.3g px", last.error_px);
        show_tooltip_on_hover("screen-space error that the mesh was made for");
    } else {
        ImGui::Text("C %.4g, %d fans", last.resolution_c, last.terrain_fans);
        show_tooltip_on_hover("C: resolution of the paper's quadtree; fans: leaves of it that were drawn");
    }
}

void terrain_panel(ViewState& state, const flight::Session& session) {
    const Panel panel("Terrain", state.columns, state.open.terrain);
    if (!panel.is_seen()) { return; }
    ImGui::TextWrapped("%s", session.world().ground.name.c_str());
    if (!state.history.empty()) {
        show_counts(state.history.last());
        count_plot(state.history.records());
        change_plot(state.history.records());
    }
    ImGui::Separator();
    edit_settings(state.next_settings, controls);
}

constexpr std::array<std::string_view, 2> order_settings{"hidden-surface", "order-method"};

void show_last_frame(const report::FrameRecord& last, const visuals::draworder::DrawOrder& order) {
    if (order.has_one_cell_per_eye()) {
        show_value("cell", fmt::format("{} of 0 to {}", last.draw_cell, order.cell_count() - 1));
        show_tooltip_on_hover("in which the eye is, of the first aircraft's");
    } else {
        show_value("parts", fmt::format("{}", order.cell_count()));
        show_tooltip_on_hover("of the first aircraft, in an order that is found anew for each eye");
    }
    show_value("lists", fmt::format("{}", order.list_count()));
    show_tooltip_on_hover("different painting orders that the cells share");
    show_value("polygons", fmt::format("{}", last.aircraft_polygons));
    show_tooltip_on_hover("of all aircraft, in the lists drawn");
    show_value("cuts", fmt::format("{}", last.cuts));
    show_tooltip_on_hover("ground triangles and aircraft polygons painted again, cut by planes");
    show_value("unordered", fmt::format("{}", last.unordered));
    show_tooltip_on_hover("overlaps for which no painting order was found");
}

void show_pixel_check(ViewState& state) {
    if (ImGui::Button("Count wrong pixels")) { state.requests.count_wrong_pixels = true; }
    show_tooltip_on_hover("draws this picture once more with a depth buffer and compares them");
    if (!state.pixel_check) { return; }
    const flight::PixelCheck& found = *state.pixel_check;
    const bool clean = found.wrong == 0;
    ImGui::SameLine();
    ImGui::TextColored(clean ? ImVec4(0.5F, 0.9F, 0.5F, 1.0F) : warning_colour, "%ld wrong", found.wrong);
    ImGui::Text("%ld of %ld pixels differ", found.differing, found.pixels);
    show_tooltip_on_hover("with those along edges, where two right pictures may differ");
}

void draw_order_panel(ViewState& state, const flight::Session& session) {
    const Panel panel("Draw order", state.columns, state.open.draw_order);
    if (!panel.is_seen()) { return; }
    ImGui::TextWrapped("A cell is a part of the space around an aircraft: from every eye in it, the same order of "
                       "polygons, painted one over the other, hides what is hidden.");
    const auto& scene = session.world().scene;
    if (!state.history.empty()) { show_last_frame(state.history.last(), scene.model_of(0).order); }
    edit_settings(state.next_settings, order_settings);
    ImGui::Checkbox("painting order on the polygons", &state.order_numbers);
    show_pixel_check(state);
}

constexpr std::array<std::string_view, 10> aircraft_settings{"axes", "shadows", "aircraft-error-px", "show-model",
    "shading", "shading-rule", "smooth-share", "device-ratio", "shading-near", "shading-far"};

/// Lists the levels of detail in which a model can be drawn.
void show_representations(const visuals::planning::AircraftModel& model) {
    if (model.progressive) {
        ImGui::TextDisabled("  refined in each frame: %zu triangles at most", model.progressive->face_count());
    }
    for (const visuals::planning::MeshLevel& level : model.levels) {
        ImGui::TextDisabled("  level of %d triangles, wrong by %.3g m", level.range.polygons, level.error_m);
    }
}

/// Makes one line for each model that flies.
void show_models(const visuals::planning::Scene& scene) {
    for (std::size_t model = 0; model < scene.models.size(); ++model) {
        const auto flying = std::ranges::count(scene.aircraft, model);
        if (flying == 0) { continue; }
        const visuals::planning::AircraftModel& each = *scene.models[model];
        ImGui::BulletText("%ld x %s: %zu polygons", static_cast<long>(flying), each.polygons.name.c_str(),
            each.polygons.polygons.size());
        const auto whole = each.polygons.parents.empty()
                               ? each.polygons.polygons.size()
                               : std::size_t{1} + *std::ranges::max_element(each.polygons.parents);
        if (whole < each.polygons.polygons.size()) {
            ImGui::SameLine();
            ImGui::TextDisabled("(%zu in its file)", whole);
            show_tooltip_on_hover("some were split where no painting order exists otherwise");
        }
        show_representations(each);
    }
}

void aircraft_panel(ViewState& state, const flight::Session& session) {
    const Panel panel("Aircraft", state.columns, state.open.aircraft);
    if (!panel.is_seen()) { return; }
    show_models(session.world().scene);
    if (!state.history.empty()) {
        const report::FrameRecord& last = state.history.last();
        ImGui::Text("drawn: %d polygons,", last.aircraft_polygons);
        ImGui::Text("  %d smooth, %d shadow pieces", last.smooth_polygons, last.shadow_triangles);
        if (const auto& adapted = session.shading()) {
            ImGui::Text("  adapted: %d smooth%s", adapted->smooth, adapted->has_no_gain ? ", flat is no faster" : "");
        }
        ImGui::Text("first aircraft: level %d", last.aircraft_level);
        ImGui::Text(
            "refined: %d splits, %d merges, %.2f ms", last.refine_splits, last.refine_collapses, last.refine_ms);
    }
    ImGui::BeginDisabled(state.recording.has_value());
    count_slider(state.next_settings.path.aircraft);
    ImGui::EndDisabled();
    edit_settings(state.next_settings, aircraft_settings);
}

constexpr std::array<std::string_view, 12> scene_settings{"time", "sun-azimuth", "sun-elevation", "visibility",
    "haze-height", "sky", "background", "relief-shadows", "water-level", "palette", "ground-shading", "drape"};

constexpr sim::SolarTime noon_in_spring{2000, 3, 20, 12 * 60};
constexpr ImGuiSliderFlags slider_without_input = ImGuiSliderFlags_NoInput;
constexpr int last_minute = 24 * 60 - 1;

std::string clock_text(const sim::SolarTime& time) {
    return fmt::format("{:02}:{:02}", time.minute / 60, time.minute % 60);
}

std::string date_text(const sim::SolarTime& time) {
    return fmt::format("{:04}-{:02}-{:02}", time.year, time.month, time.day);
}

/// Makes sliders for time and day, which set the position of the sun. They show none where the sun was put in its place
/// by hand.
void time_of_day(settings::RunSettings& settings, double latitude_deg) {
    const auto now =
        settings.air.time ? sim::solar_time_from_text(*settings.air.time) : std::optional<sim::SolarTime>();
    sim::SolarTime time = now.value_or(noon_in_spring);
    int day = sim::day_of_year(time);
    const std::string clock = now ? clock_text(time) : "by hand";
    const std::string date = now ? date_text(time) : "by hand";
    ImGui::SetNextItemWidth(value_width());
    bool changed = ImGui::SliderInt("time of day", &time.minute, 0, last_minute, clock.c_str(), slider_without_input);
    show_tooltip_on_hover(
        fmt::format("the sun's own time at latitude {:.1f}; sets its azimuth and elevation. At night it stays "
                    "on the horizon.",
            latitude_deg));
    ImGui::SetNextItemWidth(value_width());
    changed = ImGui::SliderInt("day of year", &day, 1, 365, date.c_str(), slider_without_input) || changed;
    show_tooltip_on_hover("March 20: spring equinox, June 21: midsummer of the northern half");
    if (changed) {
        time = sim::on_day(time, day);
        settings.air.time = fmt::format("{}T{}", date_text(time), clock_text(time));
    }
}

void scene_panel(ViewState& state, const flight::Session& session) {
    const Panel panel("Scene", state.columns, state.open.scene);
    if (!panel.is_seen()) { return; }
    time_of_day(state.next_settings, world::latitude_of(session.world().ground.place));
    ImGui::Separator();
    edit_settings(state.next_settings, scene_settings);
    ImGui::Separator();
    ImGui::BeginDisabled(state.recording.has_value());
    count_slider(state.next_settings.path.aircraft);
    ImGui::EndDisabled();
}

void save_and_load(ViewState& state) {
    std::array<char, 1024> name{};
    state.settings_file.copy(name.data(), name.size() - 1);
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 8.0F);
    if (ImGui::InputText("##settings file", name.data(), name.size())) { state.settings_file = name.data(); }
    show_tooltip_on_hover("a settings file, or the run.json of a recording");
    ImGui::BeginDisabled(state.settings_file.empty());
    ImGui::SameLine();
    if (ImGui::Button("Save")) { state.requests.save_settings = state.settings_file; }
    ImGui::SameLine();
    if (ImGui::Button("Load")) { state.requests.load_settings = state.settings_file; }
    ImGui::EndDisabled();
}

} // namespace

void settings_panel(ViewState& state) {
    const Panel panel("Settings", state.columns, state.open.settings);
    if (!panel.is_seen()) { return; }
    save_and_load(state);
    for (const auto& [group, headline] : settings::enum_names<settings::SettingGroup>) {
        if (ImGui::CollapsingHeader(headline.data())) {
            ImGui::PushID(headline.data());
            edit_group(state.next_settings, group);
            ImGui::PopID();
        }
    }
}

namespace {

constexpr float key_share = 0.3F;

void line_of(std::string_view name, std::string_view meaning) {
    ImGui::TableNextRow();
    ImGui::PushTextWrapPos(0.0F);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name.data(), name.data() + name.size());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(meaning.data(), meaning.data() + meaning.size());
    ImGui::PopTextWrapPos();
}

void bullet(const char* text) {
    ImGui::Bullet();
    ImGui::TextWrapped("%s", text);
}

/// What a person's own keys come from, or how to have some.
void show_file_of_keys(ViewState& state) {
    if (state.keys_file.empty()) { return; }
    const std::string file = one_line(state.keys_file.string());
    if (!state.keys_file_exists) {
        if (next_button("Write keys")) { state.requests.write_keys = true; }
        show_tooltip_on_hover("into " + file + ", to be changed there; they count from the next start on");
        return;
    }
    ImGui::TextWrapped("keys of %s", file.c_str());
    for (const std::string& fault : state.key_errors) { ImGui::TextWrapped("%s", one_line(fault).c_str()); }
}

} // namespace

void help_panel(ViewState& state) {
    const Panel panel("Keys", state.columns, state.open.help);
    if (!panel.is_seen()) { return; }
    if (ImGui::Button("Put panels back")) { state.columns.reset_layout(); }
    show_tooltip_on_hover("into their columns, each as high as what it shows");
    show_file_of_keys(state);
    if (!ImGui::BeginTable("keys", 2)) { return; }
    ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthStretch, key_share);
    ImGui::TableSetupColumn("meaning", ImGuiTableColumnFlags_WidthStretch, 1.0F - key_share);
    const KeyMap& keys = state.keys;
    for (const ViewKey& key : view_keys()) { line_of(keys.name_of(key.command), key.meaning); }
    std::string names;
    for (const HeldKey& key : held_keys()) {
        names += (names.empty() ? "" : ", ") + keys.name_of(key.action);
        if (!key.meaning.empty()) {
            line_of(names, key.meaning);
            names.clear();
        }
    }
    line_of(name_of_button(keys.look_button) + " drag", "turn the look, or around the aircraft");
    line_of("wheel", "zoom");
    line_of(
        name_of_button(keys.stick_button) + " button", "by hand: the pointer is the stick, from the window's middle");
    for (std::size_t i = 0; i < keys.pad_commands.size(); ++i) {
        if (const auto& what = keys.pad_commands[i]) {
            line_of("gamepad " + name_of_pad_button(static_cast<int>(i)),
                view_keys()[static_cast<std::size_t>(*what)].meaning);
        }
    }
    line_of("gamepad", "by hand: left stick; triggers throttle; bumpers or right stick rudder");
    line_of("joystick", "by hand: stick, twist, lever");
    ImGui::EndTable();
}

void first_steps_panel(ViewState& state) {
    const Panel panel("First steps", state.columns, state.open.first_steps);
    if (!panel.is_seen()) { return; }
    bullet("Space plays and pauses; 1 to 5 change the view.");
    bullet("Drag to look around, turn the wheel to come nearer.");
    bullet("H flies by hand; F1 lists all keys; Tab hides the panels.");
    if (ImGui::Button("Begin")) { state.open.first_steps = false; }
}

namespace {

void leave_question(ViewState& state) {
    const Panel panel("Leave?", state.columns, state.open.leave_question);
    if (!panel.is_seen()) { return; }
    ImGui::TextWrapped("A recording is being made. Leaving ends it; what was flown is kept.");
    if (ImGui::Button("Stop it and leave")) { state.requests.leave_recording = true; }
    if (command_button(state, "Go on", ViewCommand::Leave)) { state.open.leave_question = false; }
}

const ImVec4 mark_colour{1.0F, 0.95F, 0.7F, 1.0F};

/// Makes a text that is broken where it is wider than `most`.
void show_wrapped(const std::string& text, float most) {
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + most);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
}

/// Makes the marks in a line, or in lines no wider than `most`.
void show_marks(const std::vector<StatusMark>& marks, float most) {
    const float gap = ImGui::GetFontSize();
    float used = 0.0F;
    for (const StatusMark& mark : marks) {
        const std::string text = one_line(mark.text);
        const float width = ImGui::CalcTextSize(text.c_str()).x;
        if (used > 0.0F && used + gap + width <= most) {
            ImGui::SameLine(0.0F, gap);
            used += gap + width;
        } else {
            used = width;
        }
        ImGui::PushStyleColor(ImGuiCol_Text, mark.warns ? warning_colour : mark_colour);
        show_wrapped(text, most);
        ImGui::PopStyleColor();
    }
}

/// What the panels have to lie in.
PanelArea panel_area_of(const ViewState& state, float status_height) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    PanelArea area{{size.x, size.y}, gui_scale(), status_height, glm::vec2(0.0F)};
    if (state.next_settings.view.inset) {
        const glm::ivec2& picture_px = state.next_settings.view.size_px;
        const auto inset = flight::inset_rectangle(picture_px);
        const glm::vec2 share =
            glm::vec2(picture_px - glm::ivec2(inset.x, inset.y)) / glm::max(glm::vec2(picture_px), glm::vec2(1.0F));
        constexpr float frame = 4.0F;
        area.inset = share * area.size + frame;
    }
    return area;
}

} // namespace

float status_line(const ViewState& state, flight::Session& session, double now_s) {
    const auto marks = status_marks(state, manual_flight_status(session.simulation()));
    const bool speaks = now_s < state.message.until_s && !state.message.text.empty();
    if (marks.empty() && !speaks) { return 0.0F; }
    constexpr float from_top = 6.0F;
    const float top = from_top * gui_scale();
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const auto [left, width] = state.columns.middle().value_or(MiddleColumn{0.0F, display.x});
    // Where others fly, the picture's own words are above.
    const bool below = session.simulation().is_live();
    const float at = below ? display.y - top : top;
    const float share = below ? 1.0F : 0.0F;
    ImGui::SetNextWindowPos({left + 0.5F * width, at}, ImGuiCond_Always, {0.5F, share});
    ImGui::SetNextWindowBgAlpha(background_alpha);
    ImGui::Begin("##status", nullptr,
        ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs |
            ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
    const float most = width - 2.0F * ImGui::GetStyle().WindowPadding.x;
    show_marks(marks, most);
    if (speaks) { show_wrapped(one_line(state.message.text), most); }
    const float height = ImGui::GetWindowSize().y;
    ImGui::End();
    return below ? 0.0F : top + height;
}

void all_panels(ViewState& state, flight::Session& session, double now_s) {
    if (state.order_numbers) { write_order_numbers(session); }
    const float status_height = status_line(state, session, now_s);
    state.columns.lay_out(state.open, panel_area_of(state, status_height));
    leave_question(state);
    if (!state.open.shown) { return; }
    flight_panel(state, session);
    timing_panel(state);
    terrain_panel(state, session);
    draw_order_panel(state, session);
    aircraft_panel(state, session);
    scene_panel(state, session);
    settings_panel(state);
    help_panel(state);
    first_steps_panel(state);
}

} // namespace octant::ui::window
