#include "sim/base/binary_file.h"

#include "sim/base/hash.h"
#include "sim/base/output_file.h"

namespace octant {

std::size_t BinaryReader::take_count(std::size_t min_bytes, const char* what) {
    const std::size_t at = at_;
    const auto count = take<std::uint64_t>(what);
    if (const std::size_t max = bytes_left() / min_bytes; count > max) {
        refuse_at(at, fmt::format("{} of at most {} times {} bytes", what, max, min_bytes), std::to_string(count));
    }
    return static_cast<std::size_t>(count);
}

std::string_view BinaryReader::take_bytes(std::size_t count, const char* what) {
    if (bytes_left() < count) {
        refuse(fmt::format("{} ({} bytes)", what, count), fmt::format("{} to the end of the file", bytes_left()));
    }
    at_ += count;
    return bytes_.substr(at_ - count, count);
}

void BinaryReader::expect_end() const {
    if (bytes_left() > 0) { refuse("the end of the file", fmt::format("{} more bytes", bytes_left())); }
}

void BinaryReader::refuse_at(std::size_t at, const std::string& expected, const std::string& got) const {
    const std::string what = fmt::format("at byte {}: expected {}, got {}", at, expected, got);
    if (file_.empty()) { throw Error(what); }
    throw_error_in(file_, what);
}

std::string archive_bytes(const ArchiveKind& kind, std::string_view body) {
    BinaryWriter out;
    out.put_bytes(kind.signature);
    out.put(kind.version);
    out.put(std::uint32_t{0});
    out.put(std::uint64_t{body.size()});
    out.put(checksum_of(body));
    out.put_bytes(body);
    return out.bytes();
}

void write_archive(const std::filesystem::path& file, const ArchiveKind& kind, std::string_view body) {
    if (body.size() > kind.max_bytes) {
        throw_error_in(file, fmt::format("expected at most {} bytes, got {}", kind.max_bytes, body.size()));
    }
    write_file(file, archive_bytes(kind, body));
}

BinaryReader archive_body(std::string_view bytes, const std::filesystem::path& file, const ArchiveKind& kind) {
    BinaryReader head(bytes, file);
    if (head.take_bytes(kind.signature.size(), kind.content) != kind.signature) {
        head.refuse_at(0, kind.content, "another file");
    }
    head.archive_version_ = head.take<std::uint32_t>("a version");
    const std::uint32_t oldest = kind.oldest_version == 0 ? kind.version : kind.oldest_version;
    if (head.archive_version_ < oldest || head.archive_version_ > kind.version) {
        head.refuse_at(8,
            oldest == kind.version ? fmt::format("version {}", oldest)
                                   : fmt::format("version {} to {}", oldest, kind.version),
            std::to_string(head.archive_version_));
    }
    if (const auto zero = head.take<std::uint32_t>("a zero"); zero != 0) {
        head.refuse_at(12, "0", std::to_string(zero));
    }
    const auto size = head.take<std::uint64_t>("a size");
    const auto checksum = head.take<std::uint64_t>("a checksum");
    const std::string_view body = bytes.substr(head.at());
    if (size != body.size()) {
        head.refuse_at(16, fmt::format("{} bytes behind the head", body.size()), std::to_string(size));
    }
    if (const std::uint64_t own = checksum_of(body); checksum != own) {
        head.refuse_at(24, fmt::format("the checksum {:016x}", own), fmt::format("{:016x}", checksum));
    }
    return head;
}

void write_cache(const CacheFile& cache, std::string_view result, std::vector<std::string>& notes) {
    BinaryWriter body;
    body.put_text(cache.key);
    body.put_bytes(result);
    try {
        write_archive(cache.file, cache.kind, body.bytes());
    } catch (const Error& fault) { notes.push_back(fmt::format("{} {}: not kept", cache.cache, fault.what())); }
}

namespace {

constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

} // namespace

std::string base64_of(std::string_view bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        const std::size_t count = bytes.size() - at < 3 ? bytes.size() - at : 3;
        std::uint32_t group = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const char byte = i < count ? bytes[at + i] : '\0';
            group = group << 8U | static_cast<unsigned char>(byte);
        }
        for (std::size_t i = 0; i < 4; ++i) { text += i <= count ? base64_digits[group >> (18U - 6U * i) & 63U] : '='; }
    }
    return text;
}

std::optional<std::string> from_base64(std::string_view text) {
    for (int marks = 0; marks < 2 && text.ends_with('='); ++marks) { text.remove_suffix(1); }
    if (text.size() % 4 == 1) { return std::nullopt; }
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t group = 0;
    unsigned bits = 0;
    for (const char c : text) {
        const std::size_t value = base64_digits.find(c);
        if (value == base64_digits.npos) { return std::nullopt; }
        group = group << 6U | static_cast<std::uint32_t>(value);
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes += static_cast<char>(group >> bits & 255U);
        }
    }
    return bytes;
}

} // namespace octant
