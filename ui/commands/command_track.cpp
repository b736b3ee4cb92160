#include "flightpaths/track_motion.h"
#include "flightpaths/track_recording.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "ui/base/json_value.h"
#include "ui/base/progress.h"
#include "ui/commands/commands.h"
#include "ui/report/png_file.h"
#include "ui/report/track_picture.h"
#include "ui/world/path_loader.h"
#include "ui/world/track_facts.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <vector>

namespace octant::ui::commands {

using namespace command_line;

namespace {

struct TrackInfoOptions : base::OutputOptions {
    std::string file;
    std::string follow;
    std::string picture;
};

base::JsonValue aircraft_value(
    const flightpaths::TrackedAircraft& aircraft, std::size_t index, const flightpaths::TrackInference& inference) {
    const auto [lowest, highest] = std::ranges::minmax_element(
        aircraft.samples, {}, [](const flightpaths::TrackSample& sample) { return sample.position_m.z; });
    base::JsonValue value;
    value["name"] = flightpaths::display_name(aircraft, index);
    value["id"] = aircraft.id;
    value["type"] = aircraft.type;
    value["pilot"] = aircraft.pilot;
    value["samples"] = aircraft.samples.size();
    value["begin_s"] = aircraft.samples.front().time_s;
    value["end_s"] = aircraft.samples.back().time_s;
    value["lowest_m"] = lowest->position_m.z;
    value["highest_m"] = highest->position_m.z;
    value["measured"] = world::measured_text(aircraft);
    value["inferred"] = world::inferred_text(inference);
    value["not_flown_through"] = inference.rejected + inference.repeated;
    value["gaps"] = base::JsonValue::list({});
    for (const world::TrackGap& gap : world::gaps_of(aircraft)) {
        value["gaps"].push_back(fmt::format("{:.1f} s to {:.1f} s", gap.from_s, gap.to_s));
    }
    return value;
}

void show_track_info(const TrackInfoOptions& options) {
    if (!options.picture.empty()) { check_can_write(options.picture); }
    const flightpaths::TrackRecording recording = world::load_recording(options.file, options.follow);
    base::JsonValue results;
    results["file"] = options.file;
    results["format"] = recording.format;
    results["heights"] = std::string(flightpaths::text_of(recording.aircraft.front().heights));
    results["begins"] = recording.begin_utc_s ? world::utc_text(*recording.begin_utc_s) : std::string();
    if (recording.origin) {
        results["latitude_deg"] = recording.origin->latitude_deg;
        results["longitude_deg"] = recording.origin->longitude_deg;
    }
    results["aircraft"] = base::JsonValue::list({});
    std::vector<std::string> notes = recording.notes;
    for (std::size_t i = 0; i < recording.aircraft.size(); ++i) {
        const flightpaths::TrackMotion motion = flightpaths::motion_of(recording.aircraft[i]);
        results["aircraft"].push_back(aircraft_value(recording.aircraft[i], i, motion.inference));
        if (i == 0) { notes.insert(notes.end(), motion.notes.begin(), motion.notes.end()); }
    }
    results["notes"] = base::JsonValue::list({});
    for (const std::string& note : notes) { results["notes"].push_back(note); }
    if (!options.picture.empty()) {
        report::write_png(options.picture, report::track_picture(world::track_curves(recording)).view());
        results["picture"] = options.picture;
    }
    base::print_value(results, options.json);
}

Command track_info_command() {
    auto options = std::make_shared<TrackInfoOptions>();
    return {.name = "info",
        .summary = "Shows what a recorded track holds: its aircraft, gaps, what was measured, inferred and left out",
        .options = with_output_options(*options,
            {required(
                 text_option("file", "FILE", "a recorded track of any format that octant fly reads", options->file)),
                text_option("--picture", "OUT.png", "write a picture of the map and the heights", options->picture),
                text_option("--follow", "NAME", "the aircraft that comes first: call sign, id, name or pilot",
                    options->follow)}),
        .footer =
            "Keys: file, format, heights (what they count from), begins (UTC), latitude_deg and longitude_deg of\n"
            "  the first place, aircraft (the followed one first, each with name, id, type, pilot, samples,\n"
            "  begin_s, end_s, lowest_m, highest_m, measured, inferred, not_flown_through, gaps), notes, picture.\n"
            "Example:\n  octant track info flight.csv --picture flight.png",
        .run = [options] { show_track_info(*options); }};
}

} // namespace

Command track_command() {
    return {.name = "track",
        .summary = "Inspects recorded tracks",
        .footer = "Example:\n  octant track info flight.csv --picture flight.png",
        .commands = {track_info_command()}};
}

} // namespace octant::ui::commands
