#include "models/heights/height_field_export.h"
#include "models/heights/height_source.h"
#include "sim/base/error.h"
#include "tests/rough_heights.h"
#include "tests/scratch.h"
#include "visuals/groundfile/ground_file.h"
#include "visuals/groundfile/ground_import.h"
#include "visuals/terrain/bisection_ground_builder.h"
#include "visuals/terrain/bisection_prefetcher.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "whole_metres_tiff.h"

namespace octant::visuals::groundfile {

namespace {

using Catch::Matchers::Contains;
using std::filesystem::path;
using terrain::GroundPrefetcher;
using terrain::make_ground_tiles;
using terrain::NodePart;

constexpr double spacing_m = 30.0;
constexpr std::int16_t no_data = -32768;

path scratch(const std::string& name) {
    std::filesystem::create_directories(tests::scratch_folder());
    return tests::scratch_folder() / name;
}

/// A rectangle of a field's samples as a file of whole metres.
struct Cut {
    int west = 0;
    int east = 0;
    int south = 0;
    int north = 0;
};

template <typename Height>
path write_tiff(const std::string& name, const Cut& cut, const Height& height) {
    const path file = scratch(name);
    std::vector<std::int16_t> numbers;
    for (int row = cut.north - 1; row >= cut.south; --row) {
        for (int column = cut.west; column < cut.east; ++column) { numbers.push_back(height(column, row)); }
    }
    write_geotiff(file, cut.east - cut.west, numbers, spacing_m, {cut.west * spacing_m, cut.north * spacing_m});
    return file;
}

const auto never_save = [](ImportStage, double) { return false; };

GroundTiles imported(const std::vector<path>& inputs, const std::string& name) {
    import_ground(inputs, scratch(name), {}, never_save);
    return open_ground(scratch(name));
}

bool same_ground(const GroundTiles& a, const GroundTiles& b) {
    return a.memory().size() == b.memory().size() && a.shape().height_base_m == b.shape().height_base_m &&
           a.shape().height_unit_m == b.shape().height_unit_m && a.shape().spacing_m == b.shape().spacing_m &&
           a.metadata().mean_m == b.metadata().mean_m &&
           std::memcmp(a.memory().data(), b.memory().data(), a.memory().size()) == 0;
}

/// 300 x 200 samples, and the same as a file.
struct Made {
    models::heights::HeightField field{300, 200, spacing_m, tests::rough_heights(300, 200)};

    std::int16_t operator()(int column, int row) const {
        return static_cast<std::int16_t>(field.height_m(column, row));
    }

    path whole(const std::string& name) const { return write_tiff(name, {0, 300, 0, 200}, *this); }
};

void flip_byte(const path& file, std::uintmax_t at) {
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekg(static_cast<std::streamoff>(at));
    const int byte = stream.get();
    stream.seekp(static_cast<std::streamoff>(at));
    stream.put(static_cast<char>(byte ^ 0x10));
}

} // namespace

TEST_CASE("an imported file is the ground of its field, byte for byte") {
    const Made made;
    const GroundTiles ground = imported({made.whole("whole.tif")}, "whole.ground");
    CHECK(same_ground(ground, make_ground_tiles(made.field)));
    CHECK(ground.metadata().filled_voids == 0);
    CHECK(ground.metadata().name == "whole.tif");
    CHECK_FALSE(std::filesystem::exists(scratch("whole.ground.part")));
    CHECK_NOTHROW(verify_ground(scratch("whole.ground")));
}

TEST_CASE("fractions of a metre are imported as the field has them") {
    std::vector<float> heights_m;
    for (int i = 0; i < 90 * 70; ++i) { heights_m.push_back(400.0F * std::sin(0.01F * static_cast<float>(i))); }
    const models::heights::HeightField field(90, 70, 12.5, heights_m);
    models::heights::write_height_field(scratch("fractions.tif"), field);
    const GroundTiles ground = imported({scratch("fractions.tif")}, "fractions.ground");
    CHECK(same_ground(ground, make_ground_tiles(field)));
}

TEST_CASE("an imported map keeps its coordinate system as the field does") {
    Made made;
    made.field.place = GeoPosition{36.0, -112.0};
    const path file = scratch("placed.tif");
    models::heights::write_height_field(file, made.field);
    const models::heights::HeightField field = models::heights::read_height_field(file);
    const GroundTiles ground = imported({file}, "placed.ground");
    REQUIRE(field.system);
    for (const auto& system : {ground.metadata().system, make_ground_tiles(field).metadata().system}) {
        REQUIRE(system);
        CHECK(system->wkt == field.system->wkt);
        CHECK(system->centre_x == field.system->centre_x);
        CHECK(system->centre_y == field.system->centre_y);
        CHECK(system->unit_m == field.system->unit_m);
    }
}

TEST_CASE("two files that overlap make the same ground as one") {
    const Made made;
    const path west = write_tiff("west.tif", {0, 170, 0, 200}, made);
    const path east = write_tiff("east.tif", {150, 300, 0, 200}, made);
    const GroundTiles one = imported({made.whole("one.tif")}, "one.ground");
    CHECK(same_ground(imported({west, east}, "two.ground"), one));
    CHECK(same_ground(imported({east, west}, "turned.ground"), one));
}

TEST_CASE("a stopped import goes on and makes the same bytes") {
    const Made made;
    const path file = made.whole("stopped.tif");
    const GroundTiles whole = imported({file}, "unstopped.ground");
    const path out = scratch("stopped.ground");

    struct Stop {};

    for (const ImportStage stage : {ImportStage::Reading, ImportStage::Building}) {
        const auto stop = [stage](ImportStage now, double done) {
            if (now == stage && done > 0.6) { throw Stop(); }
            return true;
        };
        CHECK_THROWS_AS(import_ground({file}, out, {}, stop), Stop);
        CHECK_FALSE(std::filesystem::exists(out));
    }
    const ImportSummary summary = import_ground({file}, out, {}, never_save);
    CHECK_THAT(summary.note, Contains("goes on after") && Contains("tiles"));
    CHECK(same_ground(open_ground(out), whole));
}

TEST_CASE("an import of other inputs starts anew and says so") {
    const Made made;
    const path out = scratch("other.ground");
    const auto stop = [](ImportStage stage, double) {
        if (stage == ImportStage::Building) { throw Error("stopped"); }
        return true;
    };
    CHECK_THROWS(import_ground({made.whole("first.tif")}, out, {}, stop));
    const path other = write_tiff("second.tif", {0, 100, 0, 90}, made);
    CHECK_THAT(import_ground({other}, out, {}, never_save).note, Contains("started anew"));
    CHECK(open_ground(out).columns() == 100);
}

TEST_CASE("voids and gaps between files are filled from their rims and counted") {
    const Made made;
    const auto holed = [](int column, int row) {
        const bool hole = column >= 20 && column < 30 && row >= 40 && row < 45;
        return hole ? no_data : static_cast<std::int16_t>(100);
    };
    const path west = write_tiff("holed.tif", {0, 100, 0, 80}, holed);
    const path east = write_tiff("beyond.tif", {104, 160, 0, 80}, holed);
    const GroundTiles ground = imported({west, east}, "holed.ground");
    CHECK(ground.metadata().filled_voids == 50 + 4 * 80);
    CHECK(ground.metadata().lowest_m == 100.0F);
    CHECK(ground.metadata().highest_m == 100.0F);
    CHECK(ground.error_code(0, NodePart::Centre, 0, 0) == 0);
}

TEST_CASE("files without any height are refused and leave nothing behind") {
    const path file = write_tiff("void.tif", {0, 9, 0, 9}, [](int, int) { return no_data; });
    CHECK_THROWS_WITH(imported({file}, "void.ground"), Contains("at least one height"));
    CHECK_FALSE(std::filesystem::exists(scratch("void.ground.part")));
}

TEST_CASE("an input that ends too early is refused and leaves nothing behind") {
    const Made made;
    const path file = made.whole("cut.tif");
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    CHECK_THROWS_WITH(imported({file}, "cut.ground"), Contains("cut.tif"));
    CHECK_FALSE(std::filesystem::exists(scratch("cut.ground")));
    CHECK_FALSE(std::filesystem::exists(scratch("cut.ground.part")));
}

TEST_CASE("files that do not fit together are refused by name") {
    const Made made;
    const path west = write_tiff("fits.tif", {0, 100, 0, 80}, made);
    const path picture = scratch("picture.pgm");
    std::ofstream(picture) << "P2 2 2 9 1 2 3 4\n";
    CHECK_THROWS_WITH(
        imported({west, picture}, "unfit.ground"), Contains("picture.pgm") && Contains("knows its place"));
    CHECK_FALSE(std::filesystem::exists(scratch("unfit.ground.part")));
}

TEST_CASE("damage, cut files and other files are told from a ground") {
    const Made made;
    const path good = scratch("good.ground");
    import_ground({made.whole("good.tif")}, good, {}, never_save);
    const auto size = std::filesystem::file_size(good);
    const path bad = scratch("bad.ground");
    const auto spoil = [&](std::uintmax_t at) {
        std::filesystem::copy_file(good, bad, std::filesystem::copy_options::overwrite_existing);
        flip_byte(bad, at);
    };
    CHECK(is_ground_file(good));
    spoil(size / 2);
    CHECK_NOTHROW(open_ground(bad));
    CHECK_THROWS_WITH(verify_ground(bad), Contains("bad.ground") && Contains("damage in level"));
    spoil(100);
    CHECK_THROWS_WITH(open_ground(bad), Contains("checksum") && Contains("import it again"));
    spoil(4100);
    CHECK_THROWS_WITH(open_ground(bad), Contains("before the tiles"));
    spoil(size - 3);
    CHECK_THROWS_WITH(open_ground(bad), Contains("before the tiles"));
    std::filesystem::resize_file(bad, size - 5000);
    CHECK_THROWS_WITH(open_ground(bad), Contains("expected") && Contains("bytes"));
    std::filesystem::resize_file(bad, 10);
    CHECK_THROWS_WITH(open_ground(bad), Contains("another kind of file"));
    CHECK_THROWS_WITH(open_ground(scratch("whole.tif")), Contains("whole.tif"));
    CHECK_FALSE(is_ground_file(scratch("good.tif")));
    CHECK_THROWS_WITH(open_ground(scratch("good.tif")), Contains("another kind of file"));
}

TEST_CASE("fetching ahead changes nothing and ends at once") {
    const Made made;
    const GroundTiles ground = imported({made.whole("ahead.tif")}, "ahead.ground");
    GroundPrefetcher prefetcher(ground);
    for (double x_m = -20000.0; x_m < 20000.0; x_m += 500.0) { prefetcher.prefetch_around({x_m, 0.3 * x_m}); }
    CHECK(same_ground(ground, make_ground_tiles(made.field)));
}

} // namespace octant::visuals::groundfile
