#include "ui/report/html_text.h"

#include <catch2/catch.hpp>

using namespace octant;

namespace {

const ui::report::HtmlTable table{"Speed", {"name", "ms, median"}, {{"a", "1.5"}, {"b, c", ""}}, "measured"};

} // namespace

TEST_CASE("a table is written as CSV, Markdown and JSON") {
    CHECK(ui::report::csv_of(table) == "name,\"ms, median\"\na,1.5\n\"b, c\",\n");
    CHECK(ui::report::markdown_of(table) ==
          "# Speed\n\n| name | ms, median |\n| --- | --- |\n| a | 1.5 |\n| b, c |  |\n\nmeasured\n");
    const std::string json = ui::report::json_of(std::span(&table, 1));
    CHECK(json.find("\"ms, median\": 1.5") != std::string::npos);
    CHECK(json.find("\"name\": \"b, c\"") != std::string::npos);
}
