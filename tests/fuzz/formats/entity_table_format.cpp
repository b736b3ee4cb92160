#include "tests/fuzz/formats/target.h"
#include "ui/world/entity_table.h"

namespace octant::tests::formats::entity_table_format {

namespace {

void use(const std::filesystem::path& file) {
    const ui::world::EntityTable table = ui::world::read_entity_table(file);
    expect(!table.aircraft.empty() && table.aircraft.size() <= 256, "some aircraft");
    for (const auto& [type, aircraft] : table.types) {
        expect(aircraft < table.aircraft.size(), "an aircraft for each type");
    }
}

const Registered target({
    .name = "entity_table",
    .file = "input.toml",
    .use = use,
    .seeds =
        [] {
            return std::vector<std::string>{
                "[[entity]]\ntype = 1\naircraft = \"f15\"\n[[entity]]\ntype = 9\naircraft = "
                "\"my-helicopter.obj\"\ncount = 4\n"};
        },
    .words = {"[[entity]]\n", "[entity]\n", "type = ", "aircraft = ", "count = ", "65535", "256", "\"\"", "[1]", "inf",
        "true"},
});

} // namespace

} // namespace octant::tests::formats::entity_table_format
