#include "ui/report/packed_recording.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/base/data_files.h"
#include "ui/base/json_value.h"
#include "ui/report/folder_lock.h"
#include "ui/report/run_file.h"
#include "ui/report/zip_file.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

namespace octant::ui::report {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* run_name = "run.json";

/// Settings that name a file which a recording knows by the way to it.
constexpr std::array terrain_settings{"terrain", "drape"};

/// The recording's own files by their names in it.
std::map<std::string, fs::path> own_files(const fs::path& folder) {
    std::map<std::string, fs::path> files;
    std::error_code code;
    for (fs::recursive_directory_iterator at(folder, code), end; !code && at != end; at.increment(code)) {
        const fs::path name = at->path().lexically_relative(folder);
        const std::string first = name.begin()->string();
        if (!is_recording_name(first) || first == lock_name || is_unfinished(first)) {
            at.disable_recursion_pending();
        } else if (at->is_regular_file()) {
            files.emplace(name.string(), at->path());
        }
    }
    if (code) { throw_error_in(folder, fmt::format("cannot be read: {}", code.message())); }
    return files;
}

/// The files that belong to one by their name: its own, and those beside it that differ by their ending (x.bil, x.hdr,
/// x.prj).
std::vector<fs::path> with_companions(const fs::path& file) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(file.parent_path())) {
        if (entry.is_regular_file() && entry.path().stem() == file.stem()) { files.push_back(entry.path()); }
    }
    std::ranges::sort(files);
    return files;
}

/// Brings what the settings name outside the folder inside, or notes it.
class ExternalFiles {
public:
    ExternalFiles(fs::path folder, bool with_terrain) : folder_(std::move(folder)), with_terrain_(with_terrain) {}

    void add_file_of_setting(Json& settings, const char* key, std::map<std::string, fs::path>& files) {
        if (!settings.contains(key) || !settings[key].is_string()) { return; }
        const fs::path file = folder_ / base::file_name_from_json(settings[key].get<std::string>());
        std::error_code ignored;
        const std::string within = file.lexically_normal().lexically_relative(folder_).string();
        if (!fs::is_regular_file(file, ignored) || files.contains(within)) { return; }
        if (!with_terrain_) {
            notes.push_back(fmt::format(
                "{} does not lie in the recording; --with-terrain packs it too", file.lexically_normal().string()));
            return;
        }
        const fs::path inside = fs::path("inputs") / key;
        for (const fs::path& each : with_companions(file)) { files.emplace((inside / each.filename()).string(), each); }
        settings[key] = base::json_from_file_name((inside / file.filename()).string());
    }

    std::vector<std::string> notes;

private:
    fs::path folder_;
    bool with_terrain_;
};

/// Throws Error unless these can be the files of one recording.
void check_entries(const fs::path& zip, const std::vector<ZipEntry>& entries) {
    constexpr std::uint64_t max_bytes = std::uint64_t{64} << 30;
    std::uint64_t bytes = 0;
    bool has_run = false;
    for (const ZipEntry& entry : entries) {
        const fs::path name(entry.name);
        const bool stays_inside =
            name.is_relative() && !name.empty() &&
            std::ranges::none_of(name, [](const fs::path& part) { return part == ".." || part == "."; });
        if (!stays_inside || !is_recording_name(name.begin()->string())) {
            throw_error_in(
                zip, fmt::format("expected only the files of a recording, got one with '{}'", printable(entry.name)));
        }
        bytes += entry.bytes;
        has_run = has_run || entry.name == run_name;
    }
    if (bytes > max_bytes) {
        throw_error_in(zip, fmt::format("expected at most {} bytes unpacked, got {}", max_bytes, bytes));
    }
    if (!has_run) { throw_error_in(zip, "expected a packed recording, got one without run.json"); }
}

/// Where a packed recording is unpacked below `parent`: reports call it by the name of the file.
fs::path folder_below(const fs::path& parent, const fs::path& zip) {
    const fs::path stem = zip.stem();
    return parent / (stem.empty() || stem == "." || stem == ".." ? "recording" : stem);
}

} // namespace

PackResult pack_recording(const fs::path& folder, const fs::path& zip, bool with_terrain) {
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored)) {
        throw_error_in(folder, "expected the folder of a recording, found none");
    }
    read_run_file(folder / run_name);
    if (is_locked(folder)) {
        throw_error_in(folder, "expected a recording that is finished, got one that is being written");
    }
    const fs::path whole = fs::absolute(folder).lexically_normal();
    std::map<std::string, fs::path> files = own_files(folder);
    Json run = parsed_json(folder / run_name, read_text_file(folder / run_name));
    ExternalFiles outsiders(whole.has_filename() ? whole : whole.parent_path(), with_terrain);
    if (run.contains("settings") && run["settings"].is_object()) {
        for (const char* key : terrain_settings) { outsiders.add_file_of_setting(run["settings"], key, files); }
    }
    ZipWriter writer(zip);
    writer.add(run_name, run.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    files.erase(run_name);
    for (const auto& [name, file] : files) { writer.add_file(name, file); }
    writer.finish();
    return {static_cast<int>(files.size()) + 1, std::move(outsiders.notes)};
}

UnpackedRecording::UnpackedRecording(const fs::path& zip)
    : folder_(folder_below(parent_.path(), zip)), alias_(folder_, zip.string()) {
    base::with_named_errors([&] {
        const std::vector<ZipEntry> entries = zip_entries(zip);
        check_entries(zip, entries);
        for (const ZipEntry& entry : entries) {
            make_folder((folder_ / entry.name).parent_path());
            extract(zip, entry.name, folder_ / entry.name);
        }
    });
}

RecordingFolder open_recording(const fs::path& folder_or_zip) {
    if (!is_file(folder_or_zip)) { return {folder_or_zip, nullptr}; }
    auto unpacked = std::make_shared<const UnpackedRecording>(folder_or_zip);
    const fs::path folder = unpacked->folder();
    return {folder, std::move(unpacked)};
}

} // namespace octant::ui::report
