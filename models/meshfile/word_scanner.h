#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace octant::models::meshfile {

/// Reads the words of a text, which blanks and line ends separate, and counts lines.
class WordScanner {
public:
    /// Keeps a view into `text`. Its first line is line `line` of the file.
    WordScanner(const std::filesystem::path& path, std::string_view text, int line)
        : path_(path), text_(text), line_(line) {}

    /// Reads the next word. Throws Error at the end of the text; `what` names the expected word.
    std::string_view word(std::string_view what);

    /// Reads the next word; empty at the end of the text.
    std::string_view word_or_end();

    /// Reads the rest of the current line without blanks at either end. The next word is on a later line.
    std::string_view rest_of_line();

    /// Skips `count` bytes. Throws Error if there are fewer.
    void skip_bytes(std::size_t count, std::string_view what);

    /// Reads a finite number within max_coordinate. Throws Error.
    double number(std::string_view what);

    /// Reads an integer from `min` to `max`. Throws Error.
    long whole(std::string_view what, long min, long max);

    int line() const { return line_; }

    std::size_t bytes_left() const { return text_.size(); }

    [[noreturn]] void refuse(std::string_view expected, std::string_view got) const;

private:
    std::filesystem::path path_;
    std::string_view text_;
    int line_ = 1;
};

/// Quotes text from outside for a message: one line, printable, shortened.
std::string in_quotes(std::string_view text);

} // namespace octant::models::meshfile
