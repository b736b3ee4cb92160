#include "visuals/terrain/mapped_file.h"

#include "sim/base/error.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace octant::visuals::terrain {

namespace {

[[noreturn]] void cannot(const std::filesystem::path& path, const char* what) {
    error_in(path, fmt::format("cannot be {}: {}", what, std::strerror(errno)));
}

} // namespace

MappedFile::MappedFile(std::filesystem::path path, Access access)
    : path_(std::move(path)) {
    const bool writes = access == Access::ReadAndWrite;
    descriptor_ = ::open(path_.c_str(), (writes ? O_RDWR : O_RDONLY) | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ < 0) {
        cannot(path_, writes ? "opened for writing" : "opened for reading");
    }

    struct stat status {};

    if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
        ::close(descriptor_);
        error_in(path_, "expected a regular file, got a folder, device or pipe");
    }
    size_ = static_cast<std::size_t>(status.st_size);
    map(writes ? PROT_READ | PROT_WRITE : PROT_READ);
}

MappedFile::MappedFile(std::filesystem::path path, std::size_t size)
    : path_(std::move(path))
    , size_(size) {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (descriptor_ < 0) {
        cannot(path_, "written");
    }
    const auto length = static_cast<off_t>(size);
    const bool taken = ::fallocate(descriptor_, 0, 0, length) == 0;
    if (!taken && (errno != EOPNOTSUPP || ::ftruncate(descriptor_, length) != 0)) {
        const int kept_errno = errno;
        ::close(descriptor_);
        ::unlink(path_.c_str());
        error_in(
            path_,
            fmt::format(
                "expected room for {} MB on the disk: {}",
                size / 1000000 + 1,
                std::strerror(kept_errno)));
    }
    map(PROT_READ | PROT_WRITE);
}

void MappedFile::map(int protection) {
    if (size_ == 0) {
        return;
    }
    void* const start = ::mmap(nullptr, size_, protection, MAP_SHARED, descriptor_, 0);
    if (start == MAP_FAILED) {
        const int kept_errno = errno;
        ::close(descriptor_);
        errno = kept_errno;
        cannot(path_, "mapped");
    }
    start_ = static_cast<std::byte*>(start);
}

MappedFile::~MappedFile() {
    if (start_ != nullptr) {
        ::munmap(start_, size_);
    }
    ::close(descriptor_);
}

void MappedFile::write(std::size_t offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written =
            ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (written < 0) {
            if (errno == EINTR) {
                continue;
            }
            cannot(path_, "written");
        }
        bytes = bytes.subspan(static_cast<std::size_t>(written));
        offset += static_cast<std::size_t>(written);
    }
}

void MappedFile::sync() {
    if (::fsync(descriptor_) != 0) {
        cannot(path_, "written");
    }
}

void MappedFile::cut(std::size_t size) {
    if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) {
        cannot(path_, "written");
    }
}

} // namespace octant::visuals::terrain
