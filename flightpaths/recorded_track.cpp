#include "flightpaths/recorded_track.h"

#include "flightpaths/track_motion.h"
#include "flightpaths/track_readers.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <iterator>
#include <utility>

namespace octant::flightpaths {

namespace {

void append_utf8(std::string& out, unsigned code) {
    if (code < 0x80U) {
        out += static_cast<char>(code);
    } else if (code < 0x800U) {
        out += static_cast<char>(0xC0U | code >> 6U);
        out += static_cast<char>(0x80U | (code & 0x3FU));
    } else {
        out += static_cast<char>(0xE0U | code >> 12U);
        out += static_cast<char>(0x80U | (code >> 6U & 0x3FU));
        out += static_cast<char>(0x80U | (code & 0x3FU));
    }
}

/// UTF-16 with a byte order mark as UTF-8; characters beyond the first plane become two question marks.
std::string from_utf16(std::string_view bytes) {
    const bool is_little = bytes.front() == '\xFF';
    std::string out;
    for (std::size_t at = 2; at + 1 < bytes.size(); at += 2) {
        const unsigned first = static_cast<unsigned char>(bytes[at]);
        const unsigned second = static_cast<unsigned char>(bytes[at + 1]);
        const unsigned code = is_little ? second << 8U | first : first << 8U | second;
        const bool is_half = code >= 0xD800U && code < 0xE000U;
        append_utf8(out, is_half ? static_cast<unsigned>('?') : code);
    }
    return out;
}

constexpr std::string_view unknown_binary = "binary data";

/// What binary data are, by their first bytes.
std::string_view binary_kind(std::string_view bytes) {
    struct Kind {
        std::size_t at;
        std::string_view bytes;
        std::string_view name;
    };

    using namespace std::string_view_literals;
    static constexpr std::array kinds{Kind{0, "\x89PNG"sv, "a PNG picture"},
        Kind{0, "\xFF\xD8\xFF"sv, "a JPEG picture"}, Kind{0, "GIF8"sv, "a GIF picture"},
        Kind{0, "II*\0"sv, "a TIFF picture or map"}, Kind{0, "MM\0*"sv, "a TIFF picture or map"},
        Kind{0, "%PDF"sv, "a PDF document"}, Kind{0, "\x1F\x8B"sv, "a gzip archive: unpack it"},
        Kind{0, "BZh"sv, "a bzip2 archive: unpack it"}, Kind{0, "7z\xBC\xAF"sv, "a 7z archive: unpack it"},
        Kind{0,
            "\xFD"
            "7zXZ"sv,
            "an xz archive: unpack it"},
        Kind{0,
            "\x7F"
            "ELF"sv,
            "a program"},
        Kind{0, "MZ"sv, "a program"}, Kind{0, "SQLite format 3"sv, "an SQLite database"},
        Kind{0, "\x89HDF"sv, "an HDF5 file"}, Kind{0, "PAR1"sv, "a Parquet file"},
        Kind{0, "RIFF"sv, "a sound or video"}, Kind{4, "ftyp"sv, "a video"}, Kind{8, ".FIT"sv, "a Garmin FIT file"},
        Kind{0, "glTF"sv, "a glTF mesh"}, Kind{0, "\xB5\x62"sv, "u-blox messages"}, Kind{0, "BUILD"sv, "a DJI log"},
        Kind{16, "BUILD"sv, "a DJI log"}};
    const auto* const kind = std::ranges::find_if(
        kinds, [&](const Kind& one) { return bytes.substr(std::min(one.at, bytes.size())).starts_with(one.bytes); });
    return kind == kinds.end() ? unknown_binary : kind->name;
}

/// Text as readers want it. `storage` holds what had to be converted.
std::string_view plain_text(
    std::string_view bytes, const std::filesystem::path& file, std::string& storage, std::vector<std::string>& notes) {
    if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
        storage = from_utf16(bytes);
        bytes = storage;
    }
    if (bytes.starts_with("\xEF\xBB\xBF")) { bytes.remove_prefix(3); }
    const std::size_t end = bytes.find_last_not_of('\0');
    const std::size_t zeros = bytes.size() - (end == bytes.npos ? 0 : end + 1);
    if (zeros > 0 && end != bytes.npos) {
        notes.push_back(fmt::format("left out {} zero bytes at the end of the file", zeros));
        bytes.remove_suffix(zeros);
    }
    const bool has_magic =
        !bytes.empty() && static_cast<unsigned char>(bytes.front()) >= 0x80U && binary_kind(bytes) != unknown_binary;
    if (has_magic || bytes.find('\0') != bytes.npos) {
        throw_error_in(
            file, fmt::format("expected text or a known format of flight recordings, got {}", binary_kind(bytes)));
    }
    return bytes;
}

struct Format {
    bool (*is_format)(std::string_view);
    TrackRecording (*read)(const TrackSource&);
};

constexpr Format text_formats[] = {{is_acmi, acmi_recording}, {is_gpx, gpx_recording},
    {is_readsb_trace, readsb_recording}, {is_kml, kml_recording}, {is_xplane_fdr, xplane_fdr_recording},
    {is_xplane_data, xplane_data_recording}, {is_dataflash_text, dataflash_text_recording},
    {is_basestation, basestation_recording}, {is_igc, igc_recording}};

} // namespace

TrackRecording parse_track_recording(
    std::string_view bytes, const std::filesystem::path& file, const std::string& follow) {
    if (is_dataflash_binary(bytes)) { return dataflash_binary_recording({bytes, file, follow}); }
    if (is_ulog(bytes)) { return ulog_recording({bytes, file, follow}); }
    if (is_mavlink_log(bytes)) { return mavlink_log_recording({bytes, file, follow}); }
    std::string storage;
    std::vector<std::string> notes;
    const TrackSource source{plain_text(bytes, file, storage, notes), file, follow};
    const auto* const format =
        std::ranges::find_if(text_formats, [&](const Format& known) { return known.is_format(source.bytes); });
    TrackRecording recording = format == std::end(text_formats) ? table_recording(source) : format->read(source);
    recording.notes.insert(recording.notes.begin(), notes.begin(), notes.end());
    return recording;
}

RecordedTrack read_recorded_track(const std::filesystem::path& file) {
    TrackRecording recording = parse_track_recording(read_file(file), file);
    TrackMotion motion = motion_of(recording.aircraft.front());
    std::vector<std::string> notes = std::move(recording.notes);
    notes.insert(notes.end(), motion.notes.begin(), motion.notes.end());
    return {std::move(motion.trajectory), recording.origin, std::move(notes)};
}

} // namespace octant::flightpaths
