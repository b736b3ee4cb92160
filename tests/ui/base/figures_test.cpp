#include "ui/base/figures_text.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

using octant::ui::base::Figures;

namespace {

Figures some_figures() {
    Figures figures;
    figures["name"] = "hills";
    figures["faces"] = std::size_t{12};
    figures["error"] = 0.1234567;
    figures["right"] = true;
    figures["genus"] = std::optional<int>();
    figures["notes"] = std::vector<std::string>{"one", "two"};
    return figures;
}

} // namespace

TEST_CASE("figures stand in lines, names in a column and members of lists on lines of their own") {
    CHECK(
        octant::ui::base::figures_text(some_figures()) == "name   hills\n"
                                                          "faces  12\n"
                                                          "error  0.123457\n"
                                                          "right  true\n"
                                                          "genus  null\n"
                                                          "one\n"
                                                          "two\n");
}

TEST_CASE("a long text is printed whole, on one line") {
    Figures figures;
    figures["file"] = std::string(100, 'x') + "\nend";
    CHECK(octant::ui::base::figures_text(figures) == "file  " + std::string(100, 'x') + " end\n");
}

TEST_CASE("figures stand in JSON in their order and with all digits") {
    Figures figures = some_figures();
    figures["faces"] = -3; // a figure that is set again keeps its place
    figures["ways"] = {{"a", 1.5}, {"b", Figures::list({})}};
    CHECK(
        octant::ui::base::figures_json(figures) == "{\n"
                                                   "  \"name\": \"hills\",\n"
                                                   "  \"faces\": -3,\n"
                                                   "  \"error\": 0.1234567,\n"
                                                   "  \"right\": true,\n"
                                                   "  \"genus\": null,\n"
                                                   "  \"notes\": [\n"
                                                   "    \"one\",\n"
                                                   "    \"two\"\n"
                                                   "  ],\n"
                                                   "  \"ways\": {\n"
                                                   "    \"a\": 1.5,\n"
                                                   "    \"b\": []\n"
                                                   "  }\n"
                                                   "}\n");
}

TEST_CASE("a figure that is no number and a name that is no text are still JSON") {
    Figures figures;
    figures["mean"] = std::numeric_limits<double>::quiet_NaN();
    figures["file"] = "\xff";
    CHECK(
        octant::ui::base::figures_json(figures) ==
        "{\n  \"mean\": null,\n  \"file\": \"\xEF\xBF\xBD\"\n}\n");
}
