#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace octant {

// What the file system says of a name, without ever throwing: names that are too long, links in a circle and folders
// that may not be searched are names of nothing.

/// Whether a file, folder or device of that name can be found, links followed.
bool path_exists(const std::filesystem::path& path);

bool is_folder(const std::filesystem::path& path);

/// Whether it is a file of bytes: no folder, device or pipe.
bool is_file(const std::filesystem::path& path);

/// Whether both names lead to the same file, be it there or still to be written. False where either is empty.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// The name from the root on, without "." and ".."; `path` itself where that cannot be told.
std::filesystem::path absolute_path(const std::filesystem::path& path);

/// Writes the whole file or nothing: into a temporary file in its folder, then renamed over `path`. Throws Error (no
/// permission, no such folder, disk full) and leaves no temporary behind.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Whether a file of that name is what a kill left of write_file.
bool is_unfinished(const std::filesystem::path& path);

/// Before long work: throws Error where write_file would find no folder, none that it may write in, or a folder in the
/// file's place. Writes nothing.
void check_can_write(const std::filesystem::path& path);

/// Makes the folder and its parents. Throws Error when that is not possible.
void make_folder(const std::filesystem::path& path);

/// A file that grows line by line and survives a kill: what was flushed is in the kernel's hands.
class AppendedFile {
public:
    /// Creates or empties the file. Throws Error.
    explicit AppendedFile(std::filesystem::path path);
    ~AppendedFile();
    AppendedFile(AppendedFile&&) = delete;
    AppendedFile& operator=(AppendedFile&&) = delete;
    AppendedFile(const AppendedFile&) = delete;
    AppendedFile& operator=(const AppendedFile&) = delete;

    /// Keeps the text until the next flush.
    void append(std::string_view text);

    /// Hands everything appended to the kernel. Throws Error (disk full).
    void flush();

private:
    std::filesystem::path path_;
    std::string unwritten_;
    int descriptor_ = -1;
};

} // namespace octant
