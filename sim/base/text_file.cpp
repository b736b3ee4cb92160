#include "sim/base/text_file.h"

#include "sim/base/error.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <fstream>

namespace octant {

std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(0);
    std::size_t length = 0;
    if (first < 0x80) { return 1; }
    if (first >= 0xC2 && first < 0xE0) {
        length = 2;
    } else if (first >= 0xE0 && first < 0xF0) {
        length = 3;
    } else if (first >= 0xF0 && first < 0xF5) {
        length = 4;
    }
    if (length == 0 || text.size() < length) { return 0; }
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0U) != 0x80U) { return 0; }
    }
    // Overlong forms, surrogates and what lies beyond U+10FFFF are no characters.
    const unsigned second = byte(1);
    const bool bad = (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
                     (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F);
    return bad ? 0 : length;
}

std::string one_line(std::string_view text) {
    std::string line;
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        const auto first = static_cast<unsigned char>(text.front());
        // U+0080 to U+009F are control characters too, some of which begin sequences.
        const bool second_block = length == 2 && first == 0xC2 && static_cast<unsigned char>(text[1]) < 0xA0;
        if (first == '\n' || first == '\r' || first == '\t') {
            line += ' ';
        } else if (length == 0 || first < 0x20 || first == 0x7F || second_block) {
            line += '?';
        } else {
            line += text.substr(0, length);
        }
        text.remove_prefix(length == 0 ? 1 : length);
    }
    return line;
}

std::ifstream open_file(const std::filesystem::path& path) {
    std::error_code code;
    const auto status = std::filesystem::status(path, code);
    if (!std::filesystem::exists(status)) {
        throw_error_in(path, code && code.value() != ENOENT ? code.message() : "expected a file, found none");
    }
    if (std::filesystem::is_directory(status)) { throw_error_in(path, "expected a file, got a folder"); }
    if (!std::filesystem::is_regular_file(status)) {
        throw_error_in(path, "expected a regular file, got a device or pipe");
    }
    std::ifstream in(path, std::ios::binary);
    if (!in) { throw_error_in(path, fmt::format("cannot be opened for reading: {}", std::strerror(errno))); }
    return in;
}

std::string read_file(const std::filesystem::path& path, std::size_t largest_bytes) {
    std::ifstream in = open_file(path);
    std::error_code code;
    const auto size = std::filesystem::file_size(path, code);
    const auto refuse_size = [&] {
        throw_error_in(path, fmt::format("expected at most {} bytes, got more", largest_bytes));
    };
    if (!code && size > largest_bytes) { refuse_size(); }
    // Read in pieces: a file that grows meanwhile costs no more memory than the largest allowed.
    std::string bytes;
    std::string piece(std::size_t{1} << 16, '\0');
    while (in) {
        in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        bytes.append(piece, 0, static_cast<std::size_t>(in.gcount()));
        if (bytes.size() > largest_bytes) { refuse_size(); }
    }
    if (in.bad()) { throw_error_in(path, "cannot be read to its end"); }
    return bytes;
}

std::string read_text_file(const std::filesystem::path& path, std::size_t largest_bytes) {
    std::string text = read_file(path, largest_bytes);
    if (text.find('\0') != std::string::npos) { throw_error_in(path, "expected text, got binary data"); }
    return text;
}

std::vector<std::string_view> split_lines(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        if (!line.empty() && line.back() == '\r') { line.remove_suffix(1); }
        lines.push_back(line);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    return lines;
}

std::vector<std::string_view> split_words(std::string_view line) {
    constexpr std::string_view blanks = " \t\r";
    std::vector<std::string_view> words;
    std::size_t at = line.find_first_not_of(blanks);
    while (at != std::string_view::npos) {
        const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
        words.push_back(line.substr(at, end - at));
        at = line.find_first_not_of(blanks, end);
    }
    return words;
}

std::vector<std::string_view> split_fields(std::string_view line, char separator) {
    constexpr std::string_view blanks = " \t\r";
    std::vector<std::string_view> fields;
    std::size_t at = 0;
    while (true) {
        const std::size_t end = std::min(line.find(separator, at), line.size());
        std::string_view field = line.substr(at, end - at);
        field.remove_prefix(std::min(field.find_first_not_of(blanks), field.size()));
        field = field.substr(0, field.find_last_not_of(blanks) + 1);
        fields.push_back(field);
        if (end == line.size()) { return fields; }
        at = end + 1;
    }
}

std::string extension_of(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::ranges::transform(
        ending, ending.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return ending;
}

std::optional<double> finite_number(std::string_view text) {
    if (!text.empty() && text.front() == '+') { text.remove_prefix(1); }
    double value = 0.0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) { return std::nullopt; }
    return value;
}

std::optional<long> whole_number(std::string_view text) {
    long value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size()) { return std::nullopt; }
    return value;
}

} // namespace octant
