#include "flightpaths/logged_track.h"

#include "flightpaths/derived_motion.h"
#include "flightpaths/track_fields.h"
#include "flightpaths/track_limits.h"
#include "flightpaths/track_time.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/transverse_mercator.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <utility>
#include <vector>

namespace octant::flightpaths {

namespace {

/// Angles in degrees; a heading only where the log has one.
struct LoggedAngles {
    double roll = 0.0;
    double pitch = 0.0;
    std::optional<double> heading;
};

struct LeftOut {
    int without_place = 0;
    int not_later = 0;
    int jumps = 0;
};

/// How much was left out, behind `before`; empty when nothing was.
std::string said_of(const LeftOut& left_out, std::string_view before = "") {
    if (left_out.without_place + left_out.not_later + left_out.jumps == 0) {
        return {};
    }
    return fmt::format(
        "{}left out of the log: {} without time, place or height, {} of a moment that had been, "
        "{} that only a jump leads to",
        before,
        left_out.without_place,
        left_out.not_later,
        left_out.jumps);
}

/// Reads the lines one by one and keeps those that fit.
class LogReader {
public:
    LogReader(const LogText& log, const LogColumns& columns)
        : log_(log)
        , columns_(columns) {}

    void read_line(std::size_t index) {
        line_ = log_.numbers.empty() ? static_cast<int>(index) + 1 : log_.numbers[index];
        fields_ = unquoted_fields(log_.lines[index], log_.separator);
        const auto time_s = time();
        const auto place = this->place();
        const auto altitude_m = value(LogQuantity::Altitude);
        if (!time_s || !place || !altitude_m) {
            ++left_out_.without_place;
            return;
        }
        if (!frame_) {
            frame_.emplace(*place);
        }
        const FramePosition local = frame_->place_of(*place);
        sim::AircraftState state;
        state.time_s = *time_s;
        state.position_m = {local.east_north_m, *altitude_m};
        if (!(glm::length(state.position_m) <= max_track_distance_m)) {
            throw_error_at(
                log_.file,
                line_,
                fmt::format(
                    "expected a place within {:.0f} km of the first", max_track_distance_m / 1000.0));
        }
        if (!is_next(state)) {
            return;
        }
        take_velocity(state, local.north_bearing_rad);
        take_angles(deg_from_rad(local.north_bearing_rad));
        samples_.push_back(state);
    }

    LoggedTrack track() && {
        if (samples_.size() < 2) {
            throw_error_in(
                log_.file,
                fmt::format(
                    "expected at least 2 samples with a place, got {}{}",
                    samples_.size(),
                    said_of(left_out_, "; ")));
        }
        if (!has_velocities_) {
            fill_velocities(samples_);
        }
        fill_attitudes(samples_);
        if (angles_.size() == samples_.size()) {
            take_logged_angles();
        }
        fill_load_factors(samples_);
        return {std::move(samples_), frame_->origin(), notes()};
    }

private:
    /// What a field holds; empty for none, and for what programs write where nothing is known.
    std::string_view field(LogQuantity what) const {
        const auto& column = columns_[what];
        if (!column || column->field >= fields_.size()) {
            return {};
        }
        const std::string_view text = fields_[column->field];
        const bool nothing =
            text == "nan" || text == "NaN" || text == "null" || text == "None" || text == "-";
        return nothing ? std::string_view() : text;
    }

    std::optional<double> number(std::string_view text, LogQuantity what) const {
        if (text.empty()) {
            return std::nullopt;
        }
        const auto value = finite_number(text);
        if (!value) {
            throw_error_at(
                log_.file,
                line_,
                fmt::format(
                    "expected a finite number in column {}, got \"{}\"",
                    printable(columns_[what]->name),
                    printable(std::string(text))));
        }
        return value;
    }

    std::optional<double> value(LogQuantity what) const {
        const auto found = number(field(what), what);
        return found ? std::optional(*found * columns_[what]->factor) : std::nullopt;
    }

    std::optional<GeoPosition> place() const {
        std::optional<double> latitude_deg;
        std::optional<double> longitude_deg;
        if (columns_[LogQuantity::Position]) {
            const auto parts = split_fields(field(LogQuantity::Position), ',');
            latitude_deg = number(parts.front(), LogQuantity::Position);
            longitude_deg =
                parts.size() == 2 ? number(parts.back(), LogQuantity::Position) : std::nullopt;
        } else {
            latitude_deg = value(LogQuantity::Latitude);
            longitude_deg = value(LogQuantity::Longitude);
        }
        // Receivers without a fix write zeros.
        if (!latitude_deg || !longitude_deg || (*latitude_deg == 0.0 && *longitude_deg == 0.0)) {
            return std::nullopt;
        }
        if (std::abs(*latitude_deg) > 90.0 || std::abs(*longitude_deg) > 360.0) {
            throw_error_at(
                log_.file,
                line_,
                fmt::format(
                    "expected a latitude within 90 deg and a longitude within 360 deg, got {} and "
                    "{}",
                    *latitude_deg,
                    *longitude_deg));
        }
        return GeoPosition{*latitude_deg, *longitude_deg};
    }

    /// Seconds since the first line that has a time.
    std::optional<double> time() {
        const std::string_view text = field(LogQuantity::Time);
        if (text.empty()) {
            return std::nullopt;
        }
        const auto read = log_time(text);
        if (!read) {
            throw_error_at(
                log_.file,
                line_,
                fmt::format(
                    "expected a time such as 12.5, 07:41:03 or 2024-01-02T07:41:03Z in column {}, "
                    "got \"{}\"",
                    printable(columns_[LogQuantity::Time]->name),
                    printable(std::string(text))));
        }
        if (!first_time_s_) {
            first_time_s_ = read->seconds;
            time_factor_ = factor_of_times(read->seconds);
        }
        double since_s = (read->seconds - *first_time_s_) * time_factor_;
        if (read->is_time_of_day) {
            since_s += since_s < 0.0 ? day_s : 0.0;
        }
        return since_s;
    }

    /// Times since 1970 in thousandths or millionths of a second are known by their size.
    double factor_of_times(double first) const {
        const LogColumn& column = *columns_[LogQuantity::Time];
        if (column.has_unit) {
            return column.factor;
        }
        return std::abs(first) > 1e14 ? 1e-6 : std::abs(first) > 1e11 ? 1e-3 : 1.0;
    }

    bool is_next(const sim::AircraftState& state) {
        if (samples_.empty()) {
            return true;
        }
        const sim::AircraftState& last = samples_.back();
        if (!(state.time_s - samples_.front().time_s <= max_track_duration_s)) {
            throw_error_at(
                log_.file,
                line_,
                fmt::format(
                    "expected a time within {:.0f} s of the first, got {:.3f} s",
                    max_track_duration_s,
                    state.time_s));
        }
        if (!(state.time_s > last.time_s)) {
            ++left_out_.not_later;
            return false;
        }
        const double way_m = glm::length(state.position_m - last.position_m);
        if (!(way_m / (state.time_s - last.time_s) <= max_track_speed_mps)) {
            ++left_out_.jumps;
            return false;
        }
        return true;
    }

    void take_velocity(sim::AircraftState& state, double north_bearing_rad) {
        const auto north = value(LogQuantity::NorthSpeed);
        const auto east = value(LogQuantity::EastSpeed);
        const auto down = value(LogQuantity::DownSpeed);
        has_velocities_ = has_velocities_ && north && east && down;
        if (has_velocities_) {
            state.velocity_mps = {rotated_clockwise({*east, *north}, north_bearing_rad), -*down};
            has_velocities_ = glm::length(state.velocity_mps) <= max_track_speed_mps;
        }
    }

    void take_angles(double north_turn_deg) {
        const auto roll = value(LogQuantity::Roll);
        const auto pitch = value(LogQuantity::Pitch);
        auto heading = value(LogQuantity::Heading);
        if (roll && pitch) {
            heading = heading ? std::optional(*heading + north_turn_deg) : std::nullopt;
            angles_.push_back({*roll, *pitch, heading});
        }
    }

    void take_logged_angles() {
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            const LoggedAngles& logged = angles_[i];
            const double flown_rad =
                euler_from_body_to_world(samples_[i].body_to_world).heading_rad;
            samples_[i].body_to_world = body_to_world_from_euler(
                {logged.heading ? rad_from_deg(*logged.heading) : flown_rad,
                 rad_from_deg(logged.pitch),
                 rad_from_deg(logged.roll)});
        }
    }

    std::vector<std::string> notes() const {
        const LogColumn& altitude = *columns_[LogQuantity::Altitude];
        std::vector<std::string> notes;
        if (!altitude.has_unit) {
            notes.push_back(fmt::format(
                "column {} names no unit: its heights are taken as metres (name it {}_ft for feet)",
                printable(altitude.name),
                printable(altitude.name)));
        }
        if (std::string left_out = said_of(left_out_); !left_out.empty()) {
            notes.push_back(std::move(left_out));
        }
        return notes;
    }

    static constexpr double day_s = 86400.0;

    const LogText& log_;
    const LogColumns& columns_;
    int line_ = 0;
    std::vector<std::string_view> fields_;
    std::optional<TransverseMercator> frame_;
    std::optional<double> first_time_s_;
    double time_factor_ = 1.0;
    std::vector<sim::AircraftState> samples_;
    std::vector<LoggedAngles> angles_;
    bool has_velocities_ = true;
    LeftOut left_out_;
};

} // namespace

LoggedTrack logged_track(const LogText& log, const LogColumns& columns) {
    LogReader reader(log, columns);
    for (std::size_t i = log.header_line + 1; i < log.lines.size(); ++i) {
        const bool is_empty = split_words(log.lines[i]).empty();
        if (!is_empty && !log.lines[i].starts_with('#')) {
            reader.read_line(i);
        }
    }
    return std::move(reader).track();
}

} // namespace octant::flightpaths
