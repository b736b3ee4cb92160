#pragma once

#include "flightpaths/track_recording.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::flightpaths {

/// A place of an aircraft at a time, as a file has it: degrees, metres, metres per second. Other quantities may be
/// missing (not_measured).
struct Fix {
    /// Line of the file; 0 where it has none.
    int line = 0;
    double time_s = 0.0;
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    double altitude_m = not_measured;
    float north_mps = static_cast<float>(not_measured);
    float east_mps = static_cast<float>(not_measured);
    float up_mps = static_cast<float>(not_measured);
    float ground_speed_mps = static_cast<float>(not_measured);
    float track_deg = static_cast<float>(not_measured);
    double heading_deg = not_measured;
    double pitch_deg = not_measured;
    double roll_deg = not_measured;
    float load_factor = static_cast<float>(not_measured);
    float pressure_height_m = static_cast<float>(not_measured);
    float true_airspeed_mps = static_cast<float>(not_measured);
    float horizontal_error_m = static_cast<float>(not_measured);
    float vertical_error_m = static_cast<float>(not_measured);
    GroundContact contact = GroundContact::Unknown;
    /// The second that UTC adds at the end of a day (23:59:60), which has the number of the next one.
    bool is_leap_second = false;
};

/// What the times of a file count from.
enum class TimeScale : std::uint8_t {
    /// 1970, UTC.
    Utc,
    /// Midnight, UTC; they begin anew every day.
    TimeOfDay,
    /// Something that the file chose.
    Own
};

/// What the headings of a file count from.
enum class HeadingKind : std::uint8_t {
    True,
    Magnetic,
    /// Found by comparing them with the way over the ground.
    Unknown
};

/// All fixes of one aircraft, in the order of the file.
struct FixSeries {
    std::string id;
    std::string call_sign;
    std::string name;
    std::string type;
    std::string pilot;
    std::vector<Fix> fixes;
    /// Tacview's measure of who matters; the greatest is followed.
    double importance = 0.0;
};

/// Collects the fixes of a file and makes a recording of them.
class FixTable {
public:
    FixTable(std::string format, std::filesystem::path file) : format_(std::move(format)), file_(std::move(file)) {}

    /// The aircraft of this id; a new one where there is none. Valid until the next call. Throws Error for more than
    /// 100,000 aircraft.
    FixSeries& series(std::string_view id);

    /// Adds a fix. Throws Error for a place off the earth, for a height beyond 10,000 km and for more than 8 million
    /// fixes.
    void add(FixSeries& series, const Fix& fix);

    /// Counts a line without time, place or height.
    void skip_row() { ++without_place_; }

    void add_note(std::string note) { notes_.push_back(std::move(note)); }

    std::size_t fix_count() const { return count_; }

    /// Joins all series to one where none begins before the last one ends: parts of one flight, not several aircraft.
    void join_in_sequence();

    /// Gives the fixes of lines without times the times of a flight at the speed, 10 to 60 m/s, at which a bank of 45
    /// degrees follows nearly all of their bends, with a note.
    void space_out();

    /// Leaves out all series but the one that lasts longest, with a note.
    void keep_longest();

    std::size_t aircraft_count() const { return series_.size(); }

    TimeScale time_scale = TimeScale::Own;
    HeightKind heights = HeightKind::Unknown;
    HeadingKind headings = HeadingKind::True;
    /// The UTC of time 0 of a scale of the file's own, where it is known.
    std::optional<double> begin_utc_s;
    /// The day on which times of day begin, in seconds since 1970, where it is known.
    std::optional<double> first_day_s;
    /// Otherwise the unit of ground speeds is found by comparing them with the way.
    bool ground_speeds_have_unit = true;

    /// Fixes are taken in order of time where a file mixes it, the last of those of one time; otherwise those that are
    /// no later than the one before are left out.
    bool sorts = false;

    /// Whether an aircraft that stood for more than an hour begins another flight.
    bool splits = true;

    /// Puts the fixes in order: leaves out those that are no later, those that need more than 3,000 m/s and aircraft
    /// that do not move in time; begins another flight where an aircraft stood for more than an hour. Throws Error with
    /// the file where fewer than 2 fixes are left, and with file and line for a flight of more than 31 days.
    TrackRecording recording(const std::string& follow) &&;

private:
    struct LeftOut {
        long not_later = 0;
        long jumps = 0;
        long single = 0;
        long far = 0;
        long many = 0;
    };

    using Flight = FixSeries;

    void merge_numbered_rows();
    void fill_ground_heights();
    void choose_heights();
    void find_speed_unit(std::vector<Flight>& flights);
    void put_in_order(std::vector<Fix>& fixes);
    void resolve_times(std::vector<Fix>& fixes) const;
    std::vector<Fix> without_jumps(const std::vector<Fix>& fixes, std::size_t first, long& jumps) const;
    std::vector<Flight> flights();
    std::optional<TrackedAircraft> tracked(Flight flight, const EarthFrame& frame, double begin_s);
    void convert_headings(std::vector<Flight>& flights);
    std::string left_out_text(std::string_view before) const;
    void tell_left_out(std::vector<std::string>& notes) const;

    std::string format_;
    std::filesystem::path file_;
    std::vector<FixSeries> series_;
    std::map<std::string, std::size_t, std::less<>> index_;
    std::size_t count_ = 0;
    long without_place_ = 0;
    LeftOut left_out_;
    std::vector<std::string> notes_;
};

/// The index of the aircraft that a person names: by call sign, id, name or pilot, upper and lower case alike, else the
/// only one of which that is a part. `names`: for each aircraft its names. Throws Error.
std::size_t followed_index(const std::vector<std::vector<std::string>>& names, const std::string& follow);

} // namespace octant::flightpaths
