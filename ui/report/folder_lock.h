#pragma once

#include <filesystem>
#include <string_view>

namespace octant::ui::report {

/// True for names of files and folders of a recording, and for temporary files that a killed program left.
bool is_recording_name(std::string_view name);

/// Name of the file that a program locks while it writes into a folder.
inline constexpr const char* lock_name = "recording.lock";

/// Prevents other programs from recording into a folder, for its own lifetime. The system releases the lock when the
/// program is killed; a file left behind locks nothing.
class FolderLock {
public:
    /// Throws Error without waiting if another program, or this one, has locked the folder, and if no file can be made
    /// there. On file systems without locks, nothing is prevented.
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;
    FolderLock(FolderLock&&) = delete;
    FolderLock& operator=(FolderLock&&) = delete;

private:
    std::filesystem::path file_;
    int descriptor_ = -1;
};

/// True while a program has locked the folder. Writes nothing there.
bool is_locked(const std::filesystem::path& folder);

} // namespace octant::ui::report
