// ArduPilot's logs (ardupilot.org, "Diagnosing problems using logs", and the structure of its messages, which each log
// describes itself in FMT messages), and PX4's (docs.px4.io, "ULog File Format").

#include "flightpaths/fix_table.h"
#include "flightpaths/track_readers.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::flightpaths {

namespace {

/// A message of a log: values in the units of the text form, by the names of its columns; not_measured for texts.
struct LogMessage {
    std::string_view name;
    const std::vector<std::string>* columns = nullptr;
    std::vector<double> values;
    /// The text of a message of texts.
    std::string text;
    int line = 0;

    double value(std::initializer_list<std::string_view> names) const {
        for (const std::string_view wanted : names) {
            const auto found = std::ranges::find(*columns, wanted);
            const auto at = static_cast<std::size_t>(found - columns->begin());
            if (found != columns->end() && at < values.size()) { return values[at]; }
        }
        return not_measured;
    }
};

struct LogKind {
    std::string_view format;
    /// The messages that have places.
    std::string_view places;
    /// How long ago a receiver was where it says that it is; the autopilot's estimates do not lag.
    double receiver_delay_s = 0.0;
};

/// Collects the messages that tell of the flight.
class LogFlight {
public:
    LogFlight(const TrackSource& source, const LogKind& kind)
        : source_(source), kind_(kind), fixes_(std::string(kind.format), source.file) {
        fixes_.heights = HeightKind::Sea;
    }

    static bool is_used(std::string_view name) {
        return name == "GPS" || name == "POS" || name == "ATT" || name == "MSG";
    }

    void take(const LogMessage& message) {
        if (message.name == "MSG") {
            if (message.text.starts_with("ArduCopter") || message.text.starts_with("ArduPlane") ||
                message.text.starts_with("APM:Copter") || message.text.starts_with("APM:Plane")) {
                firmware_ = message.text;
            }
        } else if (message.name == "ATT") {
            const Angles angles{
                time_of(message), message.value({"Roll"}), message.value({"Pitch"}), message.value({"Yaw"})};
            if (!std::isnan(angles.time_s) && (angles_.empty() || angles.time_s > angles_.back().time_s)) {
                if (angles_.size() == max_messages) { refuse(message.line); }
                angles_.push_back(angles);
            }
        } else {
            take_place(message);
        }
    }

    /// UTC at a time of the log; the first that is told counts.
    void set_clock(double utc_s, double time_s) {
        if (!fixes_.begin_utc_s) { fixes_.begin_utc_s = utc_s - time_s; }
    }

    TrackRecording recording() && {
        constexpr std::size_t enough = 2;
        const bool by_estimate = estimated_.size() >= enough;
        std::vector<Fix>& places = by_estimate ? estimated_ : received_;
        FixSeries& series = fixes_.series("");
        series.name = firmware_;
        if (firmware_.find("Copter") != firmware_.npos) { series.type = "Air+Rotorcraft"; }
        for (Fix& fix : places) {
            take_angles(fix);
            fixes_.add(series, fix);
        }
        for (long i = 0; i < without_place_; ++i) { fixes_.skip_row(); }
        if (places.empty()) {
            throw_error_in(source_.file, fmt::format("expected places on the earth ({}), got none{}", kind_.places,
                                             without_place_ > 0 ? fmt::format(" in {} of them", without_place_) : ""));
        }
        return std::move(fixes_).recording(source_.follow);
    }

private:
    struct Angles {
        double time_s = 0.0;
        double roll_deg = 0.0;
        double pitch_deg = 0.0;
        double heading_deg = 0.0;
    };

    static constexpr std::size_t max_messages = 8000000;

    [[noreturn]] void refuse(int line) const {
        const std::string what = fmt::format("expected at most {} messages of a kind, got more", max_messages);
        if (line > 0) { throw_error_at(source_.file, line, what); }
        throw_error_in(source_.file, what);
    }

    /// Seconds since the autopilot was started.
    static double time_of(const LogMessage& message) {
        const double us = message.value({"TimeUS"});
        // Old logs count milliseconds; their GPS messages have those in T, beside the satellites' time.
        return std::isnan(us) ? message.value({"T", "TimeMS"}) * 1e-3 : us * 1e-6;
    }

    void take_place(const LogMessage& message) {
        const bool is_estimate = message.name == "POS";
        constexpr double fix_in_space = 3.0;
        const double instance = message.value({"I"});
        if (!is_estimate && (message.value({"Status"}) < fix_in_space || instance > 0.0)) { return; }
        Fix fix;
        fix.line = message.line;
        fix.time_s = time_of(message);
        fix.latitude_deg = degrees(message.value({"Lat"}));
        fix.longitude_deg = degrees(message.value({"Lng"}));
        fix.altitude_m = message.value({"Alt"});
        const bool is_nowhere = fix.latitude_deg == 0.0 && fix.longitude_deg == 0.0;
        if (is_nowhere || std::isnan(fix.time_s + fix.latitude_deg + fix.longitude_deg + fix.altitude_m)) {
            ++without_place_;
            return;
        }
        if (!is_estimate) {
            fix.ground_speed_mps = static_cast<float>(message.value({"Spd"}));
            fix.track_deg = static_cast<float>(message.value({"GCrs"}));
            fix.up_mps = -static_cast<float>(message.value({"VZ", "Vz"}));
            fix.time_s -= kind_.receiver_delay_s;
            take_satellite_time(message, fix.time_s);
        }
        std::vector<Fix>& places = is_estimate ? estimated_ : received_;
        if (places.size() == max_messages) { refuse(message.line); }
        places.push_back(fix);
    }

    /// Old text logs have whole numbers of 1e-7 degrees.
    static double degrees(double value) {
        constexpr double most_deg = 360.0;
        return std::abs(value) > most_deg ? value * 1e-7 : value;
    }

    /// The satellites' weeks and milliseconds give UTC, which has been 18 s behind since 2017.
    void take_satellite_time(const LogMessage& message, double time_s) {
        const double week = message.value({"GWk", "Week"});
        const double ms = message.value({"GMS", "TimeMS"});
        constexpr double first_week = 1000.0;
        if (fixes_.begin_utc_s || !(week > first_week) || std::isnan(ms)) { return; }
        constexpr double epoch_s = 315964800.0;
        constexpr double week_s = 604800.0;
        constexpr double behind_s = 18.0;
        set_clock(epoch_s + week * week_s + ms * 1e-3 - behind_s, time_s);
    }

    /// The attitude at the time of a place, between the two around it where they are near.
    void take_angles(Fix& fix) const {
        constexpr double longest_s = 1.0;
        const auto after = std::ranges::lower_bound(angles_, fix.time_s, {}, &Angles::time_s);
        if (after == angles_.end() || after == angles_.begin() || after->time_s - (after - 1)->time_s > longest_s) {
            return;
        }
        const Angles& a = *(after - 1);
        const double share = (fix.time_s - a.time_s) / (after->time_s - a.time_s);
        const auto between = [&](double from, double to) { return from + share * std::remainder(to - from, 360.0); };
        fix.roll_deg = between(a.roll_deg, after->roll_deg);
        fix.pitch_deg = between(a.pitch_deg, after->pitch_deg);
        fix.heading_deg = between(a.heading_deg, after->heading_deg);
    }

    const TrackSource& source_;
    LogKind kind_;
    FixTable fixes_;
    std::string firmware_;
    std::vector<Angles> angles_;
    std::vector<Fix> estimated_;
    std::vector<Fix> received_;
    long without_place_ = 0;
};

constexpr std::string_view ardupilot_places = "POS or GPS messages with a fix";
constexpr double ardupilot_delay_s = 0.2;

constexpr char magic_1 = '\xA3';
constexpr char magic_2 = '\x95';
constexpr std::size_t header_bytes = 3;
constexpr std::uint8_t format_kind = 128;

/// How a kind of message lies in a binary log.
struct MessageFormat {
    std::size_t length = 0;
    std::string name;
    std::string types;
    std::vector<std::string> columns;
};

template <class Number>
double number_in(std::string_view bytes, double factor = 1.0) {
    static_assert(std::endian::native == std::endian::little);
    Number number{};
    std::memcpy(&number, bytes.data(), sizeof(number));
    return static_cast<double>(number) * factor;
}

/// Bytes of a value of this type; 0 for an unknown one.
std::size_t bytes_of(char type) {
    switch (type) {
    case 'b':
    case 'B':
    case 'M':
        return 1;
    case 'h':
    case 'H':
    case 'c':
    case 'C':
    case 'g':
        return 2;
    case 'i':
    case 'I':
    case 'f':
    case 'e':
    case 'E':
    case 'L':
    case 'n':
        return 4;
    case 'd':
    case 'q':
    case 'Q':
        return 8;
    case 'N':
        return 16;
    case 'a':
    case 'Z':
        return 64;
    default:
        return 0;
    }
}

double value_of(char type, std::string_view bytes) {
    constexpr double hundredth = 0.01;
    switch (type) {
    case 'b':
        return number_in<std::int8_t>(bytes);
    case 'B':
    case 'M':
        return number_in<std::uint8_t>(bytes);
    case 'h':
        return number_in<std::int16_t>(bytes);
    case 'H':
        return number_in<std::uint16_t>(bytes);
    case 'c':
        return number_in<std::int16_t>(bytes, hundredth);
    case 'C':
        return number_in<std::uint16_t>(bytes, hundredth);
    case 'i':
        return number_in<std::int32_t>(bytes);
    case 'I':
        return number_in<std::uint32_t>(bytes);
    case 'e':
        return number_in<std::int32_t>(bytes, hundredth);
    case 'E':
        return number_in<std::uint32_t>(bytes, hundredth);
    case 'L':
        return number_in<std::int32_t>(bytes, 1e-7);
    case 'f':
        return number_in<float>(bytes);
    case 'd':
        return number_in<double>(bytes);
    case 'q':
        return number_in<std::int64_t>(bytes);
    case 'Q':
        return number_in<std::uint64_t>(bytes);
    default:
        return not_measured;
    }
}

std::string text_in(std::string_view bytes) { return std::string(bytes.substr(0, bytes.find('\0'))); }

std::vector<std::string> names_in(std::string_view text) {
    std::vector<std::string> names;
    for (const std::string_view name : split_fields(text, ',')) { names.emplace_back(name); }
    return names;
}

/// The format that a FMT message's bytes describe, after its header.
std::pair<std::uint8_t, MessageFormat> format_of(std::string_view bytes) {
    constexpr std::size_t name_at = 2;
    constexpr std::size_t types_at = 6;
    constexpr std::size_t columns_at = 22;
    MessageFormat format;
    format.length = static_cast<unsigned char>(bytes[1]);
    format.name = text_in(bytes.substr(name_at, types_at - name_at));
    format.types = text_in(bytes.substr(types_at, columns_at - types_at));
    format.columns = names_in(text_in(bytes.substr(columns_at)));
    return {static_cast<std::uint8_t>(bytes[0]), std::move(format)};
}

/// The values of a message, after its header; fewer where the bytes end.
LogMessage message_of(const MessageFormat& format, std::string_view bytes) {
    LogMessage message;
    message.name = format.name;
    message.columns = &format.columns;
    std::size_t at = 0;
    for (const char type : format.types) {
        const std::size_t size = bytes_of(type);
        if (size == 0 || at + size > bytes.size()) { break; }
        message.values.push_back(value_of(type, bytes.substr(at, size)));
        if (type == 'Z') { message.text = text_in(bytes.substr(at, size)); }
        at += size;
    }
    return message;
}

} // namespace

bool is_dataflash_binary(std::string_view bytes) {
    return bytes.size() > header_bytes && bytes[0] == magic_1 && bytes[1] == magic_2;
}

TrackRecording dataflash_binary_recording(const TrackSource& source) {
    constexpr std::size_t format_bytes = 86;
    std::array<MessageFormat, 256> formats;
    formats[format_kind].length = header_bytes + format_bytes;
    LogFlight flight(source, {"ArduPilot DataFlash", ardupilot_places, ardupilot_delay_s});
    std::size_t at = 0;
    std::size_t skipped = 0;
    while (at + header_bytes < source.bytes.size()) {
        const auto kind = static_cast<std::uint8_t>(source.bytes[at + 2]);
        const std::size_t length = formats.at(kind).length;
        const bool is_message = source.bytes[at] == magic_1 && source.bytes[at + 1] == magic_2 &&
                                length > header_bytes && at + length <= source.bytes.size();
        if (!is_message) {
            ++at;
            ++skipped;
            continue;
        }
        const std::string_view held = source.bytes.substr(at + header_bytes, length - header_bytes);
        if (kind == format_kind) {
            auto [described, format] = format_of(held);
            if (described != format_kind) { formats.at(described) = std::move(format); }
        } else if (LogFlight::is_used(formats.at(kind).name)) {
            flight.take(message_of(formats.at(kind), held));
        }
        at += length;
    }
    TrackRecording recording = std::move(flight).recording();
    if (skipped > 0) {
        recording.notes.push_back(fmt::format("left out {} bytes between the messages of the log", skipped));
    }
    return recording;
}

bool is_dataflash_text(std::string_view text) {
    constexpr std::size_t head = 4096;
    const std::string_view start = text.substr(0, head);
    return start.starts_with("FMT,") || start.find("\nFMT,") != start.npos || start.find("\nFMT, ") != start.npos;
}

TrackRecording dataflash_text_recording(const TrackSource& source) {
    std::map<std::string, std::vector<std::string>, std::less<>> formats;
    LogFlight flight(source, {"ArduPilot log", ardupilot_places, ardupilot_delay_s});
    int line = 0;
    for (const std::string_view row : split_lines(source.bytes)) {
        ++line;
        const auto fields = split_fields(row, ',');
        constexpr std::size_t names_at = 5;
        if (fields.front() == "FMT") {
            if (fields.size() <= names_at) { continue; }
            std::vector<std::string> names;
            for (std::size_t i = names_at; i < fields.size(); ++i) { names.emplace_back(fields[i]); }
            formats.insert_or_assign(std::string(fields[3]), std::move(names));
            continue;
        }
        const auto format = formats.find(fields.front());
        if (format == formats.end() || !LogFlight::is_used(fields.front())) { continue; }
        LogMessage message{.name = fields.front(), .columns = &format->second, .values = {}, .text = {}, .line = line};
        for (std::size_t i = 1; i < fields.size(); ++i) {
            const auto value = finite_number(fields[i]);
            message.values.push_back(value.value_or(not_measured));
            if (!value) { message.text = fields[i]; }
        }
        flight.take(message);
    }
    return std::move(flight).recording();
}

namespace {

constexpr std::string_view ulog_magic("ULog\x01\x12\x35", 7);
constexpr std::size_t ulog_head_bytes = 16;

/// Where a field of a logged message lies.
struct UlogField {
    std::string name;
    char type = '\0'; ///< as of value_of()
    std::size_t offset = 0;
};

/// The type letter of value_of() and the bytes of a type of ULog; nothing for other types.
std::optional<std::pair<char, std::size_t>> ulog_type(std::string_view name) {
    struct KnownType {
        std::string_view name;
        char letter;
        std::size_t bytes;
    };

    static constexpr std::array known{KnownType{"int8_t", 'b', 1}, KnownType{"uint8_t", 'B', 1},
        KnownType{"bool", 'B', 1}, KnownType{"char", 'B', 1}, KnownType{"int16_t", 'h', 2},
        KnownType{"uint16_t", 'H', 2}, KnownType{"int32_t", 'i', 4}, KnownType{"uint32_t", 'I', 4},
        KnownType{"float", 'f', 4}, KnownType{"double", 'd', 8}, KnownType{"int64_t", 'q', 8},
        KnownType{"uint64_t", 'Q', 8}};
    const auto found = std::ranges::find(known, name, &KnownType::name);
    return found == known.end() ? std::nullopt : std::optional(std::pair(found->letter, found->bytes));
}

/// The fields of a format "timestamp type; float[4] q; ..." up to the first of another format; each element of an array
/// is a field of its own, q0, q1, ...
std::vector<UlogField> ulog_fields(std::string_view format) {
    std::vector<UlogField> fields;
    std::size_t offset = 0;
    for (const std::string_view field : split_fields(format, ';')) {
        const auto words = split_words(field);
        if (words.size() != 2) { break; }
        const std::size_t bracket = words[0].find('[');
        const auto type = ulog_type(words[0].substr(0, bracket));
        if (!type) { break; }
        const std::size_t close = words[0].find(']');
        constexpr long most = 256;
        const auto count = bracket == words[0].npos ? std::optional<long>(1)
                                                    : whole_number(words[0].substr(bracket + 1, close - bracket - 1));
        if (!count || *count < 1 || *count > most) { break; }
        for (long i = 0; i < *count; ++i) {
            fields.push_back(
                {*count == 1 ? std::string(words[1]) : fmt::format("{}{}", words[1], i), type->first, offset});
            offset += type->second;
        }
    }
    return fields;
}

/// Turns the messages of a ULog into those of LogFlight.
class UlogReader {
public:
    explicit UlogReader(const TrackSource& source)
        : source_(source), flight_(source, {"PX4 ULog", "vehicle_global_position, vehicle_gps_position", 0.1}) {}

    TrackRecording read() {
        constexpr std::size_t head = 3;
        std::string_view rest = source_.bytes.substr(std::min(ulog_head_bytes, source_.bytes.size()));
        while (rest.size() > head) {
            const auto size = static_cast<std::size_t>(number_in<std::uint16_t>(rest));
            if (head + size > rest.size()) { break; } // a log of an autopilot that lost its power
            take(rest[2], rest.substr(head, size));
            rest.remove_prefix(head + size);
        }
        return std::move(flight_).recording();
    }

private:
    void take(char type, std::string_view held) {
        constexpr std::size_t name_at = 3;
        if (type == 'F') {
            const std::size_t colon = held.find(':');
            if (colon != held.npos) {
                formats_[std::string(held.substr(0, colon))] = ulog_fields(held.substr(colon + 1));
            }
        } else if (type == 'A' && held.size() > name_at) {
            const bool is_first = held[0] == '\0';
            if (is_first) {
                names_[static_cast<std::uint16_t>(number_in<std::uint16_t>(held.substr(1)))] = held.substr(name_at);
            }
        } else if (type == 'D' && held.size() > 2) {
            const auto name = names_.find(static_cast<std::uint16_t>(number_in<std::uint16_t>(held)));
            if (name != names_.end()) { take_data(name->second, held.substr(2)); }
        }
    }

    /// not_measured where there is no such field.
    static double field(const std::vector<UlogField>& fields, std::string_view data, std::string_view name) {
        const auto found = std::ranges::find(fields, name, &UlogField::name);
        if (found == fields.end()) { return not_measured; }
        const std::size_t bytes = bytes_of(found->type);
        return found->offset + bytes > data.size() ? not_measured
                                                   : value_of(found->type, data.substr(found->offset, bytes));
    }

    void take_data(const std::string& name, std::string_view data) {
        const auto format = formats_.find(name);
        if (format == formats_.end()) { return; }
        const auto value = [&](std::string_view of) { return field(format->second, data, of); };
        if (name == "vehicle_attitude") {
            send("ATT", attitude_columns_, attitude(value));
        } else if (name == "vehicle_global_position") {
            send("POS", place_columns_, {value("timestamp"), value("lat"), value("lon"), value("alt")});
        } else if (name == "vehicle_gps_position" || name == "sensor_gps") {
            send_receiver(value);
        }
    }

    /// Roll, pitch and yaw of the quaternion that takes body axes to north, east, down.
    template <class Value>
    static std::vector<double> attitude(const Value& value) {
        const double w = value("q0");
        const double x = value("q1");
        const double y = value("q2");
        const double z = value("q3");
        const double roll_rad = std::atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y));
        const double pitch_rad = std::asin(std::clamp(2.0 * (w * y - z * x), -1.0, 1.0));
        const double yaw_rad = std::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z));
        return {value("timestamp"), deg_from_rad(roll_rad), deg_from_rad(pitch_rad), deg_from_rad(yaw_rad)};
    }

    /// Older logs have whole numbers of 1e-7 degrees and millimetres.
    template <class Value>
    void send_receiver(const Value& value) {
        const double time_us = value("timestamp");
        const double latitude_deg = value("latitude_deg");
        const bool is_old = std::isnan(latitude_deg);
        const double north_mps = value("vel_n_m_s");
        const double east_mps = value("vel_e_m_s");
        send("GPS", receiver_columns_,
            {time_us, value("fix_type"), is_old ? value("lat") * 1e-7 : latitude_deg,
                is_old ? value("lon") * 1e-7 : value("longitude_deg"),
                is_old ? value("alt") * 1e-3 : value("altitude_msl_m"), std::hypot(north_mps, east_mps),
                deg_from_rad(std::atan2(east_mps, north_mps)), value("vel_d_m_s")});
        const double utc_us = value("time_utc_usec");
        if (utc_us > 0.0) { flight_.set_clock(utc_us * 1e-6, time_us * 1e-6); }
    }

    void send(std::string_view name, const std::vector<std::string>& columns, std::vector<double> values) {
        LogMessage message;
        message.name = name;
        message.columns = &columns;
        message.values = std::move(values);
        flight_.take(message);
    }

    const TrackSource& source_;
    LogFlight flight_;
    std::map<std::string, std::vector<UlogField>, std::less<>> formats_;
    std::map<std::uint16_t, std::string> names_;
    std::vector<std::string> attitude_columns_{"TimeUS", "Roll", "Pitch", "Yaw"};
    std::vector<std::string> place_columns_{"TimeUS", "Lat", "Lng", "Alt"};
    std::vector<std::string> receiver_columns_{"TimeUS", "Status", "Lat", "Lng", "Alt", "Spd", "GCrs", "VZ"};
};

} // namespace

bool is_ulog(std::string_view bytes) { return bytes.starts_with(ulog_magic); }

TrackRecording ulog_recording(const TrackSource& source) { return UlogReader(source).read(); }

} // namespace octant::flightpaths
