#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace octant::models::heights {

/// The scope of work with GDAL on one thread. During it GDAL does not use the network or start threads, and the session
/// records the first error and the warnings. Neither GDAL nor a library below it (HDF5, PROJ, libpng, libtiff) prints
/// on any thread. Side files of maps (.aux.xml) are read but never written, because datasets are opened read-only and
/// no statistics are requested. Sessions of a thread must not be nested.
class GdalSession {
public:
    GdalSession();
    ~GdalSession();
    GdalSession(const GdalSession&) = delete;
    GdalSession& operator=(const GdalSession&) = delete;
    GdalSession(GdalSession&&) = delete;
    GdalSession& operator=(GdalSession&&) = delete;

    bool failed() const { return !first_error_.empty(); }

    /// Whether the error was that no driver knows the file.
    bool is_unknown_format() const;

    /// Discards the error because it was harmless.
    void forget() { first_error_.clear(); }

    /// GDAL's first error as one printable line without the file's path; "no reason given" without one.
    std::string reason(const std::filesystem::path& path) const;

    /// GDAL's warnings: distinct printable lines, at most `max_warnings`.
    const std::vector<std::string>& warnings() const { return warnings_; }

    static constexpr std::size_t max_warnings = 8;

    /// Called by GDAL's error handler: records the first error.
    void note_error(const char* text);

    /// Called by GDAL's error handler: records a new warning.
    void note_warning(const char* text);

private:
    std::string first_error_;
    std::vector<std::string> warnings_;
};

/// Throws Error for a file that is not what was `expected`, such as "an image" or "a height field".
[[noreturn]] void throw_unreadable(
    const std::filesystem::path& file, std::string_view expected, const std::string& got);

/// Throws Error unless the numbers of columns and rows are from 2 to `max`.
void check_size(const std::filesystem::path& file, double columns, double rows, int max);

struct DatasetDeleter {
    void operator()(void* dataset) const;
};

/// Owner of a GDALDatasetH. Headers of this module do not include GDAL's headers, except gdal_functions.h.
using Dataset = std::unique_ptr<void, DatasetDeleter>;

/// A file in GDAL's memory under a path that no other file has; the destructor removes it.
class MemoryFile {
public:
    /// `name` is the last part of path(). The file has these bytes, which must outlive it, or does not exist until GDAL
    /// writes it. Throws std::bad_alloc.
    explicit MemoryFile(std::string_view name, std::string_view bytes = {});
    ~MemoryFile();
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    MemoryFile(MemoryFile&&) = delete;
    MemoryFile& operator=(MemoryFile&&) = delete;

    const std::string& path() const { return path_; }

    std::string_view bytes() const;

private:
    std::string path_;
};

} // namespace octant::models::heights
