#include "sim/base/output_file.h"

#include "sim/base/error.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace octant {

namespace fs = std::filesystem;

namespace {

/// None where the system cannot tell.
fs::file_type type_of(const fs::path& path) {
    std::error_code fault;
    const fs::file_type type = fs::status(path, fault).type();
    return fault ? fs::file_type::none : type;
}

} // namespace

bool path_exists(const fs::path& path) {
    const fs::file_type type = type_of(path);
    return type != fs::file_type::none && type != fs::file_type::not_found;
}

bool is_folder(const fs::path& path) { return type_of(path) == fs::file_type::directory; }

bool is_file(const fs::path& path) { return type_of(path) == fs::file_type::regular; }

bool is_same_file(const fs::path& a, const fs::path& b) {
    if (a.empty() || b.empty()) { return false; }
    std::error_code fault;
    if (fs::equivalent(a, b, fault)) { return true; }
    const fs::path whole_a = fs::weakly_canonical(a, fault);
    if (fault) { return false; }
    const fs::path whole_b = fs::weakly_canonical(b, fault);
    return !fault && whole_a == whole_b;
}

fs::path absolute_path(const fs::path& path) {
    std::error_code fault;
    const fs::path whole = fs::absolute(path, fault);
    return fault ? path : whole.lexically_normal();
}

namespace {

// Of their own, not made of the target's name, which may be as long as names can be.
constexpr std::string_view temporary_start = ".octant-";
constexpr std::string_view temporary_end = ".part";

[[noreturn]] void cannot_write(const std::filesystem::path& path) {
    throw_error_in(path, fmt::format("cannot be written: {}", std::strerror(errno)));
}

bool write_all(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0) {
            if (errno == EINTR) { continue; }
            return false;
        }
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

int create(const std::filesystem::path& path) {
    return ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
}

/// A new file beside `path`, whose name it puts into `target`; -1 and errno where there is none. Another program, in a
/// container of its own perhaps, may have the same number.
int create_beside(const std::filesystem::path& path, std::filesystem::path& target) {
    static std::atomic<unsigned> files = 0; // threads may write the same file at once
    constexpr int max_tries = 100;
    const std::string_view whole = path.native();
    const std::string_view folder = whole.substr(0, whole.find_last_of('/') + 1);
    int descriptor = -1;
    for (int tries = 0; tries < max_tries; ++tries) {
        // As one text: libstdc++'s replace_filename() and operator/= leave a broken path where memory runs out.
        target = fmt::format("{}{}{}-{}{}", folder, temporary_start, ::getpid(), files++, temporary_end);
        descriptor = ::open(target.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
        if (descriptor >= 0 || errno != EEXIST) { break; }
    }
    return descriptor;
}

} // namespace

WholeFile::WholeFile(std::filesystem::path path) : path_(std::move(path)) {
    // A device or a pipe cannot be renamed over; it is written directly.
    const bool special = path_exists(path_) && !is_file(path_);
    descriptor_ = special ? create(path_) : create_beside(path_, temporary_);
    if (descriptor_ < 0) { cannot_write(path_); }
}

WholeFile::~WholeFile() {
    if (descriptor_ >= 0) { ::close(descriptor_); }
    if (!temporary_.empty()) { ::unlink(temporary_.c_str()); }
}

void WholeFile::append(std::string_view bytes) {
    if (!write_all(descriptor_, bytes)) { cannot_write(path_); }
}

void WholeFile::finish() {
    const bool closed = ::close(std::exchange(descriptor_, -1)) == 0;
    if (!closed || (!temporary_.empty() && ::rename(temporary_.c_str(), path_.c_str()) != 0)) { cannot_write(path_); }
    temporary_.clear();
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
    WholeFile file(path);
    file.append(bytes);
    file.finish();
}

bool is_unfinished(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    return name.starts_with(temporary_start) && name.ends_with(temporary_end);
}

void check_can_write(const std::filesystem::path& path) {
    if (is_folder(path)) {
        errno = EISDIR;
        cannot_write(path);
    }
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    if (::access(path_exists(path) ? path.c_str() : folder.c_str(), W_OK) != 0) { cannot_write(path); }
}

void make_folder(const std::filesystem::path& path) {
    std::error_code code;
    std::filesystem::create_directories(path, code);
    if (code || !std::filesystem::is_directory(path, code)) {
        throw_error_in(path,
            fmt::format("expected a folder or a place for one, got: {}", code ? code.message() : "a file is there"));
    }
}

AppendedFile::AppendedFile(std::filesystem::path path, std::string end)
    : path_(std::move(path)), end_(std::move(end)), descriptor_(create(path_)) {
    if (descriptor_ < 0) { cannot_write(path_); }
}

AppendedFile::~AppendedFile() {
    if (descriptor_ >= 0) {
        write_unwritten();
        ::close(descriptor_);
    }
}

void AppendedFile::append(std::string_view text) { unwritten_ += text; }

/// Returns false and sets errno on failure. The end is written by the same call of the system as the text before it, as
/// a kill between two calls would leave a file without its end. Of a text that does not fit (disk full) nothing stays
/// in a file that has an end.
bool AppendedFile::write_unwritten() {
    const std::string bytes = std::exchange(unwritten_, {}) + end_;
    const bool written = write_all(descriptor_, bytes);
    if (end_.empty()) { return written; }
    if (!written) {
        const int write_errno = errno;
        if (::ftruncate(descriptor_, size_) == 0 && ::lseek(descriptor_, size_, SEEK_SET) >= 0) {
            write_all(descriptor_, end_);
        }
        errno = write_errno;
    } else {
        size_ += static_cast<off_t>(bytes.size() - end_.size());
    }
    ::lseek(descriptor_, size_, SEEK_SET);
    return written;
}

void AppendedFile::flush() {
    if (!write_unwritten()) { cannot_write(path_); }
}

} // namespace octant
