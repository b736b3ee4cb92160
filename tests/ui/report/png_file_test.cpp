#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/ui/report/scratch.h"
#include "ui/report/png_file.h"
#include "ui/report/slow_pictures.h"

#include <catch2/catch.hpp>

using namespace octant;
using namespace octant::ui::report;

TEST_CASE("a picture comes back from its file as it was") {
    const ScratchFolder scratch;
    const Picture picture = made_up_picture(13, 7, 3);
    write_png(scratch / "a.png", picture.view());
    const Picture got = read_png(scratch / "a.png");
    CHECK(got.width_px == 13);
    CHECK(got.height_px == 7);
    CHECK(got.channels == 3);
    CHECK(got.bytes == picture.bytes);
    CHECK(picture_from_png("b", png_bytes(picture.view(), PngEffort::Small)).bytes == picture.bytes);
}

TEST_CASE("alpha is dropped and a bottom row that comes first goes to the bottom") {
    Picture picture{1, 2, 4, {}};
    for (const int value : {1, 2, 3, 99, 4, 5, 6, 0}) { picture.bytes.push_back(static_cast<std::byte>(value)); }
    PixelView view = picture.view();
    view.bottom_row_first = true;
    std::vector<int> values;
    for (const std::byte byte : picture_from_png("a", png_bytes(view)).bytes) {
        values.push_back(std::to_integer<int>(byte));
    }
    CHECK(values == std::vector<int>{4, 5, 6, 1, 2, 3});
}

TEST_CASE("what is no picture is refused by name") {
    const ScratchFolder scratch;
    const std::string name = (scratch / "a.png").string();
    write_file(name, "hello, this is a text");
    CHECK_THROWS_WITH(read_png(name), name + ": expected a PNG picture: Not a PNG file");
    const std::string whole = png_bytes(made_up_picture(40, 40, 3).view());
    for (const std::size_t size : {std::size_t{20}, whole.size() / 2, whole.size() - 14}) {
        CHECK_THROWS_WITH(picture_from_png("a.png", std::string_view(whole).substr(0, size)),
            Catch::StartsWith("a.png: expected a "));
    }
    CHECK_THROWS_WITH(write_png("/nowhere/a.png", made_up_picture(2, 2, 3).view()),
        "/nowhere/a.png: cannot be written: No such file or directory");
}

TEST_CASE("a picture that libpng cannot hold gives one error and no leak") {
    const Picture wide = made_up_picture(1'000'001, 1, 3);
    CHECK_THROWS_WITH(
        png_bytes(wide.view()), Catch::StartsWith("a picture of 1000001 x 1 pixels cannot be made a PNG: "));
}

TEST_CASE("a picture is shrunk by whole numbers to the mean of its squares") {
    Picture picture{4, 2, 3, std::vector<std::byte>(24, std::byte{0})};
    picture.bytes[0] = std::byte{200};
    picture.bytes[3] = std::byte{100};
    const Picture small = downscaled(picture.view(), 2);
    CHECK(small.width_px == 2);
    CHECK(small.height_px == 1);
    CHECK(std::to_integer<int>(small.bytes[0]) == 75);
    CHECK(std::to_integer<int>(small.bytes[3]) == 0);
    CHECK(downscaled(picture.view(), 4).bytes == picture.bytes);
    CHECK(downscaled(picture.view(), 3).width_px == 2);
    CHECK(downscaled(made_up_picture(100, 1, 4).view(), 10).height_px == 1);
}

TEST_CASE("pictures are chosen evenly with both ends") {
    CHECK(evenly_spaced(0, 3).empty());
    CHECK(evenly_spaced(3, 3) == std::vector<std::size_t>{0, 1, 2});
    CHECK(evenly_spaced(9, 3) == std::vector<std::size_t>{0, 4, 8});
    CHECK(evenly_spaced(5, 1) == std::vector<std::size_t>{0});
}
