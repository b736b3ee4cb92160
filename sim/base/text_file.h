#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant {

/// The whole file as bytes. Throws Error when it is missing, no regular file, unreadable or larger than
/// `largest_bytes`; the message names the file and says which.
std::string read_file(const std::filesystem::path& path, std::size_t largest_bytes = std::size_t{256} << 20);

/// read_file for text: also refuses a file with a zero byte ("expected text, got binary data").
std::string read_text_file(const std::filesystem::path& path, std::size_t largest_bytes = std::size_t{256} << 20);

/// The lines of a text file one after the other, in the memory of one of them.
class LineReader {
public:
    /// Throws Error for what is no regular file that can be read.
    explicit LineReader(const std::filesystem::path& path);

    /// The next line without its line end (LF or CRLF), valid until the next call; nothing at the end. Throws Error for
    /// a zero byte and for a line of more than 65,535 bytes.
    std::optional<std::string_view> next();

    /// Number of the line that next() gave, from 1.
    int number() const { return number_; }

    /// True when that line is the file's last and has no line end.
    bool is_truncated() const { return is_truncated_; }

private:
    std::filesystem::path path_;
    std::ifstream in_;
    std::string line_;
    int number_ = 0;
    bool is_truncated_ = false;
};

/// The lines of a text without their line ends (LF or CRLF). Views into `text`.
std::vector<std::string_view> split_lines(std::string_view text);

/// Words separated by blanks or tabs. Views into `line`.
std::vector<std::string_view> split_words(std::string_view line);

/// Fields separated by `separator`, blanks around them removed. Views into `line`.
std::vector<std::string_view> split_fields(std::string_view line, char separator);

/// What a file's name ends in from its last dot on, in small letters: ".obj"; empty without one.
std::string extension_of(const std::filesystem::path& path);

/// The whole of `text` as a finite decimal number in the C locale; nothing for anything else (NaN and infinity too).
std::optional<double> finite_number(std::string_view text);

/// The whole of `text` as a decimal integer; nothing for anything else or out of range.
std::optional<long> whole_number(std::string_view text);

} // namespace octant
