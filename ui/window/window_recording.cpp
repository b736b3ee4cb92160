#include "ui/window/window_recording.h"

#include "flightpaths/track_writer.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/stopwatch.h"
#include "sim/flight_steps.h"
#include "ui/flight/flight_recorder.h"
#include "ui/settings/settings_file.h"
#include "ui/world/input_files.h"
#include "visuals/groundfile/ground_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace octant::ui::window {

namespace scene = visuals::scene;

namespace {

constexpr double picture_every_s = 1.0;
constexpr double flush_every_s = 0.5;
constexpr const char* flight_name = "flight.csv";

/// Returns settings that fly without a window what a window flies from this step on.
settings::RunSettings from_step(
    const flight::Session& session, long step, const std::filesystem::path& folder, bool by_hand) {
    settings::RunSettings settings =
        world::settings_in_recording(world::with_absolute_paths(session.settings()), folder);
    settings.drawing.context = settings::ContextKind::OsMesa;
    settings.time.frames.reset();
    settings.time.seconds.reset();
    const sim::Trajectory& path = session.world().flight.trajectory;
    settings.time.start_s = std::max(0.0, sim::time_of_step(step) - path.start_s());
    if (by_hand) {
        settings.path.name = flight_name;
        settings.path.place = "0,0";
        settings.path.heading_deg = 0.0;
        settings.path.height_mode = sim::HeightMode::Datum;
        settings.time.start_s = 0.0;
    }
    return settings;
}

/// Returns the simulation step of the session's time, which is simulated first where the session only went to that
/// time. Throws Error at a path's end.
long first_step_of(flight::Session& session) {
    flight::Simulation& simulation = session.simulation();
    simulation.advance_to(simulation.time_s());
    if (!simulation.by_hand() && simulation.time_s() >= session.world().flight.trajectory.end_s()) {
        throw Error("the path has ended: begin it again (Home), then record");
    }
    return simulation.step();
}

report::RunInfo info_of(
    const flight::Session& session, const settings::RunSettings& to_repeat, const std::filesystem::path& folder) {
    report::RunInfo info = flight::run_info(world::with_absolute_paths(session.settings()), session, folder);
    info.settings_json = settings::settings_json(to_repeat).dump(2);
    info.facts.emplace_back(report::window_fact, "in a window, by the clock");
    return info;
}

/// Returns the states as lines of a track file, `with_head` for its first lines.
std::string lines_of(std::span<const sim::AircraftState> states, bool with_head) {
    const std::string text =
        flightpaths::exact_track_csv(sim::Trajectory(std::vector<sim::AircraftState>(states.begin(), states.end())));
    return with_head ? text : text.substr(text.find('\n') + 1);
}

} // namespace

WindowRecording::WindowRecording(std::filesystem::path folder, flight::Session& session)
    : first_step_(first_step_of(session)),
      recording_(
          folder, info_of(session, from_step(session, first_step_, folder, session.simulation().by_hand()), folder)),
      by_hand_(session.simulation().by_hand()), last_time_s_(sim::time_of_step(first_step_)),
      next_picture_s_(last_time_s_) {
    session.simulation().start_log();
    last_hash_ = session.simulation().state_hash();
}

void WindowRecording::append_states(flight::Session& session) {
    const auto log = session.simulation().log();
    if (!flight_) { flight_.emplace(recording_.folder() / flight_name); }
    if (states_written_ < log.size()) {
        flight_->append(lines_of(log.subspan(states_written_), states_written_ == 0));
        states_written_ = log.size();
    }
    flight_->flush();
}

void WindowRecording::add(report::FrameRecord record, flight::Session& session) {
    if (std::exchange(first_is_older_, false)) { return; }
    const Stopwatch writing;
    record.frame = frames_++;
    last_time_s_ = record.sim_time_s;
    last_hash_ = session.state_hash_of_last_picture();
    if (!by_hand_ && session.simulation().by_hand()) {
        by_hand_ = true;
        recording_.set_settings(settings::settings_json(settings_to_repeat(session)).dump(2));
    }
    if (record.sim_time_s >= next_picture_s_) {
        session.read_picture();
        recording_.add_picture(record.frame, flight::pixel_view_of(session.picture()));
        next_picture_s_ += picture_every_s;
    }
    if (by_hand_ && record.wall_s - flushed_wall_s_ >= flush_every_s) {
        append_states(session);
        flushed_wall_s_ = record.wall_s;
    }
    record.record_ms = writing.ms();
    recording_.add(record);
}

double WindowRecording::length_s() const { return last_time_s_ - sim::time_of_step(first_step_); }

/// Returns the number of states from the first step to that of the last picture. It is smaller where a flight by hand
/// ended before.
std::size_t WindowRecording::states_to_the_end(flight::Session& session) const {
    const long steps = sim::step_at(last_time_s_) - first_step_ + 1;
    return std::min(static_cast<std::size_t>(steps), session.simulation().log().size());
}

settings::RunSettings WindowRecording::settings_to_repeat(flight::Session& session) const {
    settings::RunSettings settings = from_step(session, first_step_, recording_.folder(), by_hand_);
    const long steps = sim::step_at(last_time_s_) - first_step_;
    if (!by_hand_ && steps > 0) {
        settings.time.seconds = sim::time_of_step(steps);
    } else if (!by_hand_) {
        settings.time.frames = 1;
    }
    return settings;
}

std::string WindowRecording::finish(flight::Session& session) {
    const auto states = session.simulation().log().first(states_to_the_end(session));
    recording_.set_settings(settings::settings_json(settings_to_repeat(session)).dump(2));
    if (by_hand_) {
        flight_.reset();
        write_file(recording_.folder() / flight_name, lines_of(states, true));
    }
    flight::write_tracks(recording_.folder(), session.world(),
        sim::Trajectory(std::vector<sim::AircraftState>(states.begin(), states.end())),
        session.world().ground.frame.get());
    recording_.finish(
        {last_hash_, std::nullopt, report::read_cpu_times(), visuals::groundfile::tile_damage_messages()});
    session.simulation().stop_log();
    return flight::write_report(recording_.folder());
}

} // namespace octant::ui::window
