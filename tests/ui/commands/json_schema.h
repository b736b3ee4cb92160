#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace octant::tests {

/// Where a JSON text is not as a schema has it: "/runs/0/name: expected string"; empty where it is. Knows the words of
/// JSON Schema 2020-12 that the program's schemas use; any other is a fault too.
std::vector<std::string> schema_faults(const std::string& json_text, const std::filesystem::path& schema_file);

} // namespace octant::tests
