#include "flightpaths/fix_table.h"

#include "flightpaths/log_columns.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>

namespace octant::flightpaths {

namespace {

constexpr double seconds_a_day = 86400.0;
constexpr double max_flight_s = 31.0 * 86400.0;
constexpr double max_speed_mps = 3000.0;
constexpr double max_height_m = 1e7;
/// How far the followed aircraft may go, and how far away the others may be.
constexpr double max_distance_m = 1e7;
constexpr double max_distance_of_others_m = 1e6;
constexpr std::size_t max_series = 100000;
constexpr std::size_t max_fixes = 8000000;

/// Metres between two places, nearly.
double distance_between_m(const Fix& a, const Fix& b) {
    const double north_m = rad_from_deg(b.latitude_deg - a.latitude_deg) * wgs84.semi_major_m;
    const double between_deg = std::remainder(b.longitude_deg - a.longitude_deg, 360.0);
    const double middle_rad = rad_from_deg(0.5 * (a.latitude_deg + b.latitude_deg));
    const double east_m = rad_from_deg(between_deg) * wgs84.semi_major_m * std::cos(middle_rad);
    const double up_m = std::isnan(a.altitude_m) || std::isnan(b.altitude_m) ? 0.0 : b.altitude_m - a.altitude_m;
    return std::hypot(north_m, east_m, up_m);
}

double speed_between_mps(const Fix& a, const Fix& b) { return distance_between_m(a, b) / (b.time_s - a.time_s); }

double span_s(const FixSeries& flight) { return flight.fixes.back().time_s - flight.fixes.front().time_s; }

std::vector<std::string> names_of(const FixSeries& flight) {
    return {flight.call_sign, flight.name, flight.id, flight.pilot};
}

/// An hour without a fix ends a flight, unless the aircraft flew on: then it went at least half as fast as around it.
bool begins_flight(const std::vector<Fix>& fixes, std::size_t at) {
    constexpr double longest_gap_s = 3600.0;
    if (!(fixes[at].time_s - fixes[at - 1].time_s > longest_gap_s)) { return false; }
    const double across_mps = speed_between_mps(fixes[at - 1], fixes[at]);
    const double before_mps = at >= 2 ? speed_between_mps(fixes[at - 2], fixes[at - 1]) : 0.0;
    const double after_mps = at + 1 < fixes.size() ? speed_between_mps(fixes[at], fixes[at + 1]) : 0.0;
    constexpr double flying_mps = 20.0;
    return across_mps < std::max(flying_mps, 0.5 * std::min(before_mps, after_mps));
}

/// Whether a flight leaves the surroundings of its first place.
bool moves(const FixSeries& flight) {
    constexpr double far_m = 300.0;
    return std::ranges::any_of(
        flight.fixes, [&](const Fix& fix) { return distance_between_m(flight.fixes.front(), fix) > far_m; });
}

/// The followed flight by itself: the one of the recording's pilot, else the longest of those that go somewhere. Of
/// more aircraft than are kept it is one with many others near it.
std::size_t default_index(const std::vector<FixSeries>& flights) {
    const std::size_t apart = std::max<std::size_t>(1, flights.size() / max_recorded_aircraft);
    const auto near = [&](const FixSeries& flight) {
        long count = 0;
        for (std::size_t i = 0; i < flights.size() && apart > 1; i += apart) {
            count += distance_between_m(flight.fixes.front(), flights[i].fixes.front()) < max_distance_of_others_m;
        }
        return count;
    };
    std::vector<std::tuple<double, long, bool, double>> ranks;
    for (const FixSeries& flight : flights) {
        ranks.emplace_back(flight.importance, near(flight), moves(flight), span_s(flight));
    }
    return static_cast<std::size_t>(std::ranges::max_element(ranks) - ranks.begin());
}

} // namespace

std::size_t followed_index(const std::vector<std::vector<std::string>>& names, const std::string& follow) {
    const std::string wanted = in_small_letters(follow);
    std::vector<std::size_t> parts;
    for (std::size_t i = 0; i < names.size(); ++i) {
        bool is_part = false;
        for (const std::string& name : names[i]) {
            const std::string small = in_small_letters(name);
            if (small == wanted) { return i; }
            is_part = is_part || small.find(wanted) != small.npos;
        }
        if (is_part) { parts.push_back(i); }
    }
    if (parts.size() == 1) { return parts.front(); }
    constexpr std::size_t most_named = 8;
    std::vector<std::string> known;
    for (const auto& of_one : names) {
        const auto name = std::ranges::find_if(of_one, [](const std::string& text) { return !text.empty(); });
        if (name != of_one.end() && known.size() < most_named) { known.push_back(printable(*name)); }
    }
    throw Error(fmt::format("--follow: expected one of the {} aircraft ({}{}), got {}{}", names.size(),
        fmt::join(known, ", "), names.size() > most_named ? ", ..." : "", in_quotes(follow),
        parts.empty() ? "" : fmt::format(", a part of {} names", parts.size())));
}

FixSeries& FixTable::series(std::string_view id) {
    const auto found = index_.find(id);
    if (found != index_.end()) { return series_[found->second]; }
    if (series_.size() == max_series) {
        throw_error_in(file_, fmt::format("expected at most {} aircraft, got more", max_series));
    }
    index_.emplace(id, series_.size());
    FixSeries& added = series_.emplace_back();
    added.id = id;
    return added;
}

void FixTable::add(FixSeries& series, const Fix& fix) {
    const auto refuse = [&](const std::string& what) {
        if (fix.line > 0) { throw_error_at(file_, fix.line, what); }
        throw_error_in(file_, what);
    };
    if (!(std::abs(fix.latitude_deg) <= 90.0 && std::abs(fix.longitude_deg) <= 360.0)) {
        refuse(fmt::format("expected a latitude within 90 deg and a longitude within 360 deg, got {} and {}",
            fix.latitude_deg, fix.longitude_deg));
    }
    if (std::abs(fix.altitude_m) > max_height_m) {
        refuse(fmt::format(
            "expected a height within {:.0f} km, got {:.0f} km", max_height_m / 1000.0, fix.altitude_m / 1000.0));
    }
    if (count_ == max_fixes) { refuse(fmt::format("expected at most {} places, got more", max_fixes)); }
    ++count_;
    series.fixes.push_back(fix);
}

void FixTable::join_in_sequence() {
    std::erase_if(series_, [](const FixSeries& series) { return series.fixes.empty(); });
    for (std::size_t i = 1; i < series_.size(); ++i) {
        if (series_[i].fixes.front().time_s < series_[i - 1].fixes.back().time_s) { return; }
    }
    for (std::size_t i = 1; i < series_.size(); ++i) {
        series_.front().fixes.insert(series_.front().fixes.end(), series_[i].fixes.begin(), series_[i].fixes.end());
    }
    if (!series_.empty()) {
        series_.resize(1);
        series_.front().id.clear();
    }
}

namespace {

/// The speed at which a line of places can be flown: a tenth of its way has sharper bends.
double speed_of_line_mps(const std::vector<Fix>& line) {
    constexpr double slowest_mps = 10.0;
    constexpr double fastest_mps = 60.0;
    std::vector<std::pair<double, double>> bends; // speed and way
    double way_m = 0.0;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
        const auto course_rad = [&](const Fix& from, const Fix& to) {
            const double east = std::remainder(to.longitude_deg - from.longitude_deg, 360.0) *
                                std::cos(rad_from_deg(from.latitude_deg));
            return std::atan2(east, to.latitude_deg - from.latitude_deg);
        };
        const double turn_rad =
            std::abs(wrapped_to_pi(course_rad(line[i], line[i + 1]) - course_rad(line[i - 1], line[i])));
        const double leg_m =
            0.5 * (distance_between_m(line[i - 1], line[i]) + distance_between_m(line[i], line[i + 1]));
        bends.emplace_back(std::sqrt(gravity_mps2 * leg_m / std::max(turn_rad, 1e-6)), leg_m);
        way_m += leg_m;
    }
    std::ranges::sort(bends);
    double sum_m = 0.0;
    for (const auto& [speed_mps, leg_m] : bends) {
        sum_m += leg_m;
        if (sum_m >= 0.1 * way_m) { return std::clamp(speed_mps, slowest_mps, fastest_mps); }
    }
    return fastest_mps;
}

} // namespace

void FixTable::space_out() {
    time_scale = TimeScale::Own;
    double slowest_mps = std::numeric_limits<double>::infinity();
    for (FixSeries& series : series_) {
        std::vector<Fix> line;
        for (const Fix& fix : series.fixes) {
            if (line.empty() || distance_between_m(line.back(), fix) > 0.0) { line.push_back(fix); }
        }
        const double speed_mps = speed_of_line_mps(line);
        slowest_mps = std::min(slowest_mps, speed_mps);
        for (std::size_t i = 0; i < line.size(); ++i) {
            line[i].time_s = i == 0 ? 0.0 : line[i - 1].time_s + distance_between_m(line[i - 1], line[i]) / speed_mps;
        }
        series.fixes = std::move(line);
    }
    if (series_.empty()) { return; }
    notes_.push_back(fmt::format("the line has no times: flown at {:.0f} m/s, which its bends allow", slowest_mps));
}

void FixTable::keep_longest() {
    std::erase_if(series_, [](const FixSeries& series) { return series.fixes.empty(); });
    if (series_.size() < 2) { return; }
    const auto longest = std::ranges::max_element(series_, {}, span_s);
    notes_.push_back(fmt::format("left out {} lines shorter than the one that is flown", series_.size() - 1));
    std::rotate(series_.begin(), longest, longest + 1);
    series_.resize(1);
    series_.front().id.clear();
}

/// Makes times of day and leap seconds increase.
void FixTable::resolve_times(std::vector<Fix>& fixes) const {
    if (time_scale == TimeScale::TimeOfDay) {
        double days_s = 0.0;
        for (std::size_t i = 0; i < fixes.size(); ++i) {
            fixes[i].time_s += days_s;
            // A clock that goes back by minutes is a mistake of the recorder; by half a day, it is midnight.
            if (i > 0 && fixes[i].time_s < fixes[i - 1].time_s - 0.5 * seconds_a_day) {
                days_s += seconds_a_day;
                fixes[i].time_s += seconds_a_day;
            }
        }
    }
    const auto leap = std::ranges::find_if(fixes, &Fix::is_leap_second);
    if (leap == fixes.end()) { return; }
    const double midnight_s = std::floor(leap->time_s);
    for (Fix& fix : fixes) {
        if (!fix.is_leap_second && fix.time_s >= midnight_s) { fix.time_s += 1.0; }
    }
}

std::vector<Fix> FixTable::without_jumps(const std::vector<Fix>& fixes, std::size_t first, long& jumps) const {
    std::vector<Fix> kept;
    jumps = static_cast<long>(first);
    for (std::size_t i = first; i < fixes.size(); ++i) {
        if (!kept.empty() && !(speed_between_mps(kept.back(), fixes[i]) <= max_speed_mps)) {
            ++jumps;
        } else {
            kept.push_back(fixes[i]);
        }
    }
    return kept;
}

void FixTable::put_in_order(std::vector<Fix>& fixes) {
    resolve_times(fixes);
    std::vector<Fix> later;
    if (sorts) { std::ranges::stable_sort(fixes, {}, &Fix::time_s); }
    for (const Fix& fix : fixes) {
        if (later.empty() || fix.time_s > later.back().time_s) {
            later.push_back(fix);
        } else if (sorts) {
            later.back() = fix;
        } else {
            ++left_out_.not_later;
        }
    }
    // Where the first fix is the wrong one, all others are jumps.
    constexpr std::size_t tried = 16;
    long jumps = 0;
    fixes = without_jumps(later, 0, jumps);
    for (std::size_t first = 1; first < std::min(tried, later.size()) && 2 * fixes.size() < later.size(); ++first) {
        long other_jumps = 0;
        std::vector<Fix> other = without_jumps(later, first, other_jumps);
        if (other.size() > fixes.size()) {
            fixes = std::move(other);
            jumps = other_jumps;
        }
    }
    left_out_.jumps += jumps;
}

std::vector<FixTable::Flight> FixTable::flights() {
    std::vector<Flight> flights;
    for (FixSeries& series : series_) {
        put_in_order(series.fixes);
        std::size_t begin = 0;
        int number = 0;
        for (std::size_t i = 1; i <= series.fixes.size(); ++i) {
            if (i < series.fixes.size() && !(splits && begins_flight(series.fixes, i))) { continue; }
            if (i - begin < 2) {
                ++left_out_.single;
            } else {
                Flight flight{series.id, series.call_sign, series.name, series.type, series.pilot,
                    {series.fixes.begin() + static_cast<std::ptrdiff_t>(begin),
                        series.fixes.begin() + static_cast<std::ptrdiff_t>(i)},
                    series.importance};
                if (++number > 1) { flight.id += fmt::format("#{}", number); }
                const Fix& last = flight.fixes.back();
                if (!(span_s(flight) <= max_flight_s)) {
                    throw_error_at(file_, last.line,
                        fmt::format("expected a time within {:.0f} days of the first, got {:.3f} s",
                            max_flight_s / seconds_a_day, span_s(flight)));
                }
                flights.push_back(std::move(flight));
            }
            begin = i;
        }
        if (number > 1) {
            notes_.push_back(fmt::format("{} stood for more than an hour: {} flights, followed by --follow {}#2 ...",
                series.id.empty() ? "the aircraft" : printable(series.id), number, printable(series.id)));
        }
        series.fixes = {};
    }
    return flights;
}

/// Where nearly every row has an id of its own, ids count rows: all fixes are those of one aircraft.
void FixTable::merge_numbered_rows() {
    constexpr std::size_t few = 3;
    if (series_.size() <= few || count_ > series_.size() + series_.size() / 2) { return; }
    FixSeries all;
    for (const FixSeries& series : series_) {
        all.fixes.insert(all.fixes.end(), series.fixes.begin(), series.fixes.end());
    }
    std::ranges::stable_sort(all.fixes, {}, &Fix::line);
    series_ = {std::move(all)};
}

/// Aircraft on the ground that report no height have the last or else the next one of theirs.
void FixTable::fill_ground_heights() {
    long filled = 0;
    for (FixSeries& series : series_) {
        double last_m = not_measured;
        const auto fill = [&](Fix& fix) {
            if (!std::isnan(fix.altitude_m)) {
                last_m = fix.altitude_m;
            } else if (fix.contact == GroundContact::OnGround && !std::isnan(last_m)) {
                fix.altitude_m = last_m;
                ++filled;
            }
        };
        std::for_each(series.fixes.begin(), series.fixes.end(), fill);
        last_m = not_measured;
        std::for_each(series.fixes.rbegin(), series.fixes.rend(), fill);
    }
    if (filled > 0) {
        notes_.push_back(
            fmt::format("{} places on the ground without a height have the aircraft's nearest one", filled));
    }
}

/// Takes pressure heights where few fixes have another one, and leaves out fixes without a height, unless none has one.
void FixTable::choose_heights() {
    long with_height = 0;
    long with_pressure = 0;
    long all = 0;
    for (const FixSeries& series : series_) {
        for (const Fix& fix : series.fixes) {
            with_height += std::isnan(fix.altitude_m) ? 0 : 1;
            with_pressure += std::isnan(fix.pressure_height_m) ? 0 : 1;
            ++all;
        }
    }
    if (2 * std::max(with_height, with_pressure) < all) {
        heights = HeightKind::Absent;
        notes_.push_back(fmt::format("{}: flown {:.0f} m above the ground",
            with_height == 0 ? "the file has no heights"
                             : fmt::format("only {} of {} places have a height", with_height, all),
            assumed_height_m));
        return;
    }
    const bool by_pressure = with_pressure > with_height && 2 * with_height < all;
    if (by_pressure) {
        heights = HeightKind::Pressure;
        notes_.emplace_back("heights are pressure heights: few fixes have another one");
    }
    fill_ground_heights();
    for (FixSeries& series : series_) {
        const auto left = std::erase_if(series.fixes, [&](Fix& fix) {
            if (by_pressure) {
                fix.altitude_m = static_cast<double>(fix.pressure_height_m);
                fix.pressure_height_m = static_cast<float>(not_measured);
            }
            return std::isnan(fix.altitude_m);
        });
        without_place_ += static_cast<long>(left);
        count_ -= left;
    }
}

/// Ground speeds without a unit: knots, km/h, miles an hour or m/s, whichever fits the way; otherwise they are dropped.
void FixTable::find_speed_unit(std::vector<Flight>& flights) {
    if (ground_speeds_have_unit) { return; }
    std::vector<double> ratios;
    for (const Flight& flight : flights) {
        for (std::size_t i = 1; i < flight.fixes.size(); ++i) {
            const double stated = 0.5 * (static_cast<double>(flight.fixes[i].ground_speed_mps) +
                                            static_cast<double>(flight.fixes[i - 1].ground_speed_mps));
            const double flown_mps = speed_between_mps(flight.fixes[i - 1], flight.fixes[i]);
            constexpr double fast = 10.0;
            if (stated > fast && flown_mps > fast) { ratios.push_back(flown_mps / stated); }
        }
    }
    double factor = not_measured;
    if (!ratios.empty()) {
        const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
        std::ranges::nth_element(ratios, middle);
        constexpr double off = 0.08;
        for (const double unit_mps : {1.0, mps_from_kt(1.0), 1.0 / 3.6, 0.44704}) {
            if (std::abs(*middle / unit_mps - 1.0) < off) { factor = unit_mps; }
        }
    }
    for (Flight& flight : flights) {
        for (Fix& fix : flight.fixes) {
            fix.ground_speed_mps = static_cast<float>(factor * static_cast<double>(fix.ground_speed_mps));
        }
    }
}

namespace {

/// How the way over the ground differs from the headings of a fast aircraft: the declination, and drift.
struct HeadingComparison {
    std::vector<double> off_deg;
    /// Of the ways: 0 where they lead to all sides, 1 where all lead the same way.
    double one_sidedness = 0.0;

    double quantile_deg(double share) {
        const auto at = off_deg.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(off_deg.size() - 1));
        std::ranges::nth_element(off_deg, at);
        return *at;
    }
};

HeadingComparison compare_headings(const std::vector<FixSeries>& flights) {
    constexpr double fast_mps = 15.0;
    constexpr double largest_drift_deg = 45.0;
    HeadingComparison comparison;
    glm::dvec2 directions(0.0);
    for (const FixSeries& flight : flights) {
        for (std::size_t i = 1; i < flight.fixes.size(); ++i) {
            const Fix& a = flight.fixes[i - 1];
            const Fix& b = flight.fixes[i];
            if (std::isnan(b.heading_deg) || !(speed_between_mps(a, b) >= fast_mps)) { continue; }
            const double east =
                std::remainder(b.longitude_deg - a.longitude_deg, 360.0) * std::cos(rad_from_deg(b.latitude_deg));
            const double way_rad = std::atan2(east, b.latitude_deg - a.latitude_deg);
            const double off_deg = std::remainder(deg_from_rad(way_rad) - b.heading_deg, 360.0);
            if (std::abs(off_deg) > largest_drift_deg) { continue; }
            comparison.off_deg.push_back(off_deg);
            directions += glm::dvec2(std::sin(way_rad), std::cos(way_rad));
        }
    }
    if (!comparison.off_deg.empty()) {
        comparison.one_sidedness = glm::length(directions) / static_cast<double>(comparison.off_deg.size());
    }
    return comparison;
}

/// Whether headings of an unknown kind are magnetic: they differ from the way by the same angle to all sides. Wind from
/// one side looks alike where all ways lead the same way.
bool are_magnetic(HeadingComparison& comparison) {
    constexpr double surely_magnetic_deg = 3.0;
    constexpr double widest_spread_deg = 12.0;
    constexpr double most_one_sided = 0.7;
    return std::abs(comparison.quantile_deg(0.5)) >= surely_magnetic_deg &&
           comparison.quantile_deg(0.75) - comparison.quantile_deg(0.25) <= widest_spread_deg &&
           comparison.one_sidedness <= most_one_sided;
}

} // namespace

void FixTable::convert_headings(std::vector<Flight>& flights) {
    if (headings == HeadingKind::True) { return; }
    HeadingComparison comparison = compare_headings(flights);
    constexpr std::size_t fewest = 10;
    if (comparison.off_deg.size() < fewest) {
        if (headings == HeadingKind::Magnetic) {
            notes_.emplace_back("headings are magnetic and too few to find the declination: taken from the motion");
            for (Flight& flight : flights) {
                for (Fix& fix : flight.fixes) { fix.heading_deg = not_measured; }
            }
        }
        return;
    }
    if (headings == HeadingKind::Unknown && !are_magnetic(comparison)) { return; }
    const double declination_deg = comparison.quantile_deg(0.5);
    for (Flight& flight : flights) {
        for (Fix& fix : flight.fixes) { fix.heading_deg += declination_deg; }
    }
    notes_.push_back(fmt::format("headings are magnetic: turned by {:.1f} degrees {}, by which the way over the ground "
                                 "differs from them",
        std::abs(declination_deg), declination_deg < 0.0 ? "west" : "east"));
}

std::optional<TrackedAircraft> FixTable::tracked(Flight flight, const EarthFrame& frame, double begin_s) {
    TrackedAircraft aircraft{std::move(flight.id), std::move(flight.call_sign), std::move(flight.name),
        std::move(flight.type), std::move(flight.pilot), {}, heights};
    aircraft.samples.reserve(flight.fixes.size());
    for (const Fix& fix : flight.fixes) {
        const FramePosition local = frame.place_of({fix.latitude_deg, fix.longitude_deg});
        const double turn_rad = local.north_bearing_rad;
        TrackSample sample;
        sample.time_s = fix.time_s - begin_s;
        sample.position_m = {local.east_north_m, heights == HeightKind::Absent ? assumed_height_m : fix.altitude_m};
        if (!(glm::length(sample.position_m) <= max_distance_m)) { return std::nullopt; }
        sample.velocity_mps = {rotated_clockwise({fix.east_mps, fix.north_mps}, turn_rad), fix.up_mps};
        sample.ground_speed_mps = fix.ground_speed_mps;
        sample.track_rad = rad_from_deg(fix.track_deg) + turn_rad;
        sample.heading_rad = rad_from_deg(fix.heading_deg) + turn_rad;
        sample.pitch_rad = rad_from_deg(fix.pitch_deg);
        sample.roll_rad = rad_from_deg(fix.roll_deg);
        sample.load_factor = fix.load_factor;
        sample.true_airspeed_mps = fix.true_airspeed_mps;
        sample.horizontal_error_m = fix.horizontal_error_m;
        sample.vertical_error_m = fix.vertical_error_m;
        sample.pressure_height_m = fix.pressure_height_m;
        sample.contact = fix.contact;
        aircraft.samples.push_back(sample);
    }
    return aircraft;
}

std::string FixTable::left_out_text(std::string_view before) const {
    if (without_place_ + left_out_.not_later + left_out_.jumps == 0) { return {}; }
    return fmt::format("{}left out of the log: {} without time, place or height, {} of a moment that had been, "
                       "{} that only a jump leads to",
        before, without_place_, left_out_.not_later, left_out_.jumps);
}

void FixTable::tell_left_out(std::vector<std::string>& notes) const {
    if (std::string text = left_out_text(""); !text.empty()) { notes.push_back(std::move(text)); }
    const auto tell = [&](long count, std::string_view what) {
        if (count > 0) { notes.push_back(fmt::format("left out {} {}", count, what)); }
    };
    tell(left_out_.single, "aircraft that are seen at one time alone");
    tell(left_out_.far, "aircraft more than 1,000 km away");
    tell(left_out_.many, fmt::format("aircraft beyond {}", max_recorded_aircraft));
}

TrackRecording FixTable::recording(const std::string& follow) && {
    merge_numbered_rows();
    choose_heights();
    std::vector<Flight> all = flights();
    if (all.empty()) {
        const std::size_t left = count_ - static_cast<std::size_t>(left_out_.not_later + left_out_.jumps);
        throw_error_in(
            file_, fmt::format("expected at least 2 samples with a place, got {}{}", left, left_out_text("; ")));
    }
    convert_headings(all);
    find_speed_unit(all);
    std::vector<std::vector<std::string>> names;
    std::ranges::transform(all, std::back_inserter(names), names_of);
    const std::size_t first = follow.empty() ? default_index(all) : followed_index(names, follow);
    std::rotate(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(first),
        all.begin() + static_cast<std::ptrdiff_t>(first) + 1);
    double begin_s = all.front().fixes.front().time_s;
    for (const Flight& flight : all) { begin_s = std::min(begin_s, flight.fixes.front().time_s); }
    const Fix origin = all.front().fixes.front();
    TrackRecording recording;
    recording.format = std::move(format_);
    recording.origin = GeoPosition{origin.latitude_deg, origin.longitude_deg};
    if (time_scale == TimeScale::Utc) {
        recording.begin_utc_s = begin_s;
    } else if (const auto& zero_s = time_scale == TimeScale::Own ? begin_utc_s : first_day_s) {
        recording.begin_utc_s = *zero_s + begin_s;
    }
    const TransverseMercator frame(*recording.origin);
    for (Flight& flight : all) {
        const bool is_near = recording.aircraft.empty() || std::ranges::any_of(flight.fixes, [&](const Fix& fix) {
            return distance_between_m(origin, fix) <= max_distance_of_others_m;
        });
        const int line = flight.fixes.front().line;
        if (!is_near || recording.aircraft.size() == max_recorded_aircraft) {
            ++(is_near ? left_out_.many : left_out_.far);
            continue;
        }
        auto aircraft = tracked(std::move(flight), frame, begin_s);
        if (aircraft) {
            recording.aircraft.push_back(std::move(*aircraft));
        } else if (recording.aircraft.empty()) {
            throw_error_at(
                file_, line, fmt::format("expected a place within {:.0f} km of the first", max_distance_m / 1000.0));
        } else {
            ++left_out_.far;
        }
    }
    tell_left_out(notes_);
    recording.notes = std::move(notes_);
    return recording;
}

} // namespace octant::flightpaths
