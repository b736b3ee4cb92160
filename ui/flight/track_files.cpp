#include "ui/flight/track_files.h"

#include "flightpaths/track_writer.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::flight {

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

} // namespace

void write_tracks(const std::filesystem::path& folder, const world::World& world, const sim::Trajectory& flight,
    const EarthFrame* frame) {
    write_file(folder / "track.csv", flightpaths::track_csv(flight));
    write_file(folder / "track.acmi", flightpaths::track_acmi(flight, acmi_header(world, flight, frame)));
}

void write_tracks(const std::filesystem::path& folder, const world::World& world, double until_s) {
    write_tracks(folder, world, flown(world.flight.trajectory, until_s), world.ground_frame.get());
}

StreamedTracks::StreamedTracks(const std::filesystem::path& folder, const world::World& world)
    : tracks_{Track{AppendedFile(folder / "track.csv"), flightpaths::track_csv(world.flight.trajectory)},
          Track{AppendedFile(folder / "track.acmi"),
              flightpaths::track_acmi(
                  world.flight.trajectory, acmi_header(world, world.flight.trajectory, world.ground_frame.get()))}} {}

void StreamedTracks::write_until(double time_s) {
    for (Track& track : tracks_) {
        const std::string_view flown = rows_until(track.text, track.written, time_s);
        track.file.append(flown);
        track.written += flown.size();
    }
    if (!flushed_s_ || time_s - *flushed_s_ >= flush_every_s) {
        for (Track& track : tracks_) { track.file.flush(); }
        flushed_s_ = time_s;
    }
}

StreamedLiveTracks::StreamedLiveTracks(const std::filesystem::path& folder, const world::World& world)
    : csv_(folder / "track.csv"), acmi_(folder / "track.acmi"),
      header_(acmi_header(world, world.flight.trajectory, nullptr)) {
    csv_.append(flightpaths::track_csv_names());
}

void StreamedLiveTracks::add(const sim::AircraftState& state, bool is_flown, const EarthFrame* frame) {
    csv_.append(flightpaths::track_csv_line(state));
    header_.frame = frame;
    if (is_flown_ || is_flown) {
        const bool is_first = !std::exchange(is_flown_, true);
        acmi_.append(is_first ? flightpaths::acmi_head(header_) : std::string());
        acmi_.append(flightpaths::acmi_state(state, header_, is_first));
    }
    if (!flushed_s_ || state.time_s - *flushed_s_ >= flush_every_s) {
        flush();
        flushed_s_ = state.time_s;
    }
}

void StreamedLiveTracks::flush() {
    csv_.flush();
    acmi_.flush();
}

} // namespace octant::ui::flight
