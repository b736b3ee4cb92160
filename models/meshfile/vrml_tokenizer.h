#pragma once

#include <filesystem>
#include <string_view>

namespace octant::models::meshfile {

/// The words, brackets, braces and strings of a VRML text, without blanks, commas and comments.
class VrmlTokenizer {
public:
    /// Keeps references to both; the text begins in line `line` of the file.
    VrmlTokenizer(const std::filesystem::path& path, std::string_view text, int line)
        : path_(&path)
        , text_(text)
        , line_(line) {}

    /// The next word, a string with its quotes; empty at the end.
    std::string_view peek();

    /// The same, and goes on behind it. Throws Error at the end.
    std::string_view take(std::string_view what);

    /// The next word as a finite number within max_coordinate. Throws Error.
    double number(std::string_view what);

    /// The next word as a whole number. Throws Error.
    long whole(std::string_view what);

    /// Whether the word is a bracket or a brace.
    static bool is_punctuation(std::string_view word);

    /// The line of the word that peek gave last.
    int line() const { return line_; }

    /// Byte of the text at which the next word, or what is before it, begins.
    std::size_t at() const { return at_; }

    std::string_view text() const { return text_; }

    [[noreturn]] void refuse(std::string_view expected, std::string_view got) const;

private:
    void skip_blanks();

    const std::filesystem::path* path_;
    std::string_view text_;
    std::size_t at_ = 0;
    int line_ = 1;
};

} // namespace octant::models::meshfile
