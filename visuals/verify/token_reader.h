#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::visuals::verify {

/// The words of one line of a file after another. Whatever is not as expected is refused by an
/// Error "file:line: expected ..., got ...".
class TokenReader {
public:
    explicit TokenReader(std::filesystem::path path)
        : path_(std::move(path)) {}

    /// Goes on to the next line, of which what follows a # does not count; false if it is empty.
    bool set_line(std::string_view line);

    /// The number of the line at hand, from 1.
    int line() const { return line_; }

    bool done() const { return at_ == words_.size(); }

    /// Throws Error about the word at hand.
    [[noreturn]] void refuse(const std::string& expected) const;

    /// Throws Error about the word before it.
    [[noreturn]] void fail_at_last(const std::string& expected);

    /// Takes a word if it is the one at hand.
    bool skip(std::string_view word);

    std::string_view word(std::string_view what);
    double number(std::string_view what, double least, double most);
    /// A whole number from 0 to below `end`.
    std::uint32_t index(std::string_view what, std::size_t end);
    void end_of_line() const;

private:
    std::filesystem::path path_;
    std::vector<std::string_view> words_;
    std::size_t at_ = 0;
    int line_ = 0;
};

} // namespace octant::visuals::verify
