#include "ui/base/results_text.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

using octant::ui::base::JsonValue;

namespace {

JsonValue some_figures() {
    JsonValue results;
    results["name"] = "hills";
    results["faces"] = std::size_t{12};
    results["error"] = 0.1234567;
    results["right"] = true;
    results["genus"] = std::optional<int>();
    results["notes"] = std::vector<std::string>{"one", "two"};
    return results;
}

} // namespace

TEST_CASE("figures stand in lines, names in a column and members of lists on lines of their own") {
    CHECK(octant::ui::base::text_of_results(some_figures()) == "name   hills\n"
                                                               "faces  12\n"
                                                               "error  0.123457\n"
                                                               "right  true\n"
                                                               "genus  null\n"
                                                               "one\n"
                                                               "two\n");
}

TEST_CASE("a long text is printed whole, on one line") {
    JsonValue results;
    results["file"] = std::string(100, 'x') + "\nend";
    CHECK(octant::ui::base::text_of_results(results) == "file  " + std::string(100, 'x') + " end\n");
}

TEST_CASE("figures stand in JSON in their order and with all digits") {
    JsonValue results = some_figures();
    results["faces"] = -3; // a figure that is set again keeps its place
    results["ways"] = {{"a", 1.5}, {"b", JsonValue::list({})}};
    CHECK(octant::ui::base::json_of_results(results) == "{\n"
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
    JsonValue results;
    results["mean"] = std::numeric_limits<double>::quiet_NaN();
    results["file"] = "\xff";
    CHECK(octant::ui::base::json_of_results(results) == "{\n  \"mean\": null,\n  \"file\": \"\xEF\xBF\xBD\"\n}\n");
}
