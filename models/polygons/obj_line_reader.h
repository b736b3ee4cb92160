#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace octant::models::polygons {

/// The text behind the three bytes (EF BB BF) that some editors put before UTF-8.
std::string_view without_byte_order_mark(std::string_view text);

/// The lines of an OBJ text. A line that ends in a backslash goes on in the next one, joined by a blank; a comment
/// never does, since a path at its end may well end so. A byte order mark before the first line is no part of it.
class ObjLineReader {
public:
    /// Keeps views into `text`.
    explicit ObjLineReader(std::string_view text);

    /// Goes to the next line; false when there is none.
    bool next();

    /// The line that next() went to; valid until its next call.
    std::string_view text() const { return text_; }

    /// Where the line begins in the file, from 1.
    int number() const { return number_; }

private:
    std::string_view next_line();

    std::string_view rest_; ///< what lies behind the lines so far
    std::string joined_;
    std::string_view text_;
    int number_ = 0;
    int lines_ = 0; ///< so far
};

/// What follows the first word of a line, without blanks at either end: names in OBJ and MTL files may have blanks
/// inside. A view into `line`.
std::string_view after_first_word(std::string_view line);

/// A finite number within max_obj_coordinate_m (obj_limits.h). Throws Error "file:line: ...".
double obj_number(std::string_view word, const std::filesystem::path& path, int line);

} // namespace octant::models::polygons
