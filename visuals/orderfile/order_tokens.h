#pragma once

#include "models/polygons/file_axes.h"
#include "sim/base/plane.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace octant::visuals::orderfile {

/// The words of a file of orders, line by line, and what they may stand for. What is read is left
/// behind; a word that is wrong is refused with an Error that names file, line, what was expected
/// and what was found.
class OrderTokens {
public:
    OrderTokens(const std::filesystem::path& path, const models::polygons::FileAxes& axes)
        : path_(path)
        , axes_(axes) {}

    /// Goes to the next line of the file, of which a comment after # does not count. The text must
    /// outlive the work on the line.
    void begin_line(std::string_view text);

    /// The words of the line with one space between them.
    std::string line() const;

    bool has_more() const { return at_ < words_.size(); }

    /// The next word, which must be there.
    std::string_view peek() const { return words_[at_]; }

    void advance() { ++at_; }

    /// Goes back to the word before, to refuse it.
    void back() { --at_; }

    void rewind() { at_ = 0; }

    /// Throws Error about the next word.
    [[noreturn]] void refuse(const std::string& expected) const;

    bool next_is(std::string_view word) const { return has_more() && peek() == word; }

    /// Reads that word where it comes next; returns whether it did.
    bool skip(std::string_view word);

    double number(const char* what);

    /// A number that must not be negative.
    double min_zero(const char* what);

    /// A whole number within limits.
    long count(const char* what, long least, long most);

    /// Three numbers: a vector in body axes.
    glm::dvec3 vector(const char* what);

    /// A vector that must not be zero.
    glm::dvec3 nonzero_vector(const char* what);

    /// A plane with a normal of any length.
    Plane plane();

private:
    std::filesystem::path path_;
    models::polygons::FileAxes axes_;
    std::vector<std::string_view> words_;
    std::size_t at_ = 0;
    int line_ = 0;
};

} // namespace octant::visuals::orderfile
