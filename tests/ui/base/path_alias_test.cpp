#include "ui/base/path_alias.h"

#include <catch2/catch.hpp>

using octant::ui::base::set_path_alias;
using octant::ui::base::with_path_aliases;

TEST_CASE("what lies in a folder of the program's own is called by the file that it came from") {
    set_path_alias("/own/octant-a1/one", "flights/one.zip");
    set_path_alias("/own/octant-b2/one", "one.zip");
    CHECK(with_path_aliases("/own/octant-a1/one/frames.csv:3: expected a number, got 'x'") ==
          "flights/one.zip/frames.csv:3: expected a number, got 'x'");
    CHECK(with_path_aliases("/own/octant-b2/one differs from /own/octant-a1/one") ==
          "one.zip differs from flights/one.zip");
    CHECK(with_path_aliases("/own/octant-c3/one: found none") == "/own/octant-c3/one: found none");
}
