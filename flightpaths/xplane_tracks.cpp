// X-Plane's flight data recorder files (x-plane.com/kb/creating-fdr-files, and the sample that comes with version 12)
// and the table that its data output writes to Data.txt.

#include "flightpaths/fix_table.h"
#include "flightpaths/log_columns.h"
#include "flightpaths/track_readers.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::flightpaths {

namespace {

/// The line without its comment and the blanks around it.
std::string_view bare(std::string_view line) {
    line = line.substr(0, line.find("//"));
    return split_fields(line, '\n').front();
}

/// The quantities of a row of a flight data recorder file and where they stand.
struct FdrColumns {
    std::size_t first;
    std::size_t longitude;
    std::size_t heading;
    std::size_t pitch;
    std::size_t roll;
};

/// Rows that begin with DATA, and rows of version 4, which begin with their time.
constexpr FdrColumns data_columns{1, 3, 12, 10, 11};
constexpr FdrColumns bare_columns{0, 1, 4, 5, 6};

class FdrReader {
public:
    explicit FdrReader(const TrackSource& source) : source_(source), fixes_("X-Plane FDR", source.file) {
        fixes_.heights = HeightKind::Sea;
        fixes_.headings = HeadingKind::Unknown;
    }

    TrackRecording read() {
        const auto lines = split_lines(source_.bytes);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            line_ = static_cast<int>(i) + 1;
            const auto fields = split_fields(bare(lines[i]), ',');
            const std::string_view word = fields.front();
            if (word == "DATA") {
                take_row(fields, data_columns);
            } else if (!word.empty() && is_digit(word.front()) && fields.size() > bare_columns.roll) {
                take_row(fields, bare_columns);
            } else if (fields.size() > 1) {
                take_head(word, fields[1]);
            }
        }
        if (fixes_.time_scale == TimeScale::Own && date_s_ && clock_s_) { fixes_.begin_utc_s = *date_s_ + *clock_s_; }
        if (fixes_.time_scale == TimeScale::TimeOfDay) { fixes_.first_day_s = date_s_; }
        FixSeries& series = fixes_.series("");
        series.call_sign = tail_;
        series.name = aircraft_;
        return std::move(fixes_).recording(source_.follow);
    }

private:
    void take_head(std::string_view word, std::string_view value) {
        if (word == "ACFT") {
            const std::string_view file = value.substr(value.find_last_of('/') + 1);
            aircraft_ = file.substr(0, file.rfind(".acf"));
        } else if (word == "TAIL") {
            tail_ = value;
        } else if (word == "DATE") {
            const auto date = log_date(value.substr(0, value.find(' '))); // month/day/year
            date_s_ = date ? std::optional(date->seconds) : std::nullopt;
        } else if (word == "TIME") {
            const auto clock = log_time(value);
            clock_s_ = clock ? std::optional(clock->seconds) : std::nullopt;
        }
    }

    double number(const std::vector<std::string_view>& fields, std::size_t at, std::string_view what) const {
        const std::string_view text = at < fields.size() ? fields[at] : std::string_view();
        const auto value = finite_number(text);
        if (!value) { throw_error_at(source_.file, line_, fmt::format("expected {}, got {}", what, in_quotes(text))); }
        return *value;
    }

    void take_row(const std::vector<std::string_view>& fields, const FdrColumns& columns) {
        const std::string_view text = columns.first < fields.size() ? fields[columns.first] : std::string_view();
        const auto time = log_time(text);
        if (!time) {
            throw_error_at(source_.file, line_,
                fmt::format("expected seconds or a time such as 07:41:03, got {}", in_quotes(text)));
        }
        Fix fix;
        fix.line = line_;
        fix.time_s = time->seconds;
        fix.is_leap_second = time->is_leap_second;
        fixes_.time_scale = time->is_time_of_day ? TimeScale::TimeOfDay : TimeScale::Own;
        fix.longitude_deg = number(fields, columns.longitude, "a longitude in degrees");
        fix.latitude_deg = number(fields, columns.longitude + 1, "a latitude in degrees");
        fix.altitude_m = m_from_ft(number(fields, columns.longitude + 2, "a height in feet"));
        fix.heading_deg = number(fields, columns.heading, "a heading in degrees");
        fix.pitch_deg = number(fields, columns.pitch, "a pitch in degrees");
        fix.roll_deg = number(fields, columns.roll, "a roll in degrees");
        fixes_.add(fixes_.series(""), fix);
    }

    const TrackSource& source_;
    FixTable fixes_;
    int line_ = 0;
    std::string aircraft_;
    std::string tail_;
    std::optional<double> date_s_;
    std::optional<double> clock_s_;
};

/// A name of Data.txt without what fills it up: "__lat,__deg" is "lat,deg".
std::string plain_name(std::string_view text) {
    std::string name;
    for (const char c : text) {
        if (c != '_' && c != ' ') { name += static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }
    }
    return name;
}

/// The index of the first of these names that there is.
std::optional<std::size_t> column_of(
    const std::vector<std::string>& names, std::initializer_list<std::string_view> wanted) {
    for (const std::string_view name : wanted) {
        const auto found = std::ranges::find(names, name);
        if (found != names.end()) { return static_cast<std::size_t>(found - names.begin()); }
    }
    return std::nullopt;
}

bool is_data_head(std::string_view line) {
    return line.find('|') != line.npos && line.find("_time") != line.npos && line.find("deg") != line.npos;
}

/// The columns of Data.txt.
struct DataColumns {
    std::optional<std::size_t> time;
    std::optional<std::size_t> latitude;
    std::optional<std::size_t> longitude;
    std::optional<std::size_t> height;
    std::optional<std::size_t> pitch;
    std::optional<std::size_t> roll;
    std::optional<std::size_t> heading;
    std::optional<std::size_t> airspeed;
    std::optional<std::size_t> load_factor;
};

DataColumns data_columns_of(const std::vector<std::string>& names) {
    return {column_of(names, {"totl,time", "missn,time", "real,time"}), column_of(names, {"lat,deg"}),
        column_of(names, {"lon,deg"}), column_of(names, {"alt,ftmsl"}), column_of(names, {"pitch,deg"}),
        column_of(names, {"roll,deg"}), column_of(names, {"hding,true"}), column_of(names, {"vtrue,ktas"}),
        column_of(names, {"gload,norml"})};
}

} // namespace

bool is_xplane_fdr(std::string_view text) {
    // "A" or "I" for the line ends of two systems, then the version.
    const std::string_view head = text.substr(0, 256);
    const auto lines = split_lines(head);
    constexpr std::array kinds{"A", "I", "IBM", "APPLE"};
    return lines.size() >= 2 && std::ranges::find(kinds, bare(lines[0])) != kinds.end() && !bare(lines[1]).empty() &&
           is_digit(bare(lines[1]).front());
}

TrackRecording xplane_fdr_recording(const TrackSource& source) { return FdrReader(source).read(); }

bool is_xplane_data(std::string_view text) {
    constexpr std::size_t head = 65536;
    const auto lines = split_lines(text.substr(0, head));
    constexpr std::size_t looked_at = 4;
    return std::any_of(
        lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(std::min(looked_at, lines.size())), is_data_head);
}

TrackRecording xplane_data_recording(const TrackSource& source) {
    FixTable fixes("X-Plane Data.txt", source.file);
    fixes.heights = HeightKind::Sea;
    DataColumns columns;
    const auto lines = split_lines(source.bytes);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const int line = static_cast<int>(i) + 1;
        const auto fields = split_fields(lines[i], '|');
        if (is_data_head(lines[i])) {
            std::vector<std::string> names;
            for (const std::string_view field : fields) { names.push_back(plain_name(field)); }
            columns = data_columns_of(names);
            if (!columns.time || !columns.latitude || !columns.longitude || !columns.height) {
                throw_error_at(source.file, line,
                    "expected columns of times, latitude, longitude and height (data output rows 1 and 20), got "
                    "others");
            }
            continue;
        }
        if (!columns.time || fields.size() < 2) { continue; }
        const auto value = [&](const std::optional<std::size_t>& at) {
            const auto number = at && *at < fields.size() ? finite_number(fields[*at]) : std::nullopt;
            return number.value_or(not_measured);
        };
        Fix fix;
        fix.line = line;
        fix.time_s = value(columns.time);
        fix.latitude_deg = value(columns.latitude);
        fix.longitude_deg = value(columns.longitude);
        fix.altitude_m = m_from_ft(value(columns.height));
        if (std::isnan(fix.time_s + fix.latitude_deg + fix.longitude_deg + fix.altitude_m)) {
            fixes.skip_row();
            continue;
        }
        fix.pitch_deg = value(columns.pitch);
        fix.roll_deg = value(columns.roll);
        fix.heading_deg = value(columns.heading);
        fix.true_airspeed_mps = static_cast<float>(mps_from_kt(value(columns.airspeed)));
        fix.load_factor = static_cast<float>(value(columns.load_factor));
        fixes.add(fixes.series(""), fix);
    }
    return std::move(fixes).recording(source.follow);
}

} // namespace octant::flightpaths
