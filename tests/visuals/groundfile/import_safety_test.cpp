#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "tests/rough_heights.h"
#include "tests/scratch.h"
#include "visuals/groundfile/ground_file.h"
#include "visuals/groundfile/ground_import.h"
#include "visuals/terrain/bisection_ground_builder.h"
#include "visuals/terrain/bisection_mesher.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "whole_metres_tiff.h"

namespace octant::visuals::groundfile {

namespace {

using Catch::Matchers::Contains;
using std::filesystem::path;
using terrain::MorphMargin;
using terrain::NodePart;

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

GroundHeader sound_header() { return header_of({40, 30, 30.0, 7.0, 0x1p-12}, {"plain", {}, {}, 0, 7.0F, 7.0F, 7.0F}); }

bool is_taken(const std::function<void(GroundHeader&)>& change) {
    GroundHeader header = sound_header();
    change(header);
    try {
        read_header("header", header_page(header));
    } catch (const Error&) { return false; }
    return true;
}

std::string name_read(const std::string& name) {
    GroundMetadata metadata;
    metadata.name = name;
    return metadata_of(header_of({40, 30, 30.0, 7.0, 1.0}, metadata)).name;
}

/// The file of an earlier version, as a shape tells, that is made of a field.
void write_earlier_version(const path& file, const models::heights::HeightField& field, const GroundShape& shape,
    const GroundMetadata& metadata) {
    std::vector<std::int16_t> numbers;
    for (int row = 0; row < shape.rows; ++row) {
        for (int column = 0; column < shape.columns; ++column) {
            numbers.push_back(terrain::stored_number(field.height_m(column, row), shape));
        }
    }
    const GroundLayout layout(shape);
    const GroundFileLayout plan(layout);
    std::vector<std::byte> bytes(plan.file_bytes);
    const auto memory = std::span(bytes).subspan(GroundHeader::bytes, layout.total_bytes());
    const auto checksums = std::span(bytes).subspan(plan.checksums);
    const auto put_checksum = [&](std::size_t index, std::uint64_t checksum) {
        std::memcpy(&checksums[8 * index], &checksum, sizeof checksum);
    };
    const terrain::StoredHeights heights = terrain::stored_heights(numbers, shape, false);
    terrain::GroundAssembler assembly(shape, layout, heights, memory, 1);
    assembly.write_overview();
    for (std::size_t tile = 0; tile < assembly.tiles();) {
        tile = assembly.build(tile, 1, [&](std::size_t index, std::size_t offset, auto made) {
            std::copy(made.begin(), made.end(), memory.begin() + static_cast<std::ptrdiff_t>(offset));
            put_checksum(index + 1, checksum_of(made));
        });
    }
    put_checksum(0, checksum_of(memory.first(layout.first_tile())));
    GroundHeader header = header_of(shape, metadata);
    header.progress.stage = ImportProgress::Stage::Complete;
    header.checksums = checksum_of(checksums);
    const auto page = header_page(header);
    std::copy(page.begin(), page.end(), bytes.begin());
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
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
    CHECK(is_taken([](GroundHeader& h) { h.latitude_deg = no_number; }));
    for (const double spacing_m : {0.0, 9e-4, 1.1e6, no_number}) {
        CHECK_FALSE(is_taken([=](GroundHeader& h) { h.spacing_m = spacing_m; }));
    }
    for (const double unit_m : {0.0, 0x1p-13, 0.3, 2.0, -0.5, no_number}) {
        CHECK_FALSE(is_taken([=](GroundHeader& h) { h.height_unit_m = unit_m; }));
    }
    for (const double base_m : {-1.1e5, 1.1e5, no_number}) {
        CHECK_FALSE(is_taken([=](GroundHeader& h) { h.height_base_m = base_m; }));
    }
    for (const double latitude_deg : {-91.0, 91.0, no_number}) {
        CHECK_FALSE(is_taken([=](GroundHeader& h) {
            h.has_place = 1;
            h.latitude_deg = latitude_deg;
        }));
    }
    const auto with_unit = [](double unit_m) {
        return [unit_m](GroundHeader& h) {
            h.system.wkt_length = 1;
            h.system.unit_m = unit_m;
        };
    };
    CHECK(is_taken(with_unit(0.3048)));
    CHECK_FALSE(is_taken(with_unit(0.0)));
    CHECK_FALSE(is_taken(with_unit(no_number)));
    CHECK_FALSE(is_taken([](GroundHeader& h) { h.system.centre_x = no_number; }));
    CHECK_FALSE(is_taken([](GroundHeader& h) { h.system.wkt_length = 5000; }));
    CHECK_FALSE(is_taken([](GroundHeader& h) { h.lowest_m = endless; }));
    CHECK_FALSE(is_taken([](GroundHeader& h) { h.highest_m = endless; }));
    CHECK_FALSE(is_taken([](GroundHeader& h) { h.mean_m = -endless; }));
}

TEST_CASE("a header keeps the coordinate system, and one of the first version has none") {
    GroundMetadata metadata;
    metadata.system = models::heights::CoordinateSystem{"LOCAL_CS[\"plan\"]", 12.5, -7.0, 0.3048};
    const GroundHeader header = header_of({40, 30, 30.0, 7.0, 1.0}, metadata);
    const GroundMetadata kept = metadata_of(read_header("header", header_page(header)));
    REQUIRE(kept.system);
    CHECK(kept.system->wkt == metadata.system->wkt);
    CHECK(kept.system->centre_x == 12.5);
    CHECK(kept.system->centre_y == -7.0);
    CHECK(kept.system->unit_m == 0.3048);
    auto spoilt = header_page(header);
    spoilt[offsetof(GroundHeader, system)] ^= std::byte{1};
    CHECK_THROWS_WITH(read_header("header", spoilt), Contains("damaged"));

    GroundHeader first = header_of({33, 33, 30.0, 7.0, 1.0, false, false}, metadata);
    first.version = 1;
    auto page = header_page(first);
    std::fill(page.begin() + offsetof(GroundHeader, system), page.end(), std::byte{0});
    CHECK_FALSE(metadata_of(read_header("header", page)).system);
    first.version = 7;
    CHECK_THROWS_WITH(read_header("header", header_page(first)), Contains("got version 7"));

    metadata.system->wkt.assign(4000, 'x');
    CHECK_FALSE(metadata_of(header_of({40, 30, 30.0, 7.0, 1.0}, metadata)).system);
}

TEST_CASE("grounds of versions 1 to 5 are refused where the field's border cuts the square") {
    for (const auto& [columns, rows] : {std::pair{40, 30}, {40, 40}, {65, 33}, {33, 34}}) {
        INFO(columns << " x " << rows);
        for (std::uint32_t version = 1; version <= 5; ++version) {
            GroundHeader header = header_of({columns, rows, 30.0, 7.0, 1.0, version > 3, version > 4}, {});
            header.version = version;
            CHECK_THROWS_WITH(read_header("header", header_page(header)), Contains("import it again"));
        }
        CHECK_NOTHROW(read_header("header", header_page(header_of({columns, rows, 30.0, 7.0, 1.0}, {}))));
    }
    GroundHeader whole = header_of({33, 33, 30.0, 7.0, 1.0}, {});
    whole.version = 5;
    CHECK_NOTHROW(read_header("header", header_page(whole)));
}

TEST_CASE("a ground of version 3 is read, and all its errors have full room") {
    const models::heights::HeightField field(33, 33, 30.0, tests::rough_heights(33, 33));
    const GroundTiles today = terrain::make_ground_tiles(field);
    const path file = safety_path("third.ground");
    GroundShape shape = today.shape();
    shape.has_unit_codes = false;
    write_earlier_version(safety_path("fourth.ground"), field, shape, today.metadata());
    const GroundTiles fourth = open_ground(safety_path("fourth.ground"));
    shape.has_both_margins = false;
    write_earlier_version(file, field, shape, today.metadata());
    const GroundTiles third = open_ground(file);
    CHECK_NOTHROW(verify_ground(file));
    CHECK_FALSE(third.layout().has_both_margins());
    int beyond = 0;
    for (int level = 0; level < today.levels(); ++level) {
        const GroundLayout::Level& at = today.layout().level(level);
        for (int row = 0; row < at.rows; ++row) {
            for (int column = 0; column < at.columns; ++column) {
                const auto code = [&](const GroundTiles& ground, MorphMargin morph_margin) {
                    return ground.error_code(level, NodePart::Centre, column, row, morph_margin);
                };
                CHECK(code(third, MorphMargin::Full) == code(fourth, MorphMargin::Full));
                CHECK(code(third, MorphMargin::None) == code(fourth, MorphMargin::Full));
                beyond += code(fourth, MorphMargin::Full) > code(fourth, MorphMargin::None) ? 1 : 0;
            }
        }
    }
    CHECK(beyond > 20);
}

TEST_CASE("a ground of version 4 is read, and its wider steps between errors cost triangles") {
    std::vector<float> heights_m;
    for (int i = 0; i < 257 * 257; ++i) {
        const double x = i % 257;
        const double y = i / 257;
        heights_m.push_back(
            static_cast<float>(400.0 * std::sin(0.02 * x) * std::cos(0.03 * y) + 60.0 * std::sin(0.11 * x + 0.07 * y) +
                               9.0 * std::sin(0.43 * x - 0.31 * y) + 1.5 * std::sin(1.3 * x + 1.7 * y)));
    }
    const models::heights::HeightField field(257, 257, 30.0, heights_m);
    const GroundTiles today = terrain::make_ground_tiles(field);
    GroundShape shape = today.shape();
    shape.has_unit_codes = false;
    const path file = safety_path("fourth.ground");
    write_earlier_version(file, field, shape, today.metadata());
    const GroundTiles fourth = open_ground(file);
    CHECK_NOTHROW(verify_ground(file));
    CHECK(fourth.codes().metres(1) == 0.01F);
    terrain::MeshView view;
    view.eye_m = {200.0, -300.0, 2000.0};
    const auto triangles = [&view](const GroundTiles& ground) {
        terrain::BisectionMesher mesher(ground);
        return mesher.mesh(view, {4.0, terrain::unlimited_triangles, true}).counters.triangles;
    };
    CHECK(triangles(today) > 2000);
    CHECK(triangles(today) < 0.995 * triangles(fourth));
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
