#include "sim/aircraft_kind.h"
#include "sim/aircraft_state.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/flight_models.h"
#include "sim/flight_steps.h"
#include "sim/piloted_flight.h"
#include "sim/trajectory.h"
#include "ui/flight/flight_recorder.h"
#include "ui/flight/session.h"
#include "ui/library/conversions.h"
#include "ui/library/loaded_world.h"
#include "ui/report/comparison.h"
#include "ui/report/frame_record.h"
#include "ui/report/html_report.h"
#include "ui/report/loaded_recording.h"
#include "ui/settings/frame_part.h"
#include "ui/settings/setting_rows.h"
#include "ui/settings/settings.h"
#include "ui/world/input_files.h"
#include "ui/world/world.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <octant/flight.h>
#include <optional>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>
#include <vector>

namespace octant {

namespace library = ui::library;

namespace {

/// Settings by name, all entries of a name as one list of words.
ui::settings::RunSettings run_settings(
    const FlightSettings& given, const std::function<void(std::string_view)>& on_note) {
    ui::settings::RunSettings settings;
    std::vector<std::pair<std::string, std::vector<std::string>>> lists;
    for (const auto& [name, word] : given.settings) {
        auto list = std::ranges::find(lists, name, [](const auto& each) { return each.first; });
        if (list == lists.end()) { list = lists.insert(lists.end(), {name, {}}); }
        list->second.push_back(word);
    }
    for (const auto& [name, words] : lists) {
        const std::string note = ui::settings::set_by_name(settings, name, words);
        if (!note.empty()) { on_note(note); }
    }
    if (settings.path.name == ui::settings::live_path) {
        throw Error("path: expected a path or a track, got 'live', which other programs fly");
    }
    if (settings.drawing.renderer == ui::settings::RendererKind::Auto) {
        settings.drawing.renderer = ui::settings::RendererKind::Raster; // the library draws by the processor
    }
    return ui::world::with_absolute_paths(settings);
}

} // namespace

std::vector<SettingDescription> known_settings() {
    std::vector<SettingDescription> list;
    ui::settings::visit_rows([&list](const ui::settings::SettingInfo& row) {
        list.push_back({std::string(row.name), std::string(row.form), std::string(row.meaning)});
    });
    return list;
}

struct Flight::Impl {
    explicit Impl(const FlightSettings& given, const std::function<void(std::string_view)>& on_note)
        : settings(run_settings(given, on_note)), session(settings) {
        for (const std::string& note : session.world().notes) { on_note(note); }
        if (!given.record.empty()) {
            ui::flight::RecordOptions options;
            options.folder = given.record;
            recorder.emplace(options, settings, session);
        }
        const glm::ivec2 size = settings.view.size_px;
        rgb.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * 3);
        if (settings.time.part) {
            first = session.begin_frame_range(*ui::settings::part_from_text(*settings.time.part)).first;
        }
        next_frame = first;
    }

    bool is_own_process() const { return process == getpid(); }

    void check_process() const {
        if (!is_own_process()) { throw Error("flight: expected the process that began it, got one forked from it"); }
    }

    void draw() {
        ui::report::FrameRecord record = session.draw(next_frame);
        ++next_frame;
        time_s = record.sim_time_s;
        timing = {.frame_ms = record.frame_ms,
            .sim_ms = record.sim_ms,
            .plan_ms = record.plan_ms,
            .draw_ms = record.draw_ms,
            .read_ms = record.read_ms};
        const auto& picture = session.picture();
        for (std::size_t i = 0; i < rgb.size() / 3; ++i) {
            std::copy_n(picture.rgba.data() + 4 * i, 3, rgb.data() + 3 * i);
        }
        states.clear();
        for (const sim::AircraftState& state : session.states()) { states.push_back(library::state_from(state)); }
        if (recorder) { recorder->add(record, session); }
    }

    ui::settings::RunSettings settings;
    ui::flight::Session session;
    std::optional<ui::flight::FlightRecorder> recorder;
    pid_t process = getpid();
    bool is_finished = false;
    int first = 0;
    int next_frame = 0;
    double time_s = 0.0;
    FrameTiming timing;
    std::vector<std::uint8_t> rgb;
    std::vector<State> states;
};

Flight::Flight(const FlightSettings& settings) {
    const auto on_note = [&](std::string_view note) {
        const std::string text = ui::settings::with_setting_names(note);
        if (settings.on_note) {
            settings.on_note(text);
        } else {
            std::clog << "octant: " << text << '\n';
        }
    };
    try {
        impl_ = std::make_unique<Impl>(settings, on_note);
    } catch (const Error& fault) {
        std::string text = ui::settings::with_setting_names(fault.what());
        if (text.starts_with("--record:")) { text.erase(0, 2); }
        throw Error(text);
    }
}

Flight::~Flight() {
    // A forked child cannot wait for threads that it has not.
    if (impl_ && !impl_->is_own_process()) { static_cast<void>(impl_.release()); }
}

Flight::Flight(Flight&&) noexcept = default;
Flight& Flight::operator=(Flight&&) noexcept = default;

std::size_t Flight::frame_count() const { return static_cast<std::size_t>(impl_->session.frames() - impl_->first); }

int Flight::width() const { return impl_->settings.view.size_px.x; }

int Flight::height() const { return impl_->settings.view.size_px.y; }

bool Flight::next() {
    impl_->check_process();
    if (impl_->is_finished || impl_->next_frame >= impl_->session.frames()) { return false; }
    impl_->draw();
    return true;
}

void Flight::finish() {
    impl_->check_process();
    if (impl_->is_finished) { return; }
    impl_->is_finished = true;
    if (!impl_->recorder) { return; }
    const int drawn = impl_->next_frame - impl_->first;
    const bool all = impl_->next_frame == impl_->session.frames();
    const ui::flight::FlightResult result = impl_->recorder->finish(
        impl_->session, all ? std::string() : fmt::format("the caller after {} of {} frames", drawn, frame_count()));
    if (!result.fault.empty()) { throw Error(result.fault); }
}

std::size_t Flight::frame() const { return static_cast<std::size_t>(std::max(0, impl_->next_frame - 1)); }

double Flight::time_s() const { return impl_->time_s; }

std::span<const std::uint8_t> Flight::rgb() const { return impl_->rgb; }

std::span<const State> Flight::states() const { return impl_->states; }

const FrameTiming& Flight::timing() const { return impl_->timing; }

void write_report(std::span<const std::string> recordings, const std::string& file) {
    if (recordings.empty()) { throw Error("recordings: expected one or more, got none"); }
    const std::vector<ui::report::LoadedRecording> loaded =
        ui::report::load_recordings(std::vector<std::filesystem::path>(recordings.begin(), recordings.end()));
    const auto flights = ui::report::compared_flights(loaded, &ui::settings::comparison_role, {});
    const auto changes = ui::report::flight_changes(loaded, flights, &ui::settings::comparison_role);
    const std::filesystem::path path = file;
    write_file(
        path, ui::report::html_report(loaded,
                  {.folder = std::filesystem::absolute(path).parent_path(), .flights = flights, .changes = changes}));
}

std::vector<State> path_states(const World& world, double rate_hz) {
    if (!(rate_hz > 0.0 && rate_hz <= 1000.0)) {
        throw Error(fmt::format("rate_hz: expected a number above 0, at most 1000, got {}", rate_hz));
    }
    if (ui::library::settings_of(world).path.name == ui::settings::live_path) {
        throw Error("path: expected a world with a path, got one without");
    }
    const sim::Trajectory& path = ui::library::loaded_world(world).flight.trajectory;
    std::vector<State> states;
    for (long number = 0;; ++number) {
        const double time_s = path.start_s() + static_cast<double>(number) / rate_hz;
        if (time_s >= path.end_s()) { break; }
        states.push_back(library::state_from(path.state_at(time_s)));
    }
    states.push_back(library::state_from(path.state_at(path.end_s())));
    return states;
}

static_assert(steps_per_second == sim::steps_per_second);

struct PilotedAircraft::Impl {
    std::unique_ptr<sim::PilotedFlight> flight;
};

PilotedAircraft::PilotedAircraft(const std::string& aircraft, const State& start)
    : impl_(new Impl{sim::make_piloted_flight(sim::aircraft_kind(aircraft), library::aircraft_state(start))}) {}

PilotedAircraft::~PilotedAircraft() = default;
PilotedAircraft::PilotedAircraft(PilotedAircraft&&) noexcept = default;
PilotedAircraft& PilotedAircraft::operator=(PilotedAircraft&&) noexcept = default;

void PilotedAircraft::advance(const Controls& controls, int steps) {
    const sim::PilotControls asked{
        .pitch = controls.pitch, .roll = controls.roll, .yaw = controls.yaw, .throttle = controls.throttle};
    for (int step = 0; step < steps; ++step) { impl_->flight->step(asked); }
}

State PilotedAircraft::state() const { return library::state_from(impl_->flight->state()); }

double PilotedAircraft::trim_throttle() const { return impl_->flight->trim_throttle(); }

bool PilotedAircraft::is_stalled() const { return impl_->flight->warnings().stalled; }

bool PilotedAircraft::is_at_limit() const { return impl_->flight->warnings().is_at_limit; }

} // namespace octant
