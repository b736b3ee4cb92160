#include "sim/base/output_file.h"
#include "tests/scratch.h"
#include "ui/world/entity_table.h"

#include <catch2/catch.hpp>

#include <string>

using namespace octant;

namespace {

ui::world::EntityTable table_of(const std::string& text) {
    const std::filesystem::path file = tests::scratch_folder() / "entities.toml";
    write_file(file, text);
    return ui::world::read_entity_table(file);
}

} // namespace

TEST_CASE("an entity table lists its aircraft, as many of each as it says") {
    const ui::world::EntityTable table = table_of("[[entity]]\ntype = 7\naircraft = \"f15\"\ncount = 2\n"
                                                  "[[entity]]\ntype = 65535\naircraft = \"500md\"\n");
    CHECK(table.aircraft == std::vector<std::string>{"f15", "f15", "500md"});
    CHECK(table.types == std::map<std::uint16_t, std::size_t>{{7, 0}, {65535, 2}});
}

TEST_CASE("an entity table that is wrong is refused with its line") {
    const auto refused = [](const std::string& text, const std::string& expected) {
        CHECK_THROWS_WITH(table_of(text), Catch::Contains("entities.toml:" + expected));
    };
    refused("[[entity]]\ntype = 65536\naircraft = \"f15\"\n", "2: expected type");
    refused("[[entity]]\ntype = 1\n", "1: expected");
    refused("[[entity]]\ntype = 1\naircraft = \"f15\"\n[[entity]]\ntype = 2\naircraft = \"f16\"\n",
        "4: aircraft: expected f15, 500md");
    refused("[[entity]]\ntype = 1\naircraft = \"f15\"\ncolour = 1\n", "4: ");
    refused("[[entity]]\ntype = 1\naircraft = \"f15\"\n[[entity]]\ntype = 1\naircraft = \"500md\"\n",
        "4: expected each type once, got 1 again");
    refused("[[entity]]\ntype = 1\naircraft = \"f15\"\ncount = 256\n"
            "[[entity]]\ntype = 2\naircraft = \"f15\"\n",
        "5: expected 256 aircraft at most, got more");
    refused("[[entity]\n", "1: expected TOML");
    refused("[[^]", "1: expected TOML");
    refused("", "1: expected");
    refused("entity = [3]\n", "1: expected");
}
