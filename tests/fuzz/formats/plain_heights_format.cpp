#include "models/heights/height_field_import.h"
#include "tests/fuzz/formats/target.h"

#include <cmath>

namespace octant::tests::formats::plain_heights_format {

namespace {

void use(const std::filesystem::path& file) {
    const models::heights::HeightField field = models::heights::read_height_field(file);
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            expect(std::isfinite(field.height_m(column, row)), "a height");
        }
    }
    expect(field.height_at(0.0, 0.0).has_value(), "ground in the middle");
}

const Registered target({
    .name = "plain_heights",
    .file = "input.pgm",
    .use = use,
    .seeds =
        [] {
            return std::vector<std::string>{
                "P2\n# heights\n4 3\n255\n1 2 3 4\n5 6 7 8\n9 10 11 255\n", "P2 2 2 65535 0 8000 1 9\n"};
        },
    .words = {"P2\n", "# c\n", "65535 ", "65536 ", "20001 ", " "},
});

} // namespace

} // namespace octant::tests::formats::plain_heights_format
