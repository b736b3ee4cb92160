#include "ui/world/track_facts.h"

#include "sim/base/error.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <utility>

namespace octant::ui::world {

namespace {

using flightpaths::Origin;
using flightpaths::TrackedAircraft;
using flightpaths::TrackSample;

std::string duration_text(double duration_s) {
    const auto whole = std::lround(duration_s);
    return whole >= 3600 ? fmt::format("{} h {:02} min {:02} s", whole / 3600, whole / 60 % 60, whole % 60)
           : whole >= 60 ? fmt::format("{} min {:02} s", whole / 60, whole % 60)
                         : fmt::format("{:.1f} s", duration_s);
}

double way_m(const TrackedAircraft& aircraft) {
    double sum_m = 0.0;
    for (std::size_t i = 1; i < aircraft.samples.size(); ++i) {
        sum_m += glm::distance(aircraft.samples[i - 1].position_m, aircraft.samples[i].position_m);
    }
    return sum_m;
}

std::string aircraft_text(const TrackedAircraft& aircraft) {
    const auto [lowest, highest] = std::ranges::minmax_element(
        aircraft.samples, {}, [](const TrackSample& sample) { return sample.position_m.z; });
    std::string text = fmt::format("{} samples, {} from {:.1f} s on, {:.1f} km", aircraft.samples.size(),
        duration_text(aircraft.samples.back().time_s - aircraft.samples.front().time_s),
        aircraft.samples.front().time_s, way_m(aircraft) / 1000.0);
    if (aircraft.heights != flightpaths::HeightKind::Absent) {
        text += fmt::format(", {:.0f} to {:.0f} m", lowest->position_m.z, highest->position_m.z);
    }
    for (const std::string* word : {&aircraft.id, &aircraft.type, &aircraft.pilot}) {
        if (!word->empty()) { text += ", " + printable(*word); }
    }
    return text;
}

std::string origin_text(Origin origin) {
    return origin == Origin::Measured ? "measured" : origin == Origin::Partly ? "partly measured" : "inferred";
}

} // namespace

std::string utc_text(double since_1970_s) {
    using namespace std::chrono;
    const auto day = floor<days>(sys_seconds(seconds(static_cast<long>(std::floor(since_1970_s)))));
    const year_month_day date(day);
    const auto second = static_cast<long>(std::floor(since_1970_s)) - day.time_since_epoch().count() * 86400;
    return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}:{:02} UTC", static_cast<int>(date.year()),
        static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), second / 3600, second / 60 % 60,
        second % 60);
}

std::vector<TrackGap> gaps_of(const TrackedAircraft& aircraft) {
    std::vector<double> steps_s;
    for (std::size_t i = 1; i < aircraft.samples.size(); ++i) {
        steps_s.push_back(aircraft.samples[i].time_s - aircraft.samples[i - 1].time_s);
    }
    std::vector<double> sorted_s = steps_s;
    const auto usual = sorted_s.begin() + static_cast<std::ptrdiff_t>(sorted_s.size() / 2);
    std::ranges::nth_element(sorted_s, usual);
    constexpr double usual_steps = 5.0;
    std::vector<TrackGap> gaps;
    for (std::size_t i = 0; i < steps_s.size(); ++i) {
        if (steps_s[i] > std::max(track_gap_s, usual_steps * *usual)) {
            gaps.push_back({aircraft.samples[i].time_s, aircraft.samples[i + 1].time_s});
        }
    }
    return gaps;
}

std::vector<report::TrackCurve> track_curves(const flightpaths::TrackRecording& recording) {
    std::vector<report::TrackCurve> curves;
    for (const TrackedAircraft& aircraft : recording.aircraft) {
        report::TrackCurve curve;
        curve.name = printable(flightpaths::display_name(aircraft, curves.size()));
        const std::vector<TrackGap> gaps = gaps_of(aircraft);
        auto gap = gaps.begin();
        for (const TrackSample& sample : aircraft.samples) {
            if (gap != gaps.end() && sample.time_s >= gap->from_s) {
                curve.gap_after.push_back(curve.time_s.size());
                ++gap;
            }
            curve.time_s.push_back(sample.time_s);
            curve.east_m.push_back(sample.position_m.x);
            curve.north_m.push_back(sample.position_m.y);
            curve.height_m.push_back(sample.position_m.z);
        }
        curves.push_back(std::move(curve));
    }
    return curves;
}

std::string measured_text(const TrackedAircraft& aircraft) {
    const auto count = [&](auto has) { return std::ranges::count_if(aircraft.samples, has); };
    const auto is_there = [](double value) { return !std::isnan(value); };
    std::vector<std::string> parts{fmt::format("place {}", aircraft.samples.size())};
    const auto add = [&](std::string_view name, long number) {
        if (number > 0) { parts.push_back(fmt::format("{} {}", name, number)); }
    };
    add("height", aircraft.heights == flightpaths::HeightKind::Absent ? 0 : static_cast<long>(aircraft.samples.size()));
    add("velocity", count([&](const TrackSample& s) { return is_there(s.velocity_mps.x + s.velocity_mps.z); }));
    add("ground speed", count([&](const TrackSample& s) { return is_there(s.ground_speed_mps); }));
    add("track", count([&](const TrackSample& s) { return is_there(s.track_rad); }));
    add("climb",
        count([&](const TrackSample& s) { return is_there(s.velocity_mps.z) && !is_there(s.velocity_mps.x); }));
    add("attitude", count([](const TrackSample& s) { return s.body_to_world.w != 0.0 || s.body_to_world.x != 0.0; }));
    add("heading", count([&](const TrackSample& s) { return is_there(s.heading_rad); }));
    add("roll and pitch", count([&](const TrackSample& s) { return is_there(s.roll_rad + s.pitch_rad); }));
    add("true airspeed", count([&](const TrackSample& s) { return is_there(s.true_airspeed_mps); }));
    add("load factor", count([&](const TrackSample& s) { return is_there(s.load_factor); }));
    add("pressure height", count([&](const TrackSample& s) { return is_there(s.pressure_height_m); }));
    add("on the ground or not",
        count([](const TrackSample& s) { return s.contact != flightpaths::GroundContact::Unknown; }));
    return fmt::format("{}", fmt::join(parts, ", "));
}

NamedTexts inferred_facts(const flightpaths::TrackInference& inference) {
    NamedTexts facts{{"velocity", origin_text(inference.velocity)}, {"heading", origin_text(inference.heading)},
        {"pitch and roll", origin_text(inference.pitch_roll)}};
    if (inference.horizontal_error_m > 0.0) {
        facts.emplace_back("errors found",
            fmt::format("places {:.1f} m, heights {:.1f} m{}", inference.horizontal_error_m, inference.vertical_error_m,
                inference.height_step_m > 0.0 ? fmt::format(" in steps of {:.2f} m", inference.height_step_m) : ""));
    }
    if (inference.hovers) { facts.emplace_back("flown as", "one that hovers"); }
    std::vector<std::string> phases;
    for (const flightpaths::PhaseSpan& span : inference.phases) {
        constexpr std::size_t most = 12;
        if (phases.size() == most) {
            phases.push_back(fmt::format("{} more", inference.phases.size() - most));
            break;
        }
        phases.push_back(fmt::format("{} from {:.0f} s", flightpaths::name_of(span.phase), span.from_s));
    }
    if (!phases.empty()) { facts.emplace_back("phases", fmt::format("{}", fmt::join(phases, ", "))); }
    if (!inference.winds.empty()) {
        glm::dvec2 sum_mps(0.0);
        for (const auto& wind : inference.winds) { sum_mps += wind.wind_mps; }
        const glm::dvec2 mean_mps = sum_mps / static_cast<double>(inference.winds.size());
        const double from_deg = deg_from_rad(std::atan2(-mean_mps.x, -mean_mps.y));
        facts.emplace_back(
            "wind", fmt::format("{:.1f} m/s from {:03.0f} degrees in the mean of {} stretches", glm::length(mean_mps),
                        from_deg < 0.0 ? from_deg + 360.0 : from_deg, inference.winds.size()));
    }
    return facts;
}

NamedTexts contact_facts(const flightpaths::GroundContactReport& report) {
    NamedTexts facts;
    std::vector<std::string> contacts;
    for (const flightpaths::GroundContactSpan& span : report.contacts) {
        constexpr std::size_t most = 12;
        if (contacts.size() == most) {
            contacts.push_back(fmt::format("{} more", report.contacts.size() - most));
            break;
        }
        contacts.push_back(fmt::format("{:.0f} s to {:.0f} s, heights changed by {:+.1f} to {:+.1f} m", span.from_s,
            span.to_s, span.added_from_m, span.added_to_m));
    }
    if (!contacts.empty()) { facts.emplace_back("on the ground", fmt::format("{}", fmt::join(contacts, "; "))); }
    const auto add_setting = [&](const char* name, const std::optional<double>& qnh_hpa) {
        if (qnh_hpa) { facts.emplace_back(name, fmt::format("{:.1f} hPa", *qnh_hpa)); }
    };
    add_setting("altimeter setting at take-off", report.qnh_take_off_hpa);
    add_setting("altimeter setting at landing", report.qnh_landing_hpa);
    if (report.lifted_m > 0.0) {
        facts.emplace_back("lifted over the ground", fmt::format("{:.1f} m", report.lifted_m));
    }
    return facts;
}

std::string text_of_facts(const NamedTexts& facts) {
    std::vector<std::string> parts;
    for (const auto& [name, text] : facts) { parts.push_back(fmt::format("{} {}", name, text)); }
    return fmt::format("{}", fmt::join(parts, "; "));
}

NamedTexts track_facts(const flightpaths::TrackRecording& recording,
    std::span<const flightpaths::TrackInference> inferences,
    std::span<const flightpaths::GroundContactReport> contacts) {
    NamedTexts facts{{"recorded track", recording.format},
        {"track begins",
            recording.begin_utc_s ? utc_text(*recording.begin_utc_s) : "at a time that the file does not tell"},
        {"track heights", std::string(flightpaths::text_of(recording.aircraft.front().heights))}};
    constexpr std::size_t most_told = 40;
    for (std::size_t i = 0; i < std::min(most_told, recording.aircraft.size()); ++i) {
        const TrackedAircraft& aircraft = recording.aircraft[i];
        const std::string name = fmt::format("track {}: {}", i + 1, printable(flightpaths::display_name(aircraft, i)));
        std::string text = aircraft_text(aircraft) + "; measured: " + measured_text(aircraft);
        if (i < inferences.size()) {
            text += "; " + text_of_facts(inferred_facts(inferences[i]));
            const auto left = inferences[i].rejected + inferences[i].repeated;
            if (left > 0) { text += fmt::format("; {} samples not flown through", left); }
        }
        if (i < contacts.size()) {
            const NamedTexts laid = contact_facts(contacts[i]);
            if (!laid.empty()) { text += "; " + text_of_facts(laid); }
        }
        for (const TrackGap& gap : gaps_of(aircraft)) {
            text += fmt::format("; gap of {} at {:.0f} s", duration_text(gap.to_s - gap.from_s), gap.from_s);
        }
        facts.emplace_back(name, std::move(text));
    }
    if (recording.aircraft.size() > most_told) {
        facts.emplace_back("track", fmt::format("{} more aircraft", recording.aircraft.size() - most_told));
    }
    return facts;
}

} // namespace octant::ui::world
