#include "tests/scratch.h"
#include "ui/studies/draw_order/study_hidden_surface.h"

#include <catch2/catch.hpp>

#include <string>

using namespace octant;

namespace {

/// Whether no pixel is wrong of every 14th frame, or so, of all paths and views by each renderer: octant study
/// hidden-surface --only rays --every 14 --size 480x270. `aircraft`: one in place of the F-15 and the 500MD; empty:
/// both.
bool shows_what_rays_find(const std::string& aircraft, int every) {
    ui::studies::draw_order::HiddenSurfaceStudyOptions study;
    study.out = tests::scratch_folder();
    study.settings.path.terrain = "canyon";
    study.settings.view.size_px = {480, 270};
    study.aircraft = aircraft;
    study.race = false;
    study.pictures = false;
    study.every = every;
    return ui::studies::draw_order::study_hidden_surface(study);
}

} // namespace

TEST_CASE("no pixel of 6,000 pictures shows another polygon than a ray finds, but for rounding") {
    CHECK(shows_what_rays_find("", 14));
}

TEST_CASE("nor where the aircraft has 753 or 1,377 polygons") {
    CHECK(shows_what_rays_find("500md-detailed", 70));
    CHECK(shows_what_rays_find("f15-detailed", 70));
}
