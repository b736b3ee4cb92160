// Source: Tacview, "Technical Reference - ACMI flight recordings 2.2". A line is a time (#), the
// end of an object (-), or an object's number and properties between commas; a backslash takes a
// comma or a line's end for what it is.

#include "flightpaths/acmi_text.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <system_error>
#include <utility>

namespace octant::flightpaths {

namespace {

constexpr double longest_s = 86400.0;
constexpr std::size_t max_objects = 1000000;
/// The most places of all objects together.
constexpr std::size_t max_places = 20000000;

struct Source {
    const std::filesystem::path& file;
    int line;

    [[noreturn]] void refuse(std::string_view wanted, std::string_view got) const {
        constexpr std::size_t shown = 60;
        throw_error_at(
            file,
            line,
            fmt::format(
                "expected {}, got '{}'", wanted, printable(std::string(got.substr(0, shown)))));
    }
};

double number_from(std::string_view text, const Source& at) {
    const auto value = finite_number(text);
    if (!value) {
        at.refuse("a number", text);
    }
    return *value;
}

std::uint64_t id_from(std::string_view text, const Source& at) {
    constexpr int hexadecimal = 16;
    std::uint64_t id = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, id, hexadecimal);
    if (text.empty() || read.ec != std::errc() || read.ptr != end) {
        at.refuse("an object's number in hexadecimal digits, a # or a -", text);
    }
    return id;
}

/// Fields between commas that no backslash precedes.
std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '\\') {
            ++i;
        } else if (line[i] == ',') {
            fields.push_back(line.substr(begin, i - begin));
            begin = i + 1;
        }
    }
    fields.push_back(line.substr(begin));
    return fields;
}

std::string plain(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        i += text[i] == '\\' && i + 1 < text.size() ? 1U : 0U;
        out += text[i];
    }
    return out;
}

class Reader {
public:
    explicit Reader(const std::filesystem::path& file)
        : file_(file) {}

    void take(std::string_view line, int number) {
        const Source at{file_, number};
        if (line.starts_with("#")) {
            take_time(line.substr(1), at);
        } else if (line.starts_with("-")) {
            now_.erase(id_from(line.substr(1), at));
        } else if (!line.starts_with("//")) {
            take_object(line, at);
        }
    }

    std::vector<AcmiObject> objects() && { return std::move(objects_); }

private:
    /// What is known of an object that is there.
    struct Present {
        std::size_t object = 0;
        AcmiSample place;
        bool has_place = false;
    };

    void take_time(std::string_view text, const Source& at) {
        time_s_ = number_from(text, at);
        first_s_ = first_s_.value_or(time_s_);
        if (!(std::abs(time_s_ - *first_s_) <= longest_s)) {
            at.refuse(fmt::format("a time within {:.0f} s of the first", longest_s), text);
        }
    }

    void take_object(std::string_view line, const Source& at) {
        const std::vector<std::string_view> fields = fields_of(line);
        const std::uint64_t id = id_from(fields.front(), at);
        if (id == 0) {
            for (std::size_t i = 1; i < fields.size(); ++i) {
                take_global(fields[i], at);
            }
            return;
        }
        const auto [found, is_new] = now_.try_emplace(id, Present{objects_.size(), {}, false});
        if (is_new) {
            if (objects_.size() == max_objects) {
                at.refuse(fmt::format("at most {} objects", max_objects), line);
            }
            objects_.emplace_back();
        }
        for (std::size_t i = 1; i < fields.size(); ++i) {
            take_property(fields[i], found->second, at);
        }
    }

    void take_global(std::string_view field, const Source& at) {
        const std::size_t equals = field.find('=');
        const std::string_view name = field.substr(0, equals);
        if (name == "ReferenceLongitude") {
            longitude_deg_ = number_from(field.substr(equals + 1), at);
        } else if (name == "ReferenceLatitude") {
            latitude_deg_ = number_from(field.substr(equals + 1), at);
        }
    }

    void take_property(std::string_view field, Present& present, const Source& at) {
        AcmiObject& object = objects_[present.object];
        const std::size_t equals = field.find('=');
        if (equals == std::string_view::npos) {
            return;
        }
        const std::string_view value = field.substr(equals + 1);
        const std::string_view name = field.substr(0, equals);
        if (name == "T") {
            take_place(value, present, at);
        } else if (name == "Name") {
            object.name = plain(value);
        } else if (name == "Type") {
            object.type = plain(value);
        }
    }

    /// Longitude, latitude, altitude; then U, V or roll, pitch, yaw or these five and a heading.
    void take_place(std::string_view text, Present& present, const Source& at) {
        const std::vector<std::string_view> parts = split_fields(text, '|');
        constexpr std::size_t bare = 3;
        constexpr std::size_t flat = 5;
        constexpr std::size_t turned = 6;
        constexpr std::size_t whole = 9;
        const std::size_t count = parts.size();
        if (count != bare && count != flat && count != turned && count != whole) {
            at.refuse("3, 5, 6 or 9 components after T=", text);
        }
        AcmiSample& place = present.place;
        const std::array<double*, turned> targets{
            &place.longitude_deg,
            &place.latitude_deg,
            &place.altitude_m,
            &place.roll_deg,
            &place.pitch_deg,
            &place.heading_deg};
        const std::size_t used = count >= turned ? turned : bare;
        for (std::size_t i = 0; i < used; ++i) {
            if (!parts[i].empty()) {
                const double reference = i == 0 ? longitude_deg_ : i == 1 ? latitude_deg_ : 0.0;
                *targets[i] = reference + number_from(parts[i], at);
                present.has_place = present.has_place || i < 2;
            }
        }
        AcmiObject& object = objects_[present.object];
        object.has_attitude = object.has_attitude || count >= turned;
        place.time_s = time_s_;
        if (present.has_place) {
            if (++places_ > max_places) {
                at.refuse(fmt::format("at most {} places", max_places), text);
            }
            object.places.push_back(place);
        }
    }

    const std::filesystem::path& file_;
    double time_s_ = 0.0;
    std::optional<double> first_s_;
    double longitude_deg_ = 0.0;
    double latitude_deg_ = 0.0;
    std::map<std::uint64_t, Present> now_;
    std::vector<AcmiObject> objects_;
    std::size_t places_ = 0;
};

void check_head(const std::vector<std::string_view>& lines, const std::filesystem::path& file) {
    constexpr std::string_view type = "FileType=text/acmi/tacview";
    constexpr std::string_view version = "FileVersion=2.";
    const std::string_view first = lines.empty() ? std::string_view() : lines.front();
    if (first != type) {
        Source{file, 1}.refuse(type, first);
    }
    const std::string_view second = lines.size() < 2 ? std::string_view() : lines[1];
    if (!second.starts_with(version)) {
        Source{file, 2}.refuse("FileVersion=2.x", second);
    }
}

} // namespace

std::vector<AcmiObject> parse_acmi_objects(std::string_view text, const std::filesystem::path& file) {
    constexpr std::string_view mark = "\xef\xbb\xbf";
    if (text.starts_with(mark)) {
        text.remove_prefix(mark.size());
    }
    const std::vector<std::string_view> lines = split_lines(text);
    check_head(lines, file);
    Reader reader(file);
    std::string broken; // a line that goes on on the next one
    int begun_at = 0;
    for (std::size_t i = 2; i < lines.size(); ++i) {
        std::string_view line = lines[i];
        begun_at = broken.empty() ? static_cast<int>(i) + 1 : begun_at;
        if (line.ends_with('\\') && i + 1 < lines.size()) {
            line.remove_suffix(1);
            broken.append(line).append(" ");
            continue;
        }
        broken.append(line);
        if (!split_words(broken).empty()) {
            reader.take(broken, begun_at);
        }
        broken.clear();
    }
    return std::move(reader).objects();
}

} // namespace octant::flightpaths
