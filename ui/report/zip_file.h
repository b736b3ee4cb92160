#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::report {

/// A zip file being written. Its bytes depend on names and contents only: entries carry no time.
class ZipWriter {
public:
    /// Creates the file under a temporary name in the same folder. Throws Error.
    explicit ZipWriter(std::filesystem::path file);
    /// Removes the file unless finish() was called.
    ~ZipWriter();
    ZipWriter(const ZipWriter&) = delete;
    ZipWriter& operator=(const ZipWriter&) = delete;
    ZipWriter(ZipWriter&&) = delete;
    ZipWriter& operator=(ZipWriter&&) = delete;

    /// Adds bytes under a name ("inputs/a.obj"). Throws Error.
    void add(const std::string& name, std::string_view bytes);

    /// Adds a file's content, read in pieces. Throws Error.
    void add_file(const std::string& name, const std::filesystem::path& file);

    /// Ends the file and renames it. Once only. Throws Error.
    void finish();

private:
    void begin_entry(const std::string& name);
    void write(std::string_view bytes);
    void end_entry();

    std::filesystem::path file_;
    std::filesystem::path part_;
    void* zip_ = nullptr;
};

/// A name and the bytes of an entry.
struct ZipContent {
    std::string name;
    std::string bytes;
};

/// A whole zip file in memory, as numpy's .npz files are; quickly compressed. Its bytes depend on names and contents
/// only. Asserts that each entry and the whole have less than 4 GB.
std::string zip_bytes(std::span<const ZipContent> entries);

/// An entry in the directory of a zip file.
struct ZipEntry {
    std::string name;
    std::uint64_t bytes = 0;
};

/// The files in a zip file, in the order of their names. Throws Error for a file of another format.
std::vector<ZipEntry> zip_entries(const std::filesystem::path& zip);

/// Writes a file of a zip file to `out`, whose folder is there. Throws Error, for a checksum that does not fit too.
void extract(const std::filesystem::path& zip, const std::string& name, const std::filesystem::path& out);

/// The content of a file in a zip file. Throws Error as extract(), and for a larger one.
std::string zip_text(const std::filesystem::path& zip, const std::string& name, std::size_t largest_bytes);

} // namespace octant::ui::report
