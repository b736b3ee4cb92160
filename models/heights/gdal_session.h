#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace octant::models::heights {

/// While one lives, GDAL on this thread keeps off the network and remembers the first error and the warnings it meets.
/// GDAL begins no threads of its own then, so that each warning belongs to the session whose work it is about. Neither
/// GDAL nor a library below it (HDF5, PROJ, libpng, libtiff) prints on any thread. Side files of maps (.aux.xml) are
/// read; none is written, because datasets are opened for reading only, nothing is set in them and no statistics or
/// histograms are asked for. Not to be nested.
class GdalSession {
public:
    GdalSession();
    ~GdalSession();
    GdalSession(const GdalSession&) = delete;
    GdalSession& operator=(const GdalSession&) = delete;
    GdalSession(GdalSession&&) = delete;
    GdalSession& operator=(GdalSession&&) = delete;

    bool failed() const { return !first_error_.empty(); }

    /// True when the error was that no driver knows the file.
    bool is_unknown_format() const;

    /// Starts over: what went wrong so far was harmless.
    void forget() { first_error_.clear(); }

    /// GDAL's first error as one printable piece without the file's path; "no reason given" when there was none.
    std::string reason(const std::filesystem::path& path) const;

    /// What GDAL warned of: each text once, one printable line, at most `max_warnings` of them.
    const std::vector<std::string>& warnings() const { return warnings_; }

    static constexpr std::size_t max_warnings = 8;

    /// Keeps the text if it is the first; what GDAL's error handler calls.
    void note_error(const char* text);

    /// Keeps the text if it is new; what GDAL's error handler calls.
    void note_warning(const char* text);

private:
    std::string first_error_;
    std::vector<std::string> warnings_;
};

/// Refuses a file that should have been "an image" or "a height field".
[[noreturn]] void throw_unreadable(
    const std::filesystem::path& file, std::string_view expected, const std::string& got);

struct DatasetDeleter {
    void operator()(void* dataset) const;
};

/// Owner of a GDALDatasetH. GDAL's own headers stay out of ours.
using Dataset = std::unique_ptr<void, DatasetDeleter>;

} // namespace octant::models::heights
