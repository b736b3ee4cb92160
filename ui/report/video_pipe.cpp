#include "ui/report/video_pipe.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <fstream>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace octant::ui::report {

namespace {

/// Filters that make the picture what a player expects: top row first, even sides (yuv420p halves them), colours of HD
/// video.
std::string filters(const VideoFormat& format) {
    std::string text = format.bottom_row_first ? "vflip," : "";
    if (format.width_px % 2 != 0 || format.height_px % 2 != 0) { text += "pad=ceil(iw/2)*2:ceil(ih/2)*2,"; }
    return text + "scale=out_color_matrix=bt709:out_range=tv";
}

std::vector<std::string> command(const std::filesystem::path& file, const VideoFormat& format) {
    const int frames_in_fragment = std::max(1, static_cast<int>(std::lround(format.frames_per_s)));
    return {"ffmpeg", "-hide_banner", "-nostdin", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt",
        format.channels == 4 ? "rgba" : "rgb24", "-video_size", fmt::format("{}x{}", format.width_px, format.height_px),
        "-framerate", fmt::format("{}", format.frames_per_s), "-i", "pipe:0", "-an", "-vf", filters(format), "-c:v",
        "libx264", "-crf", "20", "-pix_fmt", "yuv420p", "-colorspace", "bt709", "-color_primaries", "bt709",
        "-color_trc", "bt709", "-color_range", "tv", "-g", fmt::format("{}", frames_in_fragment), "-movflags",
        "+frag_keyframe+empty_moov+default_base_moof",
        // "file:" keeps a name with a colon or a leading dash from being read as something else.
        "-f", "mp4", "file:" + file.string()};
}

/// Finds out before the flight what ffmpeg would find out after it.
const std::filesystem::path& require_writable(const std::filesystem::path& file) {
    const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    if (::access(folder.c_str(), W_OK) != 0 || is_folder(file) ||
        (path_exists(file) && ::access(file.c_str(), W_OK) != 0)) {
        throw_error_in(file, "expected a file that can be written, got one that cannot");
    }
    return file;
}

/// Returns how many of a video's bytes, boxes of ISO 14496-12, are whole fragments with what stands before them; 0
/// where not one fragment is whole. A box of 4 GiB and more ends the search: no fragment of a second has one.
std::uintmax_t whole_fragments_bytes(const std::filesystem::path& file, std::uintmax_t size) {
    std::ifstream in(file, std::ios::binary);
    std::uintmax_t whole = 0;
    for (std::uintmax_t at = 0;;) {
        std::array<unsigned char, 8> head{};
        in.seekg(static_cast<std::streamoff>(at));
        if (!in.read(reinterpret_cast<char*>(head.data()), head.size())) { return whole; }
        const std::uintmax_t box =
            std::uintmax_t{head[0]} << 24U | std::uintmax_t{head[1]} << 16U | std::uintmax_t{head[2]} << 8U | head[3];
        if (box < head.size() || box > size - at) { return whole; }
        at += box;
        if (std::equal(head.begin() + 4, head.end(), "mdat")) { whole = at; }
    }
}

/// Cuts what a failed ffmpeg left after its last whole fragment, and removes it where it has none. Returns whether
/// something that plays is left.
bool truncate_to_whole_fragments(const std::filesystem::path& file) {
    if (!is_file(file)) { return false; }
    std::error_code fault;
    const std::uintmax_t size = std::filesystem::file_size(file, fault);
    const std::uintmax_t whole = fault ? 0 : whole_fragments_bytes(file, size);
    if (whole == 0) {
        std::filesystem::remove(file, fault);
    } else {
        std::filesystem::resize_file(file, whole, fault);
    }
    return whole > 0;
}

[[noreturn]] void refuse_without_ffmpeg(const std::filesystem::path& file) {
    throw_error_in(file, "expected ffmpeg to make a video with, found none on PATH");
}

ChildProgram start_ffmpeg(const std::filesystem::path& file, const VideoFormat& format) {
    std::optional<ChildProgram> program = ChildProgram::start(command(require_writable(file), format));
    if (!program) { refuse_without_ffmpeg(file); }
    return std::move(*program);
}

} // namespace

void check_video(const std::filesystem::path& file) {
    auto program = ChildProgram::start({"ffmpeg", "-version"});
    if (!program) { refuse_without_ffmpeg(file); }
    program->finish();
    require_writable(file);
}

VideoPipe::VideoPipe(const std::filesystem::path& file, const VideoFormat& format)
    : file_(file), format_(format), program_(start_ffmpeg(file, format)) {}

void VideoPipe::add(const PixelView& picture) {
    assert(picture.is_whole() && picture.width_px == format_.width_px);
    assert(picture.height_px == format_.height_px && picture.channels == format_.channels);
    assert(picture.bottom_row_first == format_.bottom_row_first);
    if (running()) {
        broken_ = !program_.send({reinterpret_cast<const char*>(picture.bytes.data()), picture.bytes.size()});
    }
}

std::optional<std::string> VideoPipe::finish() {
    const ProgramResult ending = program_.finish();
    // A full disk that ffmpeg meets as it closes the file is told, and its exit code is 0.
    if (ending.succeeded && !broken_ && ending.last_error_line.empty()) { return std::nullopt; }
    const char* const what = truncate_to_whole_fragments(file_) ? "cut short" : "not made";
    return fmt::format("{}: ffmpeg: {}", what, ending.last_error_line);
}

} // namespace octant::ui::report
