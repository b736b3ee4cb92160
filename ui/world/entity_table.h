#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace octant::ui::world {

/// Which aircraft a CIGI host means by the types of its entities.
struct EntityTable {
    /// All that are loaded, as --aircraft takes them.
    std::vector<std::string> aircraft;
    /// An index into `aircraft` for each type.
    std::map<std::uint16_t, std::size_t> types;
};

/// Reads a TOML file of tables [[entity]], each with `type` (a number from 0 to 65535), `aircraft` (a name or a file)
/// and `count`, how many of them are seen at a time (1 unless said). The first one's aircraft comes first. Throws Error
/// with file and line: other keys, a type that stands there twice, more than 256 aircraft.
EntityTable read_entity_table(const std::filesystem::path& file);

} // namespace octant::ui::world
