#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace octant::visuals::terrain {

/// A file whose content lies in memory, shared with whoever else maps or writes it.
class MappedFile {
public:
    enum class Access { Read, ReadAndWrite };

    /// Maps all of a regular file. To write it locks the file against other writers (not readers),
    /// where the file system can. Throws Error when that is not possible.
    MappedFile(std::filesystem::path path, Access access);

    /// Creates or empties a file of `size` bytes, its room on the disk taken where the file system
    /// can, and maps it to read and write, locked as above. Throws Error (no permission, disk
    /// full, locked by another: then the file stays as it is).
    MappedFile(std::filesystem::path path, std::size_t size);

    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;
    MappedFile(MappedFile&&) = delete;
    MappedFile& operator=(MappedFile&&) = delete;

    std::span<const std::byte> bytes() const { return {start_, size_}; }

    /// Of a file that may be written.
    std::span<std::byte> bytes() { return {start_, size_}; }

    /// Writes without faulting pages in one by one; bytes() shows it at once. Several threads may.
    /// Throws Error (disk full).
    void write(std::size_t offset, std::span<const std::byte> bytes);

    /// Brings all that was written to the disk. Throws Error.
    void sync();

    /// Cuts the file; the bytes beyond must not be read any more. Throws Error.
    void cut(std::size_t size);

private:
    void map(int protection);

    std::filesystem::path path_;
    int descriptor_ = -1;
    std::byte* start_ = nullptr;
    std::size_t size_ = 0;
};

/// Brings the names in a file's folder to the disk, where the file system can. Throws Error.
void sync_folder_of(const std::filesystem::path& path);

} // namespace octant::visuals::terrain
