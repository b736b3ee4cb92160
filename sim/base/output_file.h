#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <sys/types.h>

namespace octant {

// Queries of the file system. None throws: a name that is too long, a circle of links or a folder without permission
// counts as the name of nothing.

/// True if a file, folder or device has this name; links are followed.
bool path_exists(const std::filesystem::path& path);

bool is_folder(const std::filesystem::path& path);

/// True for a regular file: no folder, device or pipe.
bool is_file(const std::filesystem::path& path);

/// True if both names lead to the same file, which need not exist. False if either is empty.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// The absolute path without "." and ".."; `path` itself if the current folder is unknown.
std::filesystem::path absolute_path(const std::filesystem::path& path);

/// Writes the whole file or nothing: into a temporary file in its folder, then renamed over `path`. Throws Error (no
/// permission, no such folder, disk full) and leaves no temporary behind.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// A file that is written piece by piece, as by write_file: whole or not at all. Errors name `path`.
class WholeFile {
public:
    /// Makes the temporary file; a device or a pipe is opened itself. Throws Error.
    explicit WholeFile(std::filesystem::path path);
    /// Without finish() `path` stays as it was.
    ~WholeFile();
    WholeFile(WholeFile&&) = delete;
    WholeFile& operator=(WholeFile&&) = delete;
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    /// Throws Error (disk full).
    void append(std::string_view bytes);

    /// Renames the temporary over `path`; nothing more may be appended then. Throws Error.
    void finish();

private:
    std::filesystem::path path_;
    std::filesystem::path temporary_; ///< empty for a device or a pipe, and after finish()
    int descriptor_ = -1;
};

/// True for the name of a temporary file of write_file or WholeFile, which stays if the program is killed.
bool is_unfinished(const std::filesystem::path& path);

/// For use before long work: throws Error if write_file would fail because the folder is missing or not writable, or
/// because `path` is a folder. Writes nothing.
void check_can_write(const std::filesystem::path& path);

/// Makes the folder and its parents. Throws Error if that is not possible.
void make_folder(const std::filesystem::path& path);

/// A file that grows line by line. What was flushed stays if the program is killed.
class AppendedFile {
public:
    /// Creates or empties the file. After each flush the file ends with `end`, such as a closing bracket; the next
    /// flush overwrites it. Throws Error.
    explicit AppendedFile(std::filesystem::path path, std::string end = {});
    ~AppendedFile();
    AppendedFile(AppendedFile&&) = delete;
    AppendedFile& operator=(AppendedFile&&) = delete;
    AppendedFile(const AppendedFile&) = delete;
    AppendedFile& operator=(const AppendedFile&) = delete;

    /// Buffers the text until the next flush().
    void append(std::string_view text);

    /// Writes everything appended. Throws Error (disk full); nothing more may be appended then.
    void flush();

private:
    bool write_unwritten();

    std::filesystem::path path_;
    std::string end_;
    std::string unwritten_;
    off_t size_ = 0; ///< bytes before the end
    int descriptor_ = -1;
};

} // namespace octant
