#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace octant {

/// What came from outside (file, option, driver) is wrong. Thrown at borders, caught once in main: its text is printed
/// as one line and the program ends with exit code 2.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Throws Error "path:line: what". Lines count from 1. `what` says what was expected and what came.
[[noreturn]] void throw_error_at(const std::filesystem::path& path, int line, const std::string& what);

/// Throws Error "path: what", for a fault that has no line.
[[noreturn]] void throw_error_in(const std::filesystem::path& path, const std::string& what);

/// A text from outside made fit for a one-line message: control characters become '?', and what is longer than 60
/// characters is cut.
std::string printable(const std::string& text);

/// printable() text in single quotes.
std::string in_quotes(std::string_view text);

} // namespace octant
