#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace octant::visuals::groundfile {

/// A file whose content is mapped into memory, shared with whoever else maps or writes it.
class MappedFile {
public:
    enum class Access {
        Read,
        CopyOnWrite, ///< What writable_copy() gives may be changed in memory; the file stays as it is.
        ReadWrite
    };

    /// Maps a whole regular file. For writing it locks the file against other writers (not readers), where the file
    /// system can. Throws Error when that is not possible.
    MappedFile(std::filesystem::path path, Access access);

    /// Creates or empties a file of `size` bytes, allocates its space on the disk where the file system can, and maps
    /// it for reading and writing, locked as above. Throws Error (no permission, disk full, or locked by another; then
    /// the file stays as it is).
    MappedFile(std::filesystem::path path, std::size_t size);

    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;
    MappedFile(MappedFile&&) = delete;
    MappedFile& operator=(MappedFile&&) = delete;

    std::span<const std::byte> bytes() const { return {start_, size_}; }

    /// The content of a file that may be written.
    std::span<std::byte> bytes() { return {start_, size_}; }

    /// Writes without faulting pages in one by one; bytes() shows it at once. Several threads may write. Throws Error
    /// (disk full).
    void write(std::size_t offset, std::span<const std::byte> bytes);

    /// Some bytes of a file that was mapped with CopyOnWrite, to be changed in memory alone. Throws Error (no memory).
    std::span<std::byte> writable_copy(std::size_t offset, std::size_t size);

    /// Brings everything that was written to the disk. Throws Error.
    void sync();

    /// After sync(): has what is read next come from the disk, where the file system can.
    void drop_cached_pages();

    /// Truncates the file; the bytes beyond must not be read any more. Throws Error.
    void truncate(std::size_t size);

private:
    /// Opens the file. Throws Error "cannot be {purpose}".
    MappedFile(std::filesystem::path path, int flags, const char* purpose);
    void map(int protection, bool shared);

    std::filesystem::path path_;
    int descriptor_ = -1;
    std::byte* start_ = nullptr;
    std::size_t size_ = 0;
};

/// Brings the entries of a file's folder to the disk, where the file system can. Throws Error.
void sync_folder_of(const std::filesystem::path& path);

} // namespace octant::visuals::groundfile
