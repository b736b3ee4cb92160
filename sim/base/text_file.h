#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant {

/// Bytes of the UTF-8 character that `text` (not empty) starts with, 0 when it starts with none.
std::size_t utf8_length(std::string_view text);

/// A text of any origin, such as a file name, as one line that is safe to print on a terminal: line ends and tabs
/// become blanks; other control characters, and bytes that are not UTF-8, become '?'.
std::string one_line(std::string_view text);

/// The whole file as bytes. Throws Error when it is missing, no regular file, unreadable or larger than
/// `largest_bytes`; the message names the file and says which.
std::string read_file(const std::filesystem::path& path, std::size_t largest_bytes = std::size_t{256} << 20);

/// read_file for text: also refuses a file with a zero byte ("expected text, got binary data").
std::string read_text_file(const std::filesystem::path& path, std::size_t largest_bytes = std::size_t{256} << 20);

/// Opens a file for reading. Throws Error if it is no regular file or cannot be read.
std::ifstream open_file(const std::filesystem::path& path);

/// The lines of a text without their line ends (LF or CRLF). Views into `text`.
std::vector<std::string_view> split_lines(std::string_view text);

/// Words separated by blanks or tabs. Views into `line`.
std::vector<std::string_view> split_words(std::string_view line);

/// Fields separated by `separator`, blanks around them removed. Views into `line`.
std::vector<std::string_view> split_fields(std::string_view line, char separator);

/// The extension of a file's name with its dot, in lower case: ".obj"; empty without one.
std::string extension_of(const std::filesystem::path& path);

/// The whole of `text` as a finite decimal number in the C locale; nothing for any other text, NaN and infinity too.
std::optional<double> finite_number(std::string_view text);

/// The whole of `text` as a decimal integer; nothing for any other text or out of range.
std::optional<long> whole_number(std::string_view text);

} // namespace octant
