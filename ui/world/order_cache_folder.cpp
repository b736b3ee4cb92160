#include "ui/world/order_cache_folder.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "ui/base/data_files.h"
#include "ui/settings/settings.h"
#include "visuals/ordercache/order_cache.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <system_error>
#include <vector>

namespace octant::ui::world {

namespace fs = std::filesystem;
namespace ordercache = visuals::ordercache;

namespace {

/// What the user's own cache may hold.
constexpr std::uintmax_t max_bytes_of_user_cache = std::uintmax_t{256} << 20;

/// A file of a cache.
struct FoundFile {
    fs::file_time_type written;
    fs::path path;
    std::uintmax_t bytes = 0;
};

/// What caches keep, and nothing else that lies there; the last two are of older releases. What another run is writing
/// is left alone.
const std::array<fs::path, 4> cache_file_endings{".order", ".mesh", ".pm", ".repairs"};

std::vector<FoundFile> files_of(const fs::path& folder) {
    std::vector<FoundFile> files;
    std::error_code ignored;
    for (fs::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored)) {
        const fs::path kind = entry->path().extension();
        std::error_code size_error;
        std::error_code time_error;
        const bool is_unfinished_file = is_unfinished(entry->path());
        if ((std::ranges::find(cache_file_endings, kind) == cache_file_endings.end() && !is_unfinished_file) ||
            entry->symlink_status(size_error).type() != fs::file_type::regular) {
            continue;
        }
        const std::uintmax_t bytes = entry->file_size(size_error);
        const fs::file_time_type written = entry->last_write_time(time_error);
        const bool is_being_written =
            is_unfinished_file && fs::file_time_type::clock::now() - written < std::chrono::hours(1);
        if (!size_error && !time_error && !is_being_written) { files.push_back({written, entry->path(), bytes}); }
    }
    return files;
}

} // namespace

void remove_oldest(const fs::path& folder, std::uintmax_t max_bytes) {
    std::vector<FoundFile> files = files_of(folder);
    std::ranges::sort(files, std::greater(), &FoundFile::written);
    std::uintmax_t sum = 0;
    for (const FoundFile& file : files) {
        if (file.bytes > max_bytes - sum) {
            std::error_code ignored;
            fs::remove(file.path, ignored);
        } else {
            sum += file.bytes;
        }
    }
}

std::optional<fs::path> order_cache_folder(const std::string& value) {
    if (settings::is_order_cache_folder(value)) {
        ordercache::make_cache_folder(value);
        return value;
    }
    const fs::path own = base::cache_folder();
    if (value == settings::no_order_cache || own.empty()) { return std::nullopt; }
    try {
        ordercache::make_cache_folder(own / "orders");
        remove_oldest(own / "orders", max_bytes_of_user_cache);
        return own / "orders";
    } catch (const Error&) { return std::nullopt; }
}

} // namespace octant::ui::world
