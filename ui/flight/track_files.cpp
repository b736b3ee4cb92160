#include "ui/flight/track_files.h"

#include "flightpaths/track_writer.h"
#include "sim/base/file_status.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::flight {

namespace {

constexpr double rounding_s = 1e-6; ///< times in files have six decimals at the least

sim::Trajectory flown(const sim::Trajectory& path, double until_s) {
    std::vector<sim::AircraftState> samples(path.samples().begin(), path.samples().end());
    const auto end =
        std::find_if(samples.begin() + 1, samples.end(), [&](const sim::AircraftState& sample) {
            return sample.time_s > until_s + rounding_s;
        });
    samples.erase(end, samples.end());
    return sim::Trajectory(std::move(samples));
}

/// Time at the head of a line of either track file: "12.5,..." or "#12.5"; nothing for others.
std::optional<double> time_of(std::string_view line) {
    if (!line.empty() && line.front() == '#') {
        return finite_number(line.substr(1));
    }
    return finite_number(line.substr(0, line.find(',')));
}

} // namespace

void write_tracks(
    const std::filesystem::path& folder,
    const world::World& world,
    const sim::Trajectory& flight,
    const std::optional<models::heights::GeoPlace>& origin) {
    write_file(folder / "track.csv", flightpaths::track_csv(flight));
    flightpaths::AcmiHeader header;
    header.title = world.flight.title;
    header.kind = world.leader_kind;
    header.aircraft = world.scene.model_of(0).polygons.name;
    for (const flightpaths::LegBegin& leg : world.flight.legs) {
        if (leg.time_s >= flight.start_s() && leg.time_s <= flight.end_s() + rounding_s) {
            header.bookmarks.push_back(leg);
        }
    }
    if (origin) {
        header.origin = {origin->latitude_deg, origin->longitude_deg};
    }
    write_file(folder / "track.acmi", flightpaths::track_acmi(flight, header));
}

void write_tracks(const std::filesystem::path& folder, const world::World& world, double until_s) {
    write_tracks(folder, world, flown(world.flight.trajectory, until_s), world.ground_place);
}

void cut_tracks(const std::filesystem::path& folder, double until_s) {
    for (const char* name : {"track.csv", "track.acmi"}) {
        if (!is_there(folder / name)) {
            continue;
        }
        const std::string text = read_text_file(folder / name);
        const bool timed_lines = std::string_view(name) == "track.csv";
        std::string kept;
        for (const std::string_view line : split_lines(text)) {
            const bool tells_time = timed_lines || (!line.empty() && line.front() == '#');
            const auto time_s = tells_time ? time_of(line) : std::nullopt;
            if (time_s && *time_s > until_s + rounding_s) {
                break;
            }
            kept += line;
            kept += '\n';
        }
        write_file(folder / name, kept);
    }
}

} // namespace octant::ui::flight
