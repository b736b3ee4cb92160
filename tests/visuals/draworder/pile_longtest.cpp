#include "tests/order_shapes.h"
#include "visuals/draworder/ordered_model.h"

#include <catch2/catch.hpp>

using namespace octant::visuals::draworder;

TEST_CASE("the pile of 174 bodies has its whole tree within the usual search") {
    const OrderedModel found = ordered(octant::tests::big_pile());
    CHECK(found.found_by == OrderSource::Tree);
    CHECK(found.splits <= 31);
    CHECK(found.ray_test.wrong == 0);
    CHECK(found.notes.empty());
}

TEST_CASE("a pile of 60 bodies has a tree of nearly no cuts within a tenth of the usual search") {
    OrderOptions options;
    options.seconds = 2.0;
    const OrderedModel found = ordered(octant::tests::pile(1989, 60), options);
    CHECK(found.found_by == OrderSource::Tree);
    CHECK(found.splits <= 12);
    CHECK(found.ray_test.wrong == 0);
    CHECK(found.notes.empty());
}
