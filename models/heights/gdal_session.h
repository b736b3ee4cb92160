#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace octant::models::heights {

/// While one lives, GDAL on this thread writes nothing to stderr and no side files, keeps off the
/// network and remembers the first error it meets. Not to be nested.
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
    bool names_no_format() const;

    /// Starts over: what went wrong so far was harmless.
    void forget() { first_error_.clear(); }

    /// GDAL's first error as one printable piece without the file's path; "no reason given" when
    /// there was none.
    std::string reason(const std::filesystem::path& path) const;

    /// Keeps the text if it is the first; what GDAL's error handler calls.
    void note_error(const char* text);

private:
    std::string first_error_;
};

/// Refuses a file that should have been "an image" or "a height field".
[[noreturn]] void error_unreadable(
    const std::filesystem::path& file, std::string_view expected, const std::string& got);

struct CloseDataset {
    void operator()(void* dataset) const;
};

/// Owner of a GDALDatasetH. GDAL's own headers stay out of ours.
using Dataset = std::unique_ptr<void, CloseDataset>;

} // namespace octant::models::heights
