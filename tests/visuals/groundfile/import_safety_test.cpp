#include "sim/base/error.h"
#include "tests/scratch.h"
#include "visuals/groundfile/ground_file.h"
#include "visuals/groundfile/ground_import.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "whole_metres_tiff.h"

namespace octant::visuals::groundfile {

namespace {

using Catch::Matchers::Contains;
using std::filesystem::path;

const auto run_to_the_end = [](ImportStage, double) { return false; };

path safety_path(const std::string& name) { return tests::scratch_folder() / name; }

/// 40 x 30 whole metres, all 7 but the one in the middle.
path write_plain(const std::string& name, std::int16_t middle_m = 7) {
    std::vector<std::int16_t> numbers(40 * 30, 7);
    numbers[40 * 15 + 20] = middle_m;
    write_geotiff(safety_path(name), 40, numbers, 30.0, {0.0, 0.0});
    return safety_path(name);
}

std::string content_of(const path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// What is read from the page of a header.
GroundHeader read_back(const GroundHeader& header) { return read_header("header", header_page(header)); }

GroundHeader header_with(const GroundMetadata& metadata) { return {{40, 30, 30.0, 7.0, 0x1p-12}, metadata, {}, 0}; }

bool is_taken(const std::function<void(GroundHeader&)>& change) {
    GroundHeader header = header_with({"plain", {}, {}, 0, 7.0F, 7.0F, 7.0F});
    change(header);
    try {
        read_back(header);
    } catch (const Error&) { return false; }
    return true;
}

std::string name_read(const std::string& name) {
    GroundMetadata metadata;
    metadata.name = name;
    return read_back(header_with(metadata)).metadata.name;
}

} // namespace

TEST_CASE("an input in the place of the unfinished file is refused and stays whole") {
    const path input = write_plain("same.ground.part");
    const std::string before = content_of(input);
    const path link = safety_path("linked.ground.part");
    std::filesystem::create_hard_link(input, link);
    for (const char* out : {"same.ground", "linked.ground"}) {
        CHECK_THROWS_WITH(import_ground({input}, safety_path(out), {}, run_to_the_end), Contains("one of the inputs"));
    }
    CHECK(content_of(input) == before);
}

TEST_CASE("a foreign file in the place of the unfinished one is refused and stays whole") {
    const path input = write_plain("beside.tif");
    const path part = safety_path("foreign.ground.part");
    std::ofstream(part) << "a letter";
    CHECK_THROWS_WITH(import_ground({input}, safety_path("foreign.ground"), {}, run_to_the_end),
        Contains("foreign.ground.part") && Contains("another kind of file"));
    CHECK(content_of(part) == "a letter");
    std::ofstream(part, std::ios::trunc).close();
    CHECK_NOTHROW(import_ground({input}, safety_path("foreign.ground"), {}, run_to_the_end));
}

TEST_CASE("a second import to the same file is refused while the first goes on unharmed") {
    const path input = write_plain("first_of_two.tif");
    const path other = write_plain("second_of_two.tif", 9);
    const path out = safety_path("both.ground");
    int refused = 0;
    import_ground({input}, out, {}, [&](ImportStage, double done) {
        if (done < 1.0) {
            CHECK_THROWS_WITH(
                import_ground({other}, out, {}, run_to_the_end), Contains("another import is writing it"));
            ++refused;
        }
        return false;
    });
    CHECK(refused >= 3);
    CHECK(open_ground(out).metadata().highest_m == 7.0F);
    CHECK_NOTHROW(verify_ground(out));
}

TEST_CASE("a header whose checksum is right but whose numbers are not believed is refused") {
    constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
    constexpr float endless = std::numeric_limits<float>::infinity();
    CHECK(is_taken([](GroundHeader&) {}));
    for (const double spacing_m : {0.0, 9e-4, 1.1e6, no_number}) {
        CHECK_FALSE(is_taken([=](GroundHeader& h) { h.shape.spacing_m = spacing_m; }));
    }
    for (const double unit_m : {0.0, 0x1p-13, 0.3, 2.0, -0.5, no_number}) {
        CHECK_FALSE(is_taken([=](GroundHeader& h) { h.shape.height_unit_m = unit_m; }));
    }
    for (const double base_m : {-1.1e5, 1.1e5, no_number}) {
        CHECK_FALSE(is_taken([=](GroundHeader& h) { h.shape.height_base_m = base_m; }));
    }
    for (const double latitude_deg : {-91.0, 91.0, no_number}) {
        CHECK_FALSE(is_taken([=](GroundHeader& h) { h.metadata.place = GeoPosition{latitude_deg, 0.0}; }));
    }
    const auto with_system = [](double centre_x, double unit_m) {
        return [=](GroundHeader& h) {
            h.metadata.system = models::heights::CoordinateSystem{"x", centre_x, 0.0, unit_m};
        };
    };
    CHECK(is_taken(with_system(0.0, 0.3048)));
    CHECK_FALSE(is_taken(with_system(0.0, 0.0)));
    CHECK_FALSE(is_taken(with_system(0.0, no_number)));
    CHECK_FALSE(is_taken(with_system(no_number, 1.0)));
    CHECK_FALSE(is_taken([](GroundHeader& h) { h.metadata.lowest_m = endless; }));
    CHECK_FALSE(is_taken([](GroundHeader& h) { h.metadata.highest_m = endless; }));
    CHECK_FALSE(is_taken([](GroundHeader& h) { h.metadata.mean_m = -endless; }));
}

TEST_CASE("a header keeps place, system and deviation, but no text of more than a page") {
    GroundMetadata metadata;
    metadata.place = GeoPosition{49.25, -123.5};
    metadata.system = models::heights::CoordinateSystem{"LOCAL_CS[\"plan\"]", 12.5, -7.0, 0.3048};
    metadata.deviation = models::heights::HeightDeviation{0.5, 2.5, 77};
    const GroundMetadata kept = read_back(header_with(metadata)).metadata;
    REQUIRE((kept.place && kept.system && kept.deviation));
    CHECK(kept.place->latitude_deg == 49.25);
    CHECK(kept.place->longitude_deg == -123.5);
    CHECK(kept.system->wkt == metadata.system->wkt);
    CHECK(kept.system->centre_x == 12.5);
    CHECK(kept.system->centre_y == -7.0);
    CHECK(kept.system->unit_m == 0.3048);
    CHECK(kept.deviation->rms_m == 0.5);
    CHECK(kept.deviation->worst_m == 2.5);
    CHECK(kept.deviation->places == 77);

    metadata.system->wkt.assign(4000, 'x');
    CHECK_FALSE(read_back(header_with(metadata)).metadata.system);
}

TEST_CASE("a damaged header, one of another version and files of earlier releases are to be imported again") {
    auto page = header_page(header_with({}));
    page[100] ^= std::byte{1};
    CHECK_THROWS_WITH(read_header("header", page), Contains("checksum") && Contains("import it again"));
    page = header_page(header_with({}));
    page[8] = std::byte{8};
    CHECK_THROWS_WITH(read_header("header", page), Contains("version 7, got 8: import it again"));
    const std::string_view earlier = "octant ground\r\n\x1a\6";
    std::ranges::copy(std::as_bytes(std::span(earlier)), page.begin());
    CHECK_THROWS_WITH(read_header("header", page), Contains("of version 7, got an earlier one: import it again"));
}

TEST_CASE("a name is cut between characters and read as UTF-8 without control characters") {
    const std::string umlaut = "\xC3\xBC";
    CHECK(name_read("Z" + umlaut + "rich.tif") == "Z" + umlaut + "rich.tif");
    CHECK(name_read(std::string(255, 'a') + umlaut) == std::string(255, 'a'));
    CHECK(name_read(std::string(254, 'a') + umlaut) == std::string(254, 'a') + umlaut);
    CHECK(name_read("a\xFF\x1B[b\xC3") == "a\xEF\xBF\xBD\xEF\xBF\xBD[b\xEF\xBF\xBD");
}

TEST_CASE("the hash of a ground tells one tile from another and grounds alike as alike") {
    const auto hash_with = [](std::int16_t middle_m, const std::string& out) {
        import_ground({write_plain("hashed.tif", middle_m)}, safety_path(out), {}, run_to_the_end);
        return hash_of_ground(safety_path(out));
    };
    const std::uint64_t seven = hash_with(7, "seven.ground");
    CHECK(hash_with(7, "again.ground") == seven);
    CHECK(hash_with(8, "eight.ground") != seven);
}

} // namespace octant::visuals::groundfile
