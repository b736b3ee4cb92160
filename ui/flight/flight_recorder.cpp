#include "ui/flight/flight_recorder.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"
#include "ui/base/json_value.h"
#include "ui/base/stopwatch.h"
#include "ui/base/version.h"
#include "ui/flight/track_files.h"
#include "ui/report/html_report.h"
#include "ui/report/loaded_recording.h"
#include "ui/report/run_file.h"
#include "ui/settings/settings_file.h"
#include "ui/world/input_files.h"
#include "visuals/groundfile/ground_file.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <system_error>

namespace octant::ui::flight {

namespace scene = visuals::scene;

namespace {

std::string adaptation_text(const StressSettings& stress) {
    return fmt::format("terrain: {} to {} triangles; left alone at a stress of {:.2f} to {:.2f}, else brought to "
                       "the middle by at most {:.1f} % down and {:.1f} % up a frame; stress filtered over "
                       "{:.1f} s, for the control with no frame above {:.1f} and carried over to each new target",
        stress.min_triangles, stress.max_triangles, stress.min_stress, stress.max_stress, 100.0 * stress.max_fall,
        100.0 * stress.max_rise, stress.filter_s, stress.max_counted_stress);
}

} // namespace

report::PixelView pixel_view_of(const visuals::scene::Picture& picture) {
    return {picture.width, picture.height, 4, std::as_bytes(std::span(picture.rgba)), false};
}

report::RunInfo run_info(
    const settings::RunSettings& settings, const Session& session, const std::filesystem::path& folder) {
    const world::Flight& flight = session.world().flight;
    report::RunInfo info;
    info.title = flight.title;
    info.settings_json = settings::settings_json(world::settings_in_recording(settings, folder)).dump(2);
    info.version = base::program_version();
    info.commit = base::program_commit();
    info.program_hash = base::program_hash();
    info.device = session.renderer().info().device;
    info.rate_hz = session.rate_hz();
    info.path_offset_m = {flight.place_m.x, flight.place_m.y, flight.offset_m};
    info.machine = report::read_machine_info(std::chrono::system_clock::now());
    info.facts = {{"ground", session.world().ground_name},
        {"path turned by", fmt::format("{:.1f} degrees", deg_from_rad(flight.heading_rad))},
        {"path lifted by", fmt::format("{:.1f} m", flight.offset_m)},
        {"lowest clearance", fmt::format("{:.1f} m at {:.2f} s", flight.lowest_clearance_m, flight.lowest_clearance_s)},
        {"drawn by", session.renderer().info().description}};
    if (settings.adapt.terrain) {
        info.facts.emplace_back("adaptation", adaptation_text(stress_settings(settings, session.rate_hz())));
    }
    for (const flightpaths::LegStart& leg : flight.legs) { info.legs.push_back({leg.label, leg.time_s}); }
    info.notes = session.world().notes;
    info.inputs = world::input_hashes(settings);
    info.files = world::files_to_copy(settings, session.world().aircraft.order_files);
    return info;
}

bool is_already_recorded(const RecordOptions& options, const settings::RunSettings& settings) {
    std::error_code ignored;
    if (!options.folder || !report::is_run_file(*options.folder / "run.json") ||
        (options.video && !std::filesystem::is_regular_file(*options.video, ignored))) {
        return false;
    }
    using Json = nlohmann::ordered_json;
    const auto file = *options.folder / "run.json";
    const Json run = report::parsed_json(file, read_text_file(file));
    const Json program = {{"name", "octant"}, {"version", base::program_version()}, {"commit", base::program_commit()},
        {"hash", base::program_hash()}};
    Json inputs = Json::object();
    for (const auto& [input, hash] : world::input_hashes(settings)) { inputs[base::json_from_file_name(input)] = hash; }
    return run.contains("summary") && !run.contains("stopped") &&
           run.value("settings", Json()) ==
               settings::settings_json(world::settings_in_recording(settings, *options.folder)) &&
           run.value("inputs", Json()) == inputs && run.value("program", Json()) == program;
}

std::string write_report(const std::filesystem::path& folder) {
    const report::LoadedRecording loaded = report::load_recording(folder);
    const auto file = folder / "report.html";
    write_file(file, report::html_report(std::span(&loaded, 1)));
    return fmt::format("report: {}", file.string());
}

FlightRecorder::FlightRecorder(
    const RecordOptions& options, const settings::RunSettings& settings, const Session& session)
    : options_(options),
      picture_every_(settings.time.pictures.value_or(std::max(1, static_cast<int>(std::lround(session.rate_hz()))))) {
    if (options.video) {
        video_.emplace(*options.video,
            report::VideoFormat{settings.view.size_px.x, settings.view.size_px.y, 4, false, session.rate_hz()});
    }
    if (options.folder) {
        report::RunInfo info = run_info(settings, session, *options.folder);
        if (options.replay_of) { info.facts.emplace_back("replay of", options.replay_of->filename().string()); }
        if (!options.batch_context.empty()) {
            info.facts.emplace_back(report::batch_context_fact, options.batch_context);
        }
        recording_.emplace(*options.folder, std::move(info));
        if (settings.path.name == settings::live_path) {
            live_tracks_.emplace(*options.folder, session.world());
        } else {
            tracks_.emplace(*options.folder, session.world());
        }
    }
}

void FlightRecorder::add(report::FrameRecord record, Session& session) {
    const base::Stopwatch writing;
    flown_until_s_ = record.sim_time_s;
    record.picture_hash = session.hash_picture();
    if (recording_ && picture_every_ > 0) {
        slow_pictures_.add(record, pixel_view_of(session.picture()));
        if (record.frame % picture_every_ == 0) {
            recording_->add_picture(record.frame, pixel_view_of(session.picture()));
        }
    }
    if (video_) { video_->add(pixel_view_of(session.picture())); }
    record.record_ms = writing.ms();
    if (recording_) {
        if (tracks_) { tracks_->write_until(record.sim_time_s); }
        if (live_tracks_) {
            const StateSource& source = session.simulation().source();
            live_tracks_->add(session.states().front(), source.is_flown(0), source.frame());
        }
        recording_->add(record);
    } else {
        times_.add(record);
    }
}

FlightResult FlightRecorder::finish(const Session& session, const std::string& stopped) {
    FlightResult end;
    // A stopped flight may have simulated the next picture's time already.
    end.state_hash = stopped.empty() ? session.state_hash() : session.state_hash_of_last_picture();
    end.picture_hash = session.picture_hash();
    if (video_) {
        if (const auto fault = video_->finish()) {
            end.fault = fmt::format("{}: {}", options_.video->string(), *fault);
        } else {
            end.notes.push_back(fmt::format("video: {}", options_.video->string()));
        }
    }
    if (recording_) {
        end.statistics = recording_->finish({end.state_hash, end.picture_hash, report::read_cpu_times(),
            visuals::groundfile::tile_damage_messages(), stopped});
        slow_pictures_.write(*options_.folder);
        if (tracks_) {
            tracks_.reset();
            write_tracks(*options_.folder, session.world(), flown_until_s_);
        }
        if (live_tracks_) {
            live_tracks_->flush();
            live_tracks_.reset();
        }
        end.notes.push_back(write_report(*options_.folder));
    } else {
        end.statistics = times_.statistics();
    }
    return end;
}

} // namespace octant::ui::flight
