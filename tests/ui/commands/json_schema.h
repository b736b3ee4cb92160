#pragma once

#include "ui/base/json_value.h"

#include <filesystem>
#include <string>
#include <vector>

namespace octant::tests {

/// Where a JSON text is not as a schema has it: "/runs/0/name: expected string"; empty where it is. Knows the words of
/// JSON Schema 2020-12 that the program's schemas use; any other is a fault too.
std::vector<std::string> schema_faults(const std::string& json_text, const std::filesystem::path& schema_file);

/// Checks that a schema file has every property of a row's schema, as the program writes it, in the object at a JSON
/// pointer. With OCTANT_WRITE_SCHEMAS in the environment it is written there first.
void check_row_schema(
    const std::filesystem::path& schema_file, const std::string& pointer, const ui::base::JsonValue& row_schema);

} // namespace octant::tests
