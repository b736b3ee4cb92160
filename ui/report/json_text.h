#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace octant::ui::report {

/// JSON text from outside, names in their order. `path` is only named in errors. Throws Error "file:line: ..." for what
/// is no JSON, for numbers that no double holds and for more than 64 levels of nesting (deeper ones would exhaust the
/// stack of whoever walks over them).
nlohmann::ordered_json parsed_json(const std::filesystem::path& path, const std::string& text);

/// Line, from 1, of a byte of a text.
int line_of_byte(const std::string& text, std::size_t byte);

} // namespace octant::ui::report
