#include "ui/flight/flight_recorder.h"

#include "flightpaths/limits_check.h"
#include "flightpaths/track_writer.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/stopwatch.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"
#include "ui/base/data_files.h"
#include "ui/base/json_value.h"
#include "ui/base/version.h"
#include "ui/report/html_report.h"
#include "ui/report/loaded_recording.h"
#include "ui/report/run_file.h"
#include "ui/settings/settings_file.h"
#include "ui/world/input_files.h"
#include "ui/world/track_facts.h"
#include "visuals/groundfile/ground_file.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <list>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace octant::ui::flight {

namespace scene = visuals::scene;

namespace {

/// Times in files have six decimals at the least.
constexpr double rounding_s = 1e-6;

constexpr double flush_every_s = 1.0;

sim::Trajectory flown(const sim::Trajectory& path, double until_s) {
    std::vector<sim::AircraftState> samples(path.samples().begin(), path.samples().end());
    const auto end = std::find_if(samples.begin() + 1, samples.end(),
        [&](const sim::AircraftState& sample) { return sample.time_s > until_s + rounding_s; });
    samples.erase(end, samples.end());
    return sim::Trajectory(std::move(samples));
}

/// The part of a track file's text from `begin` on that was flown by a time: up to the first line that tells a later
/// one. Such lines begin with digits in track.csv, with # in track.acmi.
std::string_view rows_until(std::string_view text, std::size_t begin, double until_s) {
    std::size_t at = begin;
    while (at < text.size()) {
        const std::size_t end = text.find('\n', at) + 1;
        std::string_view line = text.substr(at, end - at - 1);
        if (line.starts_with('#')) {
            line.remove_prefix(1);
        } else {
            line = line.substr(0, line.find(','));
        }
        const bool tells_time = text[at] == '#' || text.front() == 't';
        const auto time_s = tells_time ? finite_number(line) : std::nullopt;
        if (time_s && *time_s > until_s + rounding_s) { break; }
        at = end;
    }
    return text.substr(begin, at - begin);
}

/// The tracks of all aircraft but the first: recorded ones and those with a path of their own as they are, wingmen
/// where the first one has a sample.
struct OtherTracks {
    std::list<sim::Trajectory> trajectories;
    std::vector<flightpaths::WrittenTrack> tracks;
};

/// Up to a time. Not of more than 256 aircraft: the others repeat the first one's path beside it.
OtherTracks other_tracks(const world::World& world, const sim::Trajectory& leader, double until_s) {
    constexpr std::size_t most = 256;
    OtherTracks others;
    const world::PlacedFlight& flight = world.flight;
    const world::Formation formation = world::formation_of(world.scene, flight);
    std::set<std::string> names{flight.name};
    const std::vector<std::string>& shapes = world.aircraft.inputs.shapes;
    int wingmen = 0;
    for (std::size_t i = 1; i < std::min(most, world.scene.aircraft.size()); ++i) {
        const auto own = flight.other_trajectories.find(i);
        std::vector<sim::AircraftState> states;
        if (own == flight.other_trajectories.end()) {
            // Of a long flight by hand, wingmen would fill the disk.
            constexpr std::size_t most_samples = 1000000;
            if (leader.samples().size() * static_cast<std::size_t>(++wingmen) > most_samples) { continue; }
            for (const sim::AircraftState& state : leader.samples()) {
                states.push_back(formation.wingman_state(state, wingmen));
            }
        } else {
            const auto samples = own->second.samples();
            std::ranges::copy_if(samples, std::back_inserter(states),
                [&](const sim::AircraftState& state) { return state.time_s <= until_s + rounding_s; });
        }
        if (states.empty()) { continue; }
        const auto known = flight.other_names.find(i);
        std::string name = known == flight.other_names.end() ? fmt::format("aircraft {}", i + 1) : known->second;
        for (int more = 2; !names.insert(name).second; ++more) {
            name = fmt::format("{} ({})", known == flight.other_names.end() ? "aircraft" : known->second, more);
        }
        others.trajectories.emplace_back(std::move(states));
        others.tracks.push_back({&others.trajectories.back(),
            i < shapes.size() ? sim::find_aircraft_kind(shapes[i]) : nullptr, std::move(name)});
    }
    return others;
}

/// The name of the first of several aircraft.
std::string leader_name(const world::World& world) {
    return world.flight.name.empty() ? "aircraft 1" : world.flight.name;
}

flightpaths::AcmiHeader acmi_header(const world::World& world, const sim::Trajectory& flight, const EarthFrame* frame) {
    flightpaths::AcmiHeader header;
    header.title = world.flight.title;
    header.kind = world.leader_kind;
    header.aircraft = world.scene.model_of(0).polygons.name;
    for (const flightpaths::LegStart& leg : world.flight.legs) {
        if (leg.time_s >= flight.start_s() && leg.time_s <= flight.end_s() + rounding_s) {
            header.bookmarks.push_back(leg);
        }
    }
    header.frame = frame;
    return header;
}

flightpaths::AcmiHeader acmi_header_of_several(
    const world::World& world, const sim::Trajectory& flight, const EarthFrame* frame, const OtherTracks& others) {
    flightpaths::AcmiHeader header = acmi_header(world, flight, frame);
    if (!others.tracks.empty()) {
        header.call_sign = leader_name(world);
        header.others = others.tracks;
    }
    return header;
}

} // namespace

void write_tracks(const std::filesystem::path& folder, const world::World& world, const sim::Trajectory& flight,
    const EarthFrame* frame) {
    const OtherTracks others = other_tracks(world, flight, flight.end_s());
    write_file(folder / "track.csv", flightpaths::track_csv(flight, leader_name(world), others.tracks));
    write_file(
        folder / "track.acmi", flightpaths::track_acmi(flight, acmi_header_of_several(world, flight, frame, others)));
}

/// The tracks of a flight while it is flown, in track.csv and track.acmi. Each is given only what has been flown, and
/// is flushed at the first picture and then once a simulated second, so that a killed flight leaves its tracks up to
/// the last flush. Throws Error (disk full).
class TrackFiles {
public:
    TrackFiles() = default;
    virtual ~TrackFiles() = default;
    TrackFiles(const TrackFiles&) = delete;
    TrackFiles& operator=(const TrackFiles&) = delete;
    TrackFiles(TrackFiles&&) = delete;
    TrackFiles& operator=(TrackFiles&&) = delete;

    /// Appends what was flown up to the session's last picture.
    void add(const Session& session, double time_s) {
        append(session, time_s);
        if (!flushed_s_ || time_s - *flushed_s_ >= flush_every_s) {
            flush();
            flushed_s_ = time_s;
        }
    }

    virtual void finish(const Session& session, double flown_until_s) = 0;

    /// What the report should say that nobody knew before the flight.
    virtual std::vector<std::string> notes() const { return {}; }

private:
    virtual void append(const Session& session, double time_s) = 0;
    virtual void flush() = 0;

    std::optional<double> flushed_s_;
};

namespace {

/// The tracks of a flight along the world's path.
class PathTracks final : public TrackFiles {
public:
    PathTracks(const std::filesystem::path& folder, const world::World& world) : folder_(folder) {
        const sim::Trajectory& path = world.flight.trajectory;
        const OtherTracks others = other_tracks(world, path, std::numeric_limits<double>::infinity());
        tracks_.emplace_back(folder / "track.csv", flightpaths::track_csv(path, leader_name(world), others.tracks));
        tracks_.emplace_back(folder / "track.acmi",
            flightpaths::track_acmi(path, acmi_header_of_several(world, path, world.ground.frame.get(), others)));
        append_until(
            -std::numeric_limits<double>::infinity()); // the heads: a kill before the first picture leaves them
        flush();
    }

    void finish(const Session& session, double flown_until_s) override {
        tracks_.clear();
        const world::World& world = session.world();
        write_tracks(folder_, world, flown(world.flight.trajectory, flown_until_s), world.ground.frame.get());
    }

private:
    void append(const Session& /*session*/, double time_s) override { append_until(time_s); }

    void append_until(double time_s) {
        for (Track& track : tracks_) {
            const std::string_view flown = rows_until(track.text, track.written, time_s);
            track.file.append(flown);
            track.written += flown.size();
        }
    }

    void flush() override {
        for (Track& track : tracks_) { track.file.flush(); }
    }

    struct Track {
        Track(std::filesystem::path path, std::string whole) : file(std::move(path)), text(std::move(whole)) {}

        AppendedFile file;
        /// Of the whole path.
        std::string text;
        std::size_t written = 0;
    };

    std::filesystem::path folder_;
    std::list<Track> tracks_;
};

/// The tracks of a flight that others fly, which nobody knows beforehand: track.csv has the states of all pictures,
/// track.acmi those since the first aircraft is flown, as its place on the earth is known by then. Other aircraft are
/// there while somebody flies them.
class LiveTracks final : public TrackFiles {
public:
    LiveTracks(const std::filesystem::path& folder, const world::World& world)
        : csv_(folder / "track.csv"), acmi_(folder / "track.acmi"),
          header_(acmi_header(world, world.flight.trajectory, nullptr)), aircraft_(world.scene.aircraft.size()) {
        const std::vector<std::string>& shapes = world.aircraft.inputs.shapes;
        for (std::size_t i = 0; i < aircraft_.size(); ++i) {
            aircraft_[i].written = {.kind = i == 0              ? world.leader_kind
                                            : i < shapes.size() ? sim::find_aircraft_kind(shapes[i])
                                                                : nullptr,
                .name = i == 0 ? leader_name(world) : fmt::format("aircraft {}", i + 1)};
        }
        if (aircraft_.size() > 1) { header_.call_sign = aircraft_.front().written.name; }
        csv_.append(flightpaths::track_csv_names(aircraft_.size() > 1));
    }

    void finish(const Session& /*session*/, double /*flown_until_s*/) override { flush(); }

    /// Of each aircraft of a known type that was flown beyond its limits.
    std::vector<std::string> notes() const override {
        std::vector<std::string> notes;
        for (const LiveAircraft& one : aircraft_) {
            if (one.written.kind == nullptr || one.flown.size() < 2) { continue; }
            const std::string beyond =
                flightpaths::limits_violation(one.written.kind->limits, sim::Trajectory(one.flown), false);
            if (!beyond.empty()) {
                notes.push_back(fmt::format(
                    "{}, a {} is flown beyond its limits: {}", one.written.name, one.written.kind->name, beyond));
            }
        }
        return notes;
    }

private:
    struct LiveAircraft {
        flightpaths::WrittenTrack written;
        /// For its limits: ten a second, of the first hours.
        std::vector<sim::AircraftState> flown;
        bool is_there = false;
    };

    void append(const Session& session, double /*time_s*/) override {
        const StateSource& source = session.simulation().source();
        const std::span<const sim::AircraftState> states = session.states();
        header_.frame = source.frame();
        for (std::size_t i = 0; i < std::min(states.size(), aircraft_.size()); ++i) {
            LiveAircraft& one = aircraft_[i];
            const bool is_flown = source.is_flown(i) && (i == 0 || states[i].is_present);
            if (i == 0 || is_flown) {
                csv_.append(flightpaths::track_csv_line(
                    states[i], aircraft_.size() > 1 ? std::optional(one.written.name) : std::nullopt));
            }
            if (is_flown) { keep(states[i], one.flown); }
            if (i == 0) {
                append_first(states[i], is_flown);
            } else if (aircraft_.front().is_there) {
                append_other(states[i], i, is_flown);
            }
        }
    }

    void append_first(const sim::AircraftState& state, bool is_flown) {
        bool& is_there = aircraft_.front().is_there;
        if (!is_there && !is_flown) { return; }
        const bool is_first = !std::exchange(is_there, true);
        acmi_.append(is_first ? flightpaths::acmi_head(header_) : std::string());
        acmi_.append(flightpaths::acmi_state(state, header_, is_first));
    }

    void append_other(const sim::AircraftState& state, std::size_t index, bool is_flown) {
        LiveAircraft& one = aircraft_[index];
        const bool was_there = std::exchange(one.is_there, is_flown);
        if (is_flown) {
            acmi_.append(
                flightpaths::acmi_state_of_other(state, index + 1, header_.frame, was_there ? nullptr : &one.written));
        } else if (was_there) {
            acmi_.append(flightpaths::acmi_end_of_other(index + 1));
        }
    }

    static void keep(const sim::AircraftState& state, std::vector<sim::AircraftState>& flown) {
        constexpr double step_s = 0.1;
        constexpr std::size_t most = 100000;
        if (flown.size() < most && (flown.empty() || state.time_s >= flown.back().time_s + step_s)) {
            flown.push_back(state);
        }
    }

    void flush() override {
        csv_.flush();
        acmi_.flush();
    }

    AppendedFile csv_;
    AppendedFile acmi_;
    flightpaths::AcmiHeader header_;
    std::vector<LiveAircraft> aircraft_;
};

std::string adaptation_text(const StressSettings& stress) {
    return fmt::format("terrain: {} to {} triangles; left alone at a stress of {:.2f} to {:.2f}, else brought to "
                       "the middle by at most {:.1f} % down and {:.1f} % up a frame; stress filtered over "
                       "{:.1f} s, for the control with no frame above {:.1f} and carried over to each new target",
        stress.min_triangles, stress.max_triangles, stress.min_stress, stress.max_stress, 100.0 * stress.max_fall,
        100.0 * stress.max_rise, stress.filter_s, stress.max_counted_stress);
}

/// The map and heights of a recorded track; none where the library that draws them is missing.
void write_track_picture(const std::filesystem::path& folder, const world::World& world) {
    if (!world.flight.recording) { return; }
    try {
        report::write_png(folder / report::track_picture_name,
            report::track_picture(world::track_curves(*world.flight.recording)).view());
    } catch (const Error&) { return; } // the report goes without it
}

} // namespace

report::PixelView pixel_view_of(const visuals::scene::Picture& picture) {
    return {.width_px = picture.width,
        .height_px = picture.height,
        .channels = 4,
        .bytes = std::as_bytes(std::span(picture.rgba))};
}

report::RunInfo run_info(
    const settings::RunSettings& settings, const Session& session, const std::filesystem::path& folder) {
    const world::PlacedFlight& flight = session.world().flight;
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
    info.facts = {{"ground", session.world().ground.name},
        {"path turned by", fmt::format("{:.1f} degrees", deg_from_rad(flight.heading_rad))},
        {"path lifted by", fmt::format("{:.1f} m", flight.offset_m)},
        {"lowest clearance", fmt::format("{:.1f} m at {:.2f} s", flight.lowest_clearance_m, flight.lowest_clearance_s)},
        {"drawn by", session.renderer().info().description}};
    if (settings.adapt.terrain) {
        info.facts.emplace_back("adaptation", adaptation_text(stress_settings(settings, session.rate_hz())));
    }
    for (const flightpaths::LegStart& leg : flight.legs) { info.legs.push_back({leg.label, leg.time_s}); }
    if (flight.recording) {
        const world::NamedTexts facts =
            world::track_facts(*flight.recording, flight.inferences, flight.ground_contacts);
        info.facts.insert(info.facts.end(), facts.begin(), facts.end());
    }
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
        video_.emplace(*options.video, report::VideoFormat{.width_px = settings.view.size_px.x,
                                           .height_px = settings.view.size_px.y,
                                           .channels = 4,
                                           .frames_per_s = session.rate_hz()});
    }
    if (options.folder) {
        report::RunInfo info = run_info(settings, session, *options.folder);
        if (options.replay_of) { info.facts.emplace_back("replay of", options.replay_of->filename().string()); }
        if (!options.machine_sharing.empty()) {
            info.facts.emplace_back(report::machine_sharing_fact, options.machine_sharing);
        }
        recording_.emplace(*options.folder, std::move(info));
        if (settings.path.name == settings::live_path) {
            tracks_ = std::make_unique<LiveTracks>(*options.folder, session.world());
        } else {
            tracks_ = std::make_unique<PathTracks>(*options.folder, session.world());
            write_track_picture(*options.folder, session.world());
        }
    }
}

FlightRecorder::~FlightRecorder() = default;

void FlightRecorder::add(report::FrameRecord record, Session& session) {
    const Stopwatch writing;
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
        tracks_->add(session, record.sim_time_s);
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
        std::vector<std::string> notes = visuals::groundfile::tile_damage_messages();
        const std::vector<std::string> of_tracks = tracks_->notes();
        notes.insert(notes.end(), of_tracks.begin(), of_tracks.end());
        end.statistics =
            recording_->finish({end.state_hash, end.picture_hash, report::read_cpu_times(), std::move(notes), stopped});
        slow_pictures_.write(*options_.folder);
        tracks_->finish(session, flown_until_s_);
        tracks_.reset();
        end.notes.push_back(write_report(*options_.folder));
    } else {
        end.statistics = times_.statistics();
    }
    return end;
}

} // namespace octant::ui::flight
