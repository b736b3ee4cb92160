#include "ui/base/other_names.h"

#include <catch2/catch.hpp>

using octant::ui::base::call_by;
using octant::ui::base::with_other_names;

TEST_CASE("what lies in a folder of the program's own is called by the file that it came from") {
    call_by("/own/octant-a1/one", "flights/one.zip");
    call_by("/own/octant-b2/one", "one.zip");
    CHECK(
        with_other_names("/own/octant-a1/one/frames.csv:3: expected a number, got 'x'") ==
        "flights/one.zip/frames.csv:3: expected a number, got 'x'");
    CHECK(
        with_other_names("/own/octant-b2/one differs from /own/octant-a1/one") ==
        "one.zip differs from flights/one.zip");
    CHECK(with_other_names("/own/octant-c3/one: found none") == "/own/octant-c3/one: found none");
}
