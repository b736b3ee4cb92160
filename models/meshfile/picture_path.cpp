#include "models/meshfile/picture_path.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <optional>
#include <system_error>
#include <vector>

namespace octant::models::meshfile {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_entries = 10'000; ///< of a folder that are looked at

std::vector<fs::path> entries_of(const fs::path& folder) {
    std::vector<fs::path> entries;
    std::error_code ignored;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, ignored), end;
         entry != end && entries.size() < max_entries; entry.increment(ignored)) {
        entries.push_back(entry->path().filename());
    }
    std::ranges::sort(entries);
    return entries;
}

/// A file by its name in a folder, in any case; the exact name is preferred.
std::optional<fs::path> found_in(const fs::path& folder, const fs::path& name) {
    std::error_code ignored;
    if (fs::is_regular_file(folder / name, ignored)) { return folder / name; }
    fs::path at = folder;
    for (const fs::path& part : name) {
        if (part == "." || part == ".." || part == "/" || fs::exists(at / part, ignored)) {
            at /= part;
            continue;
        }
        const std::string wanted = lower_case(part.string());
        const std::vector<fs::path> entries = entries_of(at);
        const auto same =
            std::ranges::find_if(entries, [&](const fs::path& entry) { return lower_case(entry.string()) == wanted; });
        if (same == entries.end()) { return std::nullopt; }
        at /= *same;
    }
    return fs::is_regular_file(at, ignored) ? std::optional(at) : std::nullopt;
}

/// The folders in which pictures mostly lie that a mesh names by a path of another computer.
std::vector<fs::path> folders_around(const fs::path& beside) {
    std::vector<fs::path> folders;
    std::error_code ignored;
    for (const fs::path& entry : entries_of(beside)) {
        if (fs::is_directory(beside / entry, ignored)) { folders.push_back(beside / entry); }
    }
    const fs::path above = beside / "..";
    for (const fs::path& entry : entries_of(above)) {
        if (lower_case(entry.string()) == "textures" && fs::is_directory(above / entry, ignored)) {
            folders.push_back(above / entry);
        }
    }
    folders.push_back(above);
    return folders;
}

} // namespace

std::string lower_case(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::optional<std::string> without_percents(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            out += text[i];
            continue;
        }
        const std::string hex(text.substr(i + 1, 2));
        if (hex.size() != 2 || hex.find_first_not_of("0123456789abcdefABCDEF") != hex.npos || hex == "00") {
            return std::nullopt;
        }
        out += static_cast<char>(std::stoi(hex, nullptr, 16));
        i += 2;
    }
    return out;
}

fs::path picture_file(const fs::path& mesh_file, const std::string& name, const fs::path& folder) {
    std::string slashes = name;
    std::ranges::replace(slashes, '\\', '/');
    const fs::path last = fs::path(slashes).filename();
    const fs::path beside = mesh_file.parent_path();
    if (last.empty()) { return beside / slashes; }
    for (const fs::path& from : {folder.empty() ? beside : folder, beside}) {
        for (const fs::path& wanted : {fs::path(slashes), last}) {
            if (const auto file = found_in(from, wanted)) { return *file; }
        }
    }
    for (const fs::path& from : folders_around(beside)) {
        if (const auto file = found_in(from, last)) { return *file; }
    }
    return beside / slashes;
}

} // namespace octant::models::meshfile
