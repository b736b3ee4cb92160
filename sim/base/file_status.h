#pragma once

#include <filesystem>

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

} // namespace octant
