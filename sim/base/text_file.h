#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant {

/// The whole file as bytes. Throws Error when it is missing, no regular file, unreadable or larger
/// than `largest_bytes`; the message names the file and says which.
std::string
read_file(const std::filesystem::path& path, std::size_t largest_bytes = std::size_t{256} << 20);

/// read_file for text: also refuses a file with a zero byte ("expected text, got binary data").
std::string read_text_file(
    const std::filesystem::path& path, std::size_t largest_bytes = std::size_t{256} << 20);

/// The lines of a text without their line ends (LF or CRLF). Views into `text`.
std::vector<std::string_view> split_lines(std::string_view text);

/// Words separated by blanks or tabs. Views into `line`.
std::vector<std::string_view> split_words(std::string_view line);

/// Fields separated by `separator`, blanks around them removed. Views into `line`.
std::vector<std::string_view> split_fields(std::string_view line, char separator);

/// What a file's name ends in from its last dot on, in small letters: ".obj"; empty without one.
std::string ending_of(const std::filesystem::path& path);

/// The whole of `text` as a finite decimal number in the C locale; nothing for anything else
/// (NaN and infinity too).
std::optional<double> finite_number(std::string_view text);

/// The whole of `text` as a decimal integer; nothing for anything else or out of range.
std::optional<long> whole_number(std::string_view text);

} // namespace octant
