// Memory-mapped files on POSIX systems, with locks against a second import into the same file.
#include "visuals/groundfile/mapped_file.h"

#include "sim/base/error.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace octant::visuals::groundfile {

namespace {

[[noreturn]] void throw_system_error(const std::filesystem::path& path, const char* what) {
    throw_error_in(path, fmt::format("cannot be {}: {}", what, std::strerror(errno)));
}

std::size_t size_of_regular(const std::filesystem::path& path, int descriptor) {
    struct stat status {};

    if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
        throw_error_in(path, "expected a regular file, got a folder, device or pipe");
    }
    return static_cast<std::size_t>(status.st_size);
}

/// Locks a file against other writers. Also refuses a file that the import which held the lock until now has renamed.
void lock(const std::filesystem::path& path, int descriptor) {
    const bool is_held = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && (errno == EWOULDBLOCK || errno == EINTR);

    struct stat ours {};

    struct stat named {};

    const bool is_there = ::fstat(descriptor, &ours) == 0 && ::stat(path.c_str(), &named) == 0 &&
                          ours.st_ino == named.st_ino && ours.st_dev == named.st_dev;
    if (is_held || !is_there) { throw_error_in(path, "expected a file to write, but another import is writing it"); }
}

/// Allocates the space of an empty file. Returns 0 or the error number.
int allocate_space(int descriptor, off_t length) {
    while (::fallocate(descriptor, 0, 0, length) != 0) {
        if (errno == EOPNOTSUPP) { return ::ftruncate(descriptor, length) == 0 ? 0 : errno; }
        if (errno != EINTR) { return errno; }
    }
    return 0;
}

} // namespace

MappedFile::MappedFile(std::filesystem::path path, int flags, const char* purpose)
    : path_(std::move(path)), descriptor_(::open(path_.c_str(), flags | O_CLOEXEC | O_NONBLOCK, 0644)) {
    if (descriptor_ < 0) { throw_system_error(path_, purpose); }
}

MappedFile::MappedFile(std::filesystem::path path, Access access)
    : MappedFile(std::move(path), access == Access::ReadWrite ? O_RDWR : O_RDONLY,
          access == Access::ReadWrite ? "opened for writing" : "opened for reading") {
    const bool writes = access == Access::ReadWrite;
    size_ = size_of_regular(path_, descriptor_);
    if (writes) { lock(path_, descriptor_); }
    map(writes ? PROT_READ | PROT_WRITE : PROT_READ, access != Access::CopyOnWrite);
}

MappedFile::MappedFile(std::filesystem::path path, std::size_t size)
    : MappedFile(std::move(path), O_RDWR | O_CREAT, "written") {
    size_of_regular(path_, descriptor_);
    lock(path_, descriptor_);
    if (::ftruncate(descriptor_, 0) != 0) { throw_system_error(path_, "written"); }
    if (const int fault = allocate_space(descriptor_, static_cast<off_t>(size)); fault != 0) {
        ::unlink(path_.c_str());
        throw_error_in(
            path_, fmt::format("expected room for {} MB on the disk: {}", size / 1000000 + 1, std::strerror(fault)));
    }
    size_ = size;
    map(PROT_READ | PROT_WRITE, true);
}

void MappedFile::map(int protection, bool shared) {
    if (size_ == 0) { return; }
    void* const start = ::mmap(nullptr, size_, protection, shared ? MAP_SHARED : MAP_PRIVATE, descriptor_, 0);
    if (start == MAP_FAILED) { throw_system_error(path_, "mapped"); }
    start_ = static_cast<std::byte*>(start);
}

MappedFile::~MappedFile() {
    if (start_ != nullptr) { ::munmap(start_, size_); }
    ::close(descriptor_);
}

void MappedFile::write(std::size_t offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (written < 0) {
            if (errno == EINTR) { continue; }
            throw_system_error(path_, "written");
        }
        bytes = bytes.subspan(static_cast<std::size_t>(written));
        offset += static_cast<std::size_t>(written);
    }
}

std::span<std::byte> MappedFile::writable_copy(std::size_t offset, std::size_t size) {
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    const std::size_t begin = offset / page * page;
    if (::mprotect(start_ + begin, offset + size - begin, PROT_READ | PROT_WRITE) != 0) {
        throw_system_error(path_, "mended in memory");
    }
    return {start_ + offset, size};
}

void MappedFile::drop_cached_pages() {
    ::madvise(start_, size_, MADV_DONTNEED);
    ::posix_fadvise(descriptor_, 0, 0, POSIX_FADV_DONTNEED);
}

void MappedFile::sync() {
    if (::fsync(descriptor_) != 0) { throw_system_error(path_, "written"); }
}

void MappedFile::truncate(std::size_t size) {
    if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) { throw_system_error(path_, "written"); }
}

void sync_folder_of(const std::filesystem::path& path) {
    const std::filesystem::path parent = path.parent_path();
    const int folder = ::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_CLOEXEC);
    if (folder < 0) { return; }
    const int fault = ::fsync(folder) == 0 ? 0 : errno;
    ::close(folder);
    errno = fault;
    if (fault != 0 && fault != EINVAL) { throw_system_error(path, "written"); }
}

} // namespace octant::visuals::groundfile
