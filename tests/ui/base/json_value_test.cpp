#include "ui/base/json_value.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

using namespace octant::ui::base;

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
    CHECK(text_of_results(some_figures()) == "name   hills\n"
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
    CHECK(text_of_results(results) == "file  " + std::string(100, 'x') + " end\n");
}

TEST_CASE("figures stand in JSON in their order and with all digits") {
    JsonValue results = some_figures();
    results["faces"] = -3; // a figure that is set again keeps its place
    results["ways"] = {{"a", 1.5}, {"b", JsonValue::list({})}};
    CHECK(json_of_results(results) == "{\n"
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
    CHECK(json_of_results(results) == "{\n  \"mean\": null,\n  \"file\": \"\xEF\xBF\xBD\"\n}\n");
}

TEST_CASE("names that are UTF-8 stay as they are in JSON, others come back byte for byte") {
    for (const std::string name : {"caf\xc3\xa9 100%.csv", "plain", ""}) {
        CHECK(json_from_file_name(name) == name);
        CHECK(file_name_from_json(name) == name);
    }
    CHECK(json_from_file_name("caf\xe9 5%.csv") == "bytes:caf%E9 5%25.csv");
    for (const std::string name : {"caf\xe9 5%.csv", "\xff\xfe", "bytes:plain%41", "bytes:"}) {
        CHECK(file_name_from_json(json_from_file_name(name)) == name);
    }
    CHECK(file_name_from_json("bytes:50%") == "50%");
    CHECK(file_name_from_json("bytes:%4g%E") == "%4g%E");
}
