#include "tests/scratch.h"
#include "ui/studies/draw_order/study_hidden_surface.h"

#include <catch2/catch.hpp>

using namespace octant;

// octant study hidden-surface --only rays --every 14 --size 480x270: 6,000 pictures of all
// paths, aircraft and views by each renderer.
TEST_CASE("no pixel of 6,000 pictures shows another polygon than a ray finds, but for rounding") {
    ui::studies::draw_order::HiddenSurfaceStudy study;
    study.out = tests::scratch_folder();
    study.settings.path.terrain = "canyon";
    study.settings.view.size_px = {480, 270};
    study.race = false;
    study.pictures = false;
    study.every = 14;
    study.quiet = true;
    CHECK(ui::studies::draw_order::study_hidden_surface(study));
}
