#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::report {

/// A zip file being written. Its bytes depend on names and contents only: entries carry no time.
class ZipWriter {
public:
    /// Makes the file under another name beside it. Throws Error.
    explicit ZipWriter(std::filesystem::path file);
    /// Removes what was written unless finish() came.
    ~ZipWriter();
    ZipWriter(const ZipWriter&) = delete;
    ZipWriter& operator=(const ZipWriter&) = delete;
    ZipWriter(ZipWriter&&) = delete;
    ZipWriter& operator=(ZipWriter&&) = delete;

    /// Adds bytes under a name ("inputs/a.obj"). Throws Error.
    void add(const std::string& name, std::string_view bytes);

    /// Adds a file's content, read in pieces. Throws Error.
    void add_file(const std::string& name, const std::filesystem::path& file);

    /// Ends the file and gives it its name. Once only. Throws Error.
    void finish();

private:
    void begin_entry(const std::string& name);
    void write(std::string_view bytes);
    void end_entry();

    std::filesystem::path file_;
    std::filesystem::path part_;
    void* zip_ = nullptr;
};

/// What a zip file says that it holds.
struct ZipEntry {
    std::string name;
    std::uint64_t bytes = 0;
};

/// The files in a zip file, in the order of their names. Throws Error where it is none.
std::vector<ZipEntry> zip_entries(const std::filesystem::path& zip);

/// Writes a file of a zip file to `out`, whose folder is there. Throws Error, for a checksum that does not fit too.
void extract(const std::filesystem::path& zip, const std::string& name, const std::filesystem::path& out);

/// What a file of a zip file holds. Throws Error, as extract() and for one that is larger.
std::string zip_text(const std::filesystem::path& zip, const std::string& name, std::size_t largest_bytes);

} // namespace octant::ui::report
