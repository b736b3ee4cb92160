#include "tests/fuzz/formats/target.h"
#include "ui/terrain/terrain_query.h"

#include <cmath>

namespace octant::tests::formats::asked_points_format {

namespace {

const Registered target({
    .name = "asked_points",
    .file = "points.csv",
    .use =
        [](const auto& file) {
            for (const ui::terrain::QueryPoint& point : ui::terrain::read_points(file)) {
                expect(std::isfinite(point.x_m) && std::isfinite(point.y_m), "a place");
            }
        },
    .seeds =
        [] {
            return std::vector<std::string>{"x,y,z\n# c\n1,2\n3.5,-4,5\n", "0,0\n"};
        },
    .words = {",", "#", "\r\n", "x,y\n"},
});

} // namespace

} // namespace octant::tests::formats::asked_points_format
