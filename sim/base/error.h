#pragma once

#include <filesystem>
#include <octant/error.h>
#include <string>
#include <string_view>

namespace octant {

/// Throws Error "path:line: what". Lines count from 1. `what` is "expected ..., got ...".
[[noreturn]] void throw_error_at(const std::filesystem::path& path, int line, const std::string& what);

/// Throws Error "path: what", for a fault that has no line.
[[noreturn]] void throw_error_in(const std::filesystem::path& path, const std::string& what);

/// A text from outside for a one-line message: control characters become '?', and it is cut after 60 characters.
std::string printable(const std::string& text);

/// printable() text in single quotes.
std::string in_quotes(std::string_view text);

} // namespace octant
