#include "ui/flight_recorder.h"

#include "flightpaths/track_writer.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"
#include "ui/report/html_report.h"
#include "ui/report/loaded_recording.h"
#include "ui/settings_file.h"
#include "ui/stopwatch.h"
#include "ui/version.h"

#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace octant::ui {

namespace scene = visuals::scene;

namespace {

report::PictureView view_of(const visuals::gl::Picture& picture) {
    return {picture.width, picture.height, 4, std::as_bytes(std::span(picture.rgba)), false};
}

report::RunInfo run_info(const scene::Settings& settings, const Session& session) {
    const Flight& flight = session.world().flight;
    report::RunInfo info;
    info.title = flight.title;
    info.settings_json = settings_json(settings).dump(2);
    info.version = program_version();
    info.commit = program_commit();
    info.gl_renderer = session.context().renderer;
    info.path_offset_m = {flight.place_m.x, flight.place_m.y, flight.offset_m};
    info.machine = report::read_machine_info(std::chrono::system_clock::now());
    info.facts = {
        {"ground", session.world().ground_name},
        {"path turned by", fmt::format("{:.1f} degrees", deg_from_rad(flight.heading_rad))},
        {"path lifted by", fmt::format("{:.1f} m", flight.offset_m)},
        {"lowest clearance",
         fmt::format("{:.1f} m at {:.2f} s", flight.lowest_clearance_m, flight.lowest_clearance_s)},
        {"drawn by",
         fmt::format("{}, OpenGL {}", session.context().kind, session.context().version)}};
    for (const std::string& note : session.world().notes) {
        info.facts.emplace_back("note", note);
    }
    return info;
}

} // namespace

bool is_recorded(const RecordOptions& options, const scene::Settings& settings) {
    if (!options.folder || !report::is_run_file(*options.folder / "run.json")) {
        return false;
    }
    const auto run =
        nlohmann::ordered_json::parse(read_text_file(*options.folder / "run.json"), nullptr, false);
    const nlohmann::ordered_json program = {
        {"name", "octant"}, {"version", program_version()}, {"commit", program_commit()}};
    return !run.is_discarded() && run.contains("summary") &&
           run.value("settings", nlohmann::ordered_json()) == settings_json(settings) &&
           run.value("program", nlohmann::ordered_json()) == program;
}

FlightRecorder::FlightRecorder(
    const RecordOptions& options, const scene::Settings& settings, const Session& session)
    : options_(options)
    , picture_every_(options.picture_every) {
    if (picture_every_ < 0) {
        picture_every_ = options.folder ? static_cast<int>(std::lround(session.rate_hz())) : 0;
    }
    if (options.picture_every > 0 && !options.folder) {
        throw Error("--pictures: expected --record DIR for the pictures, got none");
    }
    if (options.folder) {
        recording_.emplace(*options.folder, run_info(settings, session));
        write_tracks(session);
    }
    if (options.video) {
        video_.emplace(
            *options.video,
            report::VideoFormat{
                settings.size_px.x, settings.size_px.y, 4, false, session.rate_hz()});
    }
}

void FlightRecorder::write_tracks(const Session& session) const {
    const World& world = session.world();
    write_file(*options_.folder / "track.csv", flightpaths::track_csv(world.flight.trajectory));
    flightpaths::AcmiHeader header;
    header.title = world.flight.title;
    header.aircraft = world.scene.models[world.scene.aircraft.front()].polygons.name;
    header.bookmarks = world.flight.legs;
    if (world.ground_place) {
        header.origin = {world.ground_place->latitude_deg, world.ground_place->longitude_deg};
    }
    write_file(
        *options_.folder / "track.acmi", flightpaths::track_acmi(world.flight.trajectory, header));
}

void FlightRecorder::add(report::FrameRecord record, Session& session) {
    const Stopwatch writing;
    session.hash_picture();
    if (recording_ && picture_every_ > 0 && record.frame % picture_every_ == 0) {
        recording_->add_picture(record.frame, view_of(session.picture()));
    }
    if (video_) {
        video_->add(view_of(session.picture()));
    }
    record.record_ms = writing.ms();
    if (recording_) {
        recording_->add(record);
    } else {
        records_.push_back(record);
    }
}

std::string FlightRecorder::write_report() const {
    const report::LoadedRecording loaded = report::load_recording(*options_.folder);
    const auto file = *options_.folder / "report.html";
    write_file(file, report::html_report(std::span(&loaded, 1)));
    return fmt::format("report: {}", file.string());
}

FlightEnd FlightRecorder::finish(const Session& session) {
    FlightEnd end;
    end.state_hash = session.state_hash();
    end.picture_hash = session.picture_hash();
    if (video_) {
        const report::VideoResult result = video_->finish();
        end.notes.push_back(
            result.text.empty() ? fmt::format("video: {}", options_.video->string())
                                : fmt::format("video {}", result.text));
    }
    if (recording_) {
        end.statistics =
            recording_->finish({end.state_hash, end.picture_hash, report::read_cpu_times()});
        end.notes.push_back(write_report());
    } else {
        end.statistics = report::statistics_of(records_);
    }
    return end;
}

} // namespace octant::ui
