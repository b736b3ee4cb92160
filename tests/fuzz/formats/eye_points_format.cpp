#include "tests/fuzz/formats/target.h"
#include "ui/terrain/ground_view.h"

#include <cmath>

namespace octant::tests::formats::eye_points_format {

namespace {

const Registered target({
    .name = "eye_points",
    .file = "eyes.csv",
    .use =
        [](const auto& file) {
            for (const ui::terrain::EyePoint& eye : ui::terrain::read_eye_points(file, "a")) {
                expect(std::isfinite(eye.x_m) && std::isfinite(eye.y_m), "a place");
                expect(std::isfinite(eye.heading_deg + eye.pitch_deg), "a direction");
            }
        },
    .seeds =
        [] {
            return std::vector<std::string>{
                "# c\nmap,x_m,y_m,agl_m,heading_deg,pitch_deg\na,1,2,3,90,-10\nb,0,0,1,0,0\n"};
        },
    .words = {"a,", "map,", ",,", "\r\n"},
});

} // namespace

} // namespace octant::tests::formats::eye_points_format
