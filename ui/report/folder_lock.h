#pragma once

#include <filesystem>
#include <string_view>

namespace octant::ui::report {

/// True for the names that a recording gives its files and folders, and for what a kill left of writing one.
bool is_recording_name(std::string_view name);

/// Name of the file that whoever writes into a folder holds locked.
inline constexpr const char* lock_name = "recording.lock";

/// Keeps other programs from recording into a folder for as long as it lives. The system lets go of the lock when a
/// program is killed; the file that may be left then locks nothing.
class FolderLock {
public:
    /// Throws Error at once where another program, or this one, is writing into the folder, and where no file can be
    /// made there. File systems without locks keep nobody out.
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

/// True while somebody is writing into the folder. Writes nothing there.
bool is_locked(const std::filesystem::path& folder);

} // namespace octant::ui::report
