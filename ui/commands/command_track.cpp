#include "flightpaths/ground_contact.h"
#include "flightpaths/track_motion.h"
#include "flightpaths/track_recording.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "ui/base/json_value.h"
#include "ui/base/progress.h"
#include "ui/commands/commands.h"
#include "ui/report/png_file.h"
#include "ui/report/table.h"
#include "ui/report/track_picture.h"
#include "ui/settings/settings.h"
#include "ui/world/path_loader.h"
#include "ui/world/path_placement.h"
#include "ui/world/scene_ground.h"
#include "ui/world/track_facts.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::commands {

using namespace command_line;

namespace {

struct TrackInfoOptions : base::OutputOptions {
    std::string file;
    std::string follow;
    std::string picture;
    std::string terrain;
};

/// One aircraft of a recording and what was made of it.
struct ShownAircraft {
    std::string name;
    const flightpaths::TrackedAircraft& recorded;
    const flightpaths::TrackInference& inference;
    double lowest_m = 0.0;
    double highest_m = 0.0;
    std::vector<world::TrackGap> gaps;

    ShownAircraft(const world::PlacedFlight& flight, std::size_t index)
        : name(printable(flightpaths::display_name(flight.recording->aircraft[index], index))),
          recorded(flight.recording->aircraft[index]), inference(flight.inferences[index]),
          gaps(world::gaps_of(recorded)) {
        const auto [lowest, highest] = std::ranges::minmax_element(
            recorded.samples, {}, [](const flightpaths::TrackSample& sample) { return sample.position_m.z; });
        lowest_m = lowest->position_m.z;
        highest_m = highest->position_m.z;
    }

    long not_flown_through() const { return inference.rejected + inference.repeated; }
};

std::vector<std::string> gap_texts(const std::vector<world::TrackGap>& gaps) {
    std::vector<std::string> texts;
    for (const world::TrackGap& gap : gaps) {
        texts.push_back(fmt::format("{:.1f} s to {:.1f} s", gap.from_s, gap.to_s));
    }
    return texts;
}

base::JsonValue aircraft_value(const ShownAircraft& shown) {
    base::JsonValue value;
    value["name"] = shown.name;
    value["id"] = shown.recorded.id;
    value["type"] = shown.recorded.type;
    value["pilot"] = shown.recorded.pilot;
    value["samples"] = shown.recorded.samples.size();
    value["begin_s"] = shown.recorded.samples.front().time_s;
    value["end_s"] = shown.recorded.samples.back().time_s;
    value["lowest_m"] = shown.lowest_m;
    value["highest_m"] = shown.highest_m;
    value["measured"] = world::measured_text(shown.recorded);
    value["inferred"] = world::text_of_facts(world::inferred_facts(shown.inference));
    value["not_flown_through"] = shown.not_flown_through();
    value["gaps"] = gap_texts(shown.gaps);
    return value;
}

base::JsonValue contact_value(const flightpaths::GroundContactReport& report) {
    base::JsonValue value;
    value["contacts"] = base::JsonValue::list({});
    for (const flightpaths::GroundContactSpan& span : report.contacts) {
        value["contacts"].push_back({{"from_s", span.from_s}, {"to_s", span.to_s}, {"added_from_m", span.added_from_m},
            {"added_to_m", span.added_to_m}});
    }
    if (report.qnh_take_off_hpa) { value["qnh_take_off_hpa"] = *report.qnh_take_off_hpa; }
    if (report.qnh_landing_hpa) { value["qnh_landing_hpa"] = *report.qnh_landing_hpa; }
    value["lifted_m"] = report.lifted_m;
    return value;
}

report::ResultTable aircraft_table(const world::PlacedFlight& flight) {
    report::ResultTable table;
    for (std::size_t i = 0; i < flight.recording->aircraft.size(); ++i) {
        const ShownAircraft shown(flight, i);
        const auto& samples = shown.recorded.samples;
        table.add({{"aircraft", shown.name}, {"samples", samples.size()}, {"from, s", "{:.1f}", samples.front().time_s},
            {"to, s", "{:.1f}", samples.back().time_s}, {"lowest, m", "{:.0f}", shown.lowest_m},
            {"highest, m", "{:.0f}", shown.highest_m}, {"gaps", shown.gaps.size()},
            {"left out", shown.not_flown_through()}, {"type", printable(shown.recorded.type)}});
    }
    return table;
}

/// What a person sees: the file, a table of its aircraft, the followed one, notes.
void print_for_people(
    base::JsonValue results, const world::PlacedFlight& flight, const std::vector<std::string>& notes) {
    std::fputs(
        (base::text_of_results(results) + "\n" + report::text_of(aircraft_table(flight)) + "\n").c_str(), stdout);
    const ShownAircraft first(flight, 0);
    base::JsonValue facts;
    facts["followed"] = first.name;
    facts["measured"] = world::measured_text(first.recorded);
    world::NamedTexts made = world::inferred_facts(first.inference);
    if (!flight.ground_contacts.empty()) {
        const world::NamedTexts laid = world::contact_facts(flight.ground_contacts.front());
        made.insert(made.end(), laid.begin(), laid.end());
    }
    for (const auto& [name, text] : made) { facts[name] = text; }
    if (!first.gaps.empty()) { facts["gaps"] = fmt::format("{}", fmt::join(gap_texts(first.gaps), ", ")); }
    std::fputs(base::text_of_results(facts).c_str(), stdout);
    for (const std::string& note : notes) { std::fputs(fmt::format("note: {}\n", note).c_str(), stdout); }
}

/// The recording and what is made of it: over a map, laid onto its ground, else by itself.
world::PlacedFlight flight_of(const TrackInfoOptions& options, std::vector<std::string>& notes) {
    settings::RunSettings settings;
    settings.path.name = options.file;
    if (!options.follow.empty()) { settings.path.follow = options.follow; }
    world::LoadedPath loaded = world::load_paths(settings);
    if (!loaded.recording) {
        throw Error(fmt::format("{}: expected a recorded track, got a path file", printable(options.file)));
    }
    if (options.terrain.empty()) {
        notes = loaded.notes;
        return {.trajectory = std::move(loaded.trajectory),
            .title = {},
            .legs = {},
            .name = {},
            .other_trajectories = {},
            .other_names = {},
            .recording = std::move(loaded.recording),
            .inferences = std::move(loaded.inferences),
            .ground_contacts = {}};
    }
    settings.path.terrain = options.terrain;
    settings.path.over_map = true;
    const world::SceneGround ground = world::load_scene_ground(settings, world::RenderDevice::Cpu);
    notes = ground.notes;
    notes.insert(notes.end(), loaded.notes.begin(), loaded.notes.end());
    try {
        return world::place_flight(settings, std::move(loaded), world::placement_ground(ground), notes);
    } catch (const Error& fault) {
        constexpr std::string_view own = "--over-map: "; // which this command does not have
        const std::string_view what = fault.what();
        if (!what.starts_with(own)) { throw; }
        throw Error(fmt::format("--terrain: {}", what.substr(own.size())));
    }
}

void show_track_info(const TrackInfoOptions& options) {
    if (!options.picture.empty()) { check_can_write(options.picture); }
    std::vector<std::string> notes;
    const world::PlacedFlight flight = flight_of(options, notes);
    const flightpaths::TrackRecording& recording = *flight.recording;
    base::JsonValue results;
    results["file"] = options.file;
    results["format"] = recording.format;
    results["heights"] = std::string(flightpaths::text_of(recording.aircraft.front().heights));
    results["begins"] = recording.begin_utc_s ? world::utc_text(*recording.begin_utc_s) : std::string();
    if (recording.origin) {
        results["latitude_deg"] = recording.origin->latitude_deg;
        results["longitude_deg"] = recording.origin->longitude_deg;
    }
    if (!options.picture.empty()) {
        report::write_png(options.picture, report::track_picture(world::track_curves(recording)).view());
        results["picture"] = options.picture;
    }
    if (!options.json) {
        print_for_people(std::move(results), flight, notes);
        return;
    }
    results["aircraft"] = base::JsonValue::list({});
    for (std::size_t i = 0; i < recording.aircraft.size(); ++i) {
        base::JsonValue value = aircraft_value(ShownAircraft(flight, i));
        if (i < flight.ground_contacts.size()) { value["ground"] = contact_value(flight.ground_contacts[i]); }
        results["aircraft"].push_back(std::move(value));
    }
    results["notes"] = base::JsonValue::list({});
    for (const std::string& note : notes) { results["notes"].push_back(note); }
    base::print_value(results, true);
}

Command track_info_command() {
    auto options = std::make_shared<TrackInfoOptions>();
    return {.name = "info",
        .summary = "Shows what a recorded track holds: its aircraft, gaps, what was measured, inferred and left out",
        .options = with_output_options(*options,
            {required(
                 text_option("file", "FILE", "a recorded track of any format that octant fly reads", options->file)),
                text_option("--picture", "OUT.png", "write a picture of the map and the heights", options->picture),
                text_option("--terrain", "MAP",
                    "a map on which it is laid: shows altimeter settings and what is added to heights",
                    options->terrain),
                text_option("--follow", "NAME", "the aircraft that comes first: call sign, id, name or pilot",
                    options->follow)}),
        .footer =
            "Keys: file, format, heights (what they count from), begins (UTC), latitude_deg and longitude_deg of\n"
            "  the first place, aircraft (the followed one first, each with name, id, type, pilot, samples,\n"
            "  begin_s, end_s, lowest_m, highest_m, measured, inferred, not_flown_through, gaps and, over a map, "
            "ground:\n"
            "  contacts with what was added to heights, qnh_take_off_hpa, qnh_landing_hpa, lifted_m), notes, picture.\n"
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
