#include "ui/base/progress.h"

#include <catch2/catch.hpp>

using octant::ui::base::rate_text;

TEST_CASE("progress tells slow steps, too") {
    CHECK(rate_text(250.4) == "250");
    CHECK(rate_text(10.0) == "10");
    CHECK(rate_text(3.43) == "3.4");
    CHECK(rate_text(0.0617) == "0.062");
    CHECK(rate_text(0.0) == "0");
}
