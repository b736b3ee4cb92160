#include "models/polygons/obj_reader.h"
#include "tests/order_shapes.h"
#include "visuals/draworder/ordered_model.h"
#include "visuals/orderfile/random_ray_test.h"

#include <catch2/catch.hpp>

using namespace octant::visuals::draworder;

TEST_CASE("the aircraft of 1,377 polygons has few lists, and no wrong ray") {
    const OrderedModel found =
        ordered(octant::models::polygons::read_obj(OCTANT_SOURCE_DIR "/models/f15-detailed.obj"));
    CHECK(found.order.cell_count() <= 80);
    CHECK(found.ray_test.wrong == 0);
    CHECK(octant::visuals::orderfile::count_wrong_rays(
              found.model, found.order, {.eyes = 150, .rays_per_eye = 30, .min_distance_radii = 0.05})
              .wrong == 0);
}

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
