#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace octant::models::meshfile {

/// Words of a text that are parted by blanks and line ends, with the line each stands in.
class WordScanner {
public:
    /// Keeps a view into `text`, whose first line is line `line` of the file.
    WordScanner(const std::filesystem::path& path, std::string_view text, int line)
        : path_(path), text_(text), line_(line) {}

    /// Throws Error at the end of the text; `what` is what it then expected.
    std::string_view word(std::string_view what);

    /// The next word; empty at the end of the text.
    std::string_view word_or_end();

    /// What is left of the line at hand, without blanks at either end; the next word is in the line below.
    std::string_view rest_of_line();

    /// Passes over so many bytes. Throws Error when there are fewer.
    void skip_bytes(std::size_t count, std::string_view what);

    /// The next word as a finite number within max_coordinate. Throws Error.
    double number(std::string_view what);

    /// The next word as a whole number of `least` to `most`. Throws Error.
    long whole(std::string_view what, long least, long most);

    int line() const { return line_; }

    std::size_t bytes_left() const { return text_.size(); }

    [[noreturn]] void refuse(std::string_view expected, std::string_view got) const;

private:
    std::filesystem::path path_;
    std::string_view text_;
    int line_ = 1;
};

/// Text from outside in quotes, fit for a message.
std::string in_quotes(std::string_view text);

} // namespace octant::models::meshfile
