#pragma once

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

namespace octant {

static_assert(std::endian::native == std::endian::little, "values are written as they are in memory");

/// The value that begins at `bytes`, where sizeof(Value) bytes must be readable.
template <class Value>
Value value_at(const char* bytes, std::endian order = std::endian::little) {
    static_assert(std::is_trivially_copyable_v<Value>);
    std::array<char, sizeof(Value)> own;
    std::memcpy(own.data(), bytes, own.size());
    if (order == std::endian::big) { std::ranges::reverse(own); }
    return std::bit_cast<Value>(own);
}

/// Appends values to a string of bytes, little endian. Values must have no padding, so that equal ones give equal
/// bytes.
class BinaryWriter {
public:
    template <class Value>
    void put(const Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }

    /// The number of elements (64 bits) and the elements.
    template <class List>
    void put_list(const List& list) {
        static_assert(std::is_trivially_copyable_v<std::remove_cvref_t<decltype(*list.data())>>);
        put(std::uint64_t{list.size()});
        if (!list.empty()) {
            bytes_.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(*list.data()));
        }
    }

    void put_text(std::string_view text) { put_list(text); }

    /// Bytes without their number.
    void put_bytes(std::string_view bytes) { bytes_ += bytes; }

    const std::string& bytes() const { return bytes_; }

    std::size_t size() const { return bytes_.size(); }

    /// Moves the bytes out.
    std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
};

/// Reads values front to back from bytes that may be anything. Throws Error "file: at byte N: expected ..., got ..."
/// where the bytes end too soon; `what` names the value in that message. The bytes must outlive the reader.
class BinaryReader {
public:
    /// Starts at byte `at`. `file` is for messages; empty = none.
    explicit BinaryReader(std::string_view bytes, std::filesystem::path file = {}, std::size_t at = 0,
        std::endian order = std::endian::little)
        : file_(std::move(file)), bytes_(bytes), at_(at), order_(order) {}

    /// The number of the next byte.
    std::size_t at() const { return at_; }

    std::size_t bytes_left() const { return bytes_.size() - at_; }

    /// The version of the archive whose body this reads; 0 for other bytes.
    std::uint32_t archive_version() const { return archive_version_; }

    template <class Value>
    Value take(const char* what = "a number") {
        return value_at<Value>(take_bytes(sizeof(Value), what).data(), order_);
    }

    /// A list that put_list wrote. Allocates no more than there are bytes left.
    template <class Value>
    std::vector<Value> take_list(const char* what = "a list") {
        std::vector<Value> list(take_count(sizeof(Value), what));
        const std::string_view bytes = take_bytes(list.size() * sizeof(Value), what);
        if (!bytes.empty()) { std::memcpy(list.data(), bytes.data(), bytes.size()); }
        return list;
    }

    /// A text that put_text wrote, as a view of the bytes.
    std::string_view take_text(const char* what = "a text") { return take_bytes(take_count(1, what), what); }

    /// The 64-bit number of elements of at least `min_bytes` each. Throws Error if the bytes left are fewer.
    std::size_t take_count(std::size_t min_bytes, const char* what);

    std::string_view take_bytes(std::size_t count, const char* what);

    /// Throws Error "... expected {what} before, got something else" unless `good`, a condition on values read.
    void check(bool good, const char* what) const {
        if (!good) { refuse(fmt::format("{} before", what), "something else"); }
    }

    /// Throws Error unless all bytes were taken.
    void expect_end() const;

    /// Throws Error "file: at byte N: expected ..., got ...", where N is the next byte or `at`.
    [[noreturn]] void refuse(const std::string& expected, const std::string& got) const {
        refuse_at(at_, expected, got);
    }

    [[noreturn]] void refuse_at(std::size_t at, const std::string& expected, const std::string& got) const;

private:
    friend BinaryReader archive_body(
        std::string_view bytes, const std::filesystem::path& file, const struct ArchiveKind& kind);

    std::filesystem::path file_;
    std::string_view bytes_;
    std::size_t at_ = 0;
    std::uint32_t archive_version_ = 0;
    std::endian order_ = std::endian::little;
};

// An archive is a file of one kind: signature (8 bytes), version (4), 0 (4), size of the body (8), checksum of the body
// (8; sim/base/hash.h), body.

/// One kind of archive.
struct ArchiveKind {
    const char* content = "";                      ///< In messages: "a chain of levels".
    std::string_view signature;                    ///< 8 characters.
    std::uint32_t version = 1;                     ///< Raised when the same content gives another body.
    std::uint32_t oldest_version = 0;              ///< Of the versions that are read; 0: `version` alone.
    std::size_t max_bytes = std::size_t{1} << 30U; ///< Larger bodies are neither written nor read.
};

/// The size of an archive before its body.
constexpr std::size_t archive_head_bytes = 32;

/// The bytes of an archive with this body.
std::string archive_bytes(const ArchiveKind& kind, std::string_view body);

/// Writes the whole archive or nothing (write_file). Throws Error.
void write_archive(const std::filesystem::path& file, const ArchiveKind& kind, std::string_view body);

/// A reader at the body of an archive's bytes. Throws Error for another kind, version, size or checksum.
BinaryReader archive_body(std::string_view bytes, const std::filesystem::path& file, const ArchiveKind& kind);

/// The result of decode(BinaryReader&) for the body, which it must read to the end. Throws Error as archive_body and
/// `decode` do.
template <class Decode>
auto read_archive(const std::filesystem::path& file, const ArchiveKind& kind, const Decode& decode) {
    const std::string bytes = read_file(file, kind.max_bytes);
    BinaryReader body = archive_body(bytes, file, kind);
    auto content = decode(body);
    body.expect_end();
    return content;
}

/// A result that is cached in a file: an archive whose body begins with a key.
struct CacheFile {
    std::string_view cache; ///< In notes: "order cache".
    std::filesystem::path file;
    ArchiveKind kind;
    std::string_view key; ///< everything that determines the result
};

/// The result of decode(BinaryReader&) for a cached result. Nothing if there is no file; nothing and a note "order
/// cache FILE: at byte N: expected ..., got ...: computed anew" if the file is damaged, of another version or of
/// another key.
template <class Decode>
auto read_cache(const CacheFile& cache, const Decode& decode, std::vector<std::string>& notes) {
    std::optional<decltype(decode(std::declval<BinaryReader&>()))> result;
    std::error_code ignored;
    if (!std::filesystem::exists(cache.file, ignored)) { return result; }
    try {
        result = read_archive(cache.file, cache.kind, [&](BinaryReader& body) {
            if (body.take_text("a key") != cache.key) { body.refuse("the key of this input", "that of another one"); }
            return decode(body);
        });
    } catch (const Error& fault) { notes.push_back(fmt::format("{} {}: computed anew", cache.cache, fault.what())); }
    return result;
}

/// Writes a result to its file; a note "order cache FILE: ...: not kept" if that is not possible.
void write_cache(const CacheFile& cache, std::string_view result, std::vector<std::string>& notes);

/// Bytes as base64 with padding (RFC 4648).
std::string base64_of(std::string_view bytes);

/// The bytes of base64, with or without padding. Nothing for invalid text.
std::optional<std::string> from_base64(std::string_view text);

} // namespace octant
