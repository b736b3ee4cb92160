#include "ui/base/json_file_name.h"

#include <catch2/catch.hpp>

using namespace octant::ui::base;

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
