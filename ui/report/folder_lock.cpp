#include "ui/report/folder_lock.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "ui/report/kernel_counters.h"
#include "ui/report/track_picture.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <iterator>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace octant::ui::report {

bool is_recording_name(std::string_view name) {
    constexpr std::array<std::string_view, 13> names{lock_name, "inputs", "run.json", "frames.csv", "mangohud.csv",
        "trace.json", "track.acmi", "track.csv", track_picture_name, "flight.csv", counters_name, "packets.bin",
        "report.html"};
    const bool is_picture = (name.starts_with("picture-") || name.starts_with("slow-")) && name.ends_with(".png");
    return is_unfinished(name) || is_picture || std::find(names.begin(), names.end(), name) != names.end();
}

namespace {

namespace fs = std::filesystem;

/// Who holds the lock, as the file says; empty where it says nothing.
std::string holder_in(int descriptor) {
    std::array<char, 200> text{};
    const ssize_t read = ::pread(descriptor, text.data(), text.size(), 0);
    std::string holder(text.data(), static_cast<std::size_t>(std::max<ssize_t>(read, 0)));
    return holder.substr(0, holder.find('\n'));
}

std::string own_name() {
    std::array<char, 256> host{};
    if (::gethostname(host.data(), host.size() - 1) != 0) { host.front() = '\0'; }
    return fmt::format("process {} on {}\n", ::getpid(), host.data());
}

/// True while the locked file is the one of that name: its last holder may just have removed it.
bool is_named(int descriptor, const fs::path& file) {
    struct stat locked_status {};

    struct stat named_status {};

    return ::fstat(descriptor, &locked_status) == 0 && ::stat(file.c_str(), &named_status) == 0 &&
           locked_status.st_ino == named_status.st_ino && locked_status.st_dev == named_status.st_dev;
}

/// The locked file, opened.
int locked(const fs::path& file) {
    for (;;) {
        const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
        if (descriptor < 0) { throw_error_in(file, fmt::format("cannot be written: {}", std::strerror(errno))); }
        const bool busy = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
        if (busy) {
            const std::string holder = holder_in(descriptor);
            ::close(descriptor);
            throw_error_in(file.parent_path(),
                fmt::format("expected a folder that nobody records into, got one that {} records into",
                    holder.empty() ? "another program" : printable(holder)));
        }
        if (is_named(descriptor, file)) { return descriptor; }
        ::close(descriptor);
    }
}

} // namespace

FolderLock::FolderLock(const fs::path& folder) : file_(folder / lock_name), descriptor_(locked(file_)) {
    const std::string name = own_name();
    if (::ftruncate(descriptor_, 0) != 0 || ::pwrite(descriptor_, name.data(), name.size(), 0) != std::ssize(name)) {
        const std::string reason = std::strerror(errno);
        ::unlink(file_.c_str());
        ::close(descriptor_);
        throw_error_in(file_, "cannot be written: " + reason);
    }
}

FolderLock::~FolderLock() {
    ::unlink(file_.c_str());
    ::close(descriptor_);
}

bool is_locked(const fs::path& folder) {
    const int descriptor = ::open((folder / lock_name).c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) { return false; }
    const bool busy = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    ::close(descriptor);
    return busy;
}

} // namespace octant::ui::report
