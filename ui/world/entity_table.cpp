#include "ui/world/entity_table.h"

#include "flightpaths/toml_fields.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/base/data_files.h"

#include <fmt/format.h>
#include <limits>

namespace octant::ui::world {

namespace {

constexpr std::size_t max_aircraft = 256;

/// Throws Error with the line, which is known here alone, for an aircraft that is none.
void check_aircraft(const flightpaths::TomlFields& fields, const std::string& aircraft) {
    try {
        base::aircraft_file(aircraft);
    } catch (const Error& fault) { fields.refuse(fields.line(), fault.what()); }
}

void take_entity(const std::filesystem::path& file, const toml::node& node, EntityTable& table) {
    const toml::table& keys = *node.as_table();
    flightpaths::TomlFields fields(file, keys);
    const int type = fields.required_integer("type", 0, std::numeric_limits<std::uint16_t>::max());
    const std::string aircraft = fields.required_text("aircraft");
    check_aircraft(fields, aircraft);
    const int count = keys.contains("count") ? fields.required_integer("count", 1, static_cast<int>(max_aircraft)) : 1;
    fields.finish();
    if (!table.types.emplace(static_cast<std::uint16_t>(type), table.aircraft.size()).second) {
        fields.refuse(fields.line(), fmt::format("expected each type once, got {} again", type));
    }
    table.aircraft.insert(table.aircraft.end(), static_cast<std::size_t>(count), aircraft);
    if (table.aircraft.size() > max_aircraft) {
        fields.refuse(fields.line(), fmt::format("expected {} aircraft at most, got more", max_aircraft));
    }
}

} // namespace

EntityTable read_entity_table(const std::filesystem::path& file) {
    const toml::table root = flightpaths::parse_toml(file, read_text_file(file, std::size_t{1} << 20U));
    flightpaths::TomlFields fields(file, root);
    EntityTable table;
    for (const toml::node& node : fields.required_tables("entity")) { take_entity(file, node, table); }
    fields.finish();
    return table;
}

} // namespace octant::ui::world
