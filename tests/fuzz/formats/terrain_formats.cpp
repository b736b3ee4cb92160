// Maps, ground files, and the points that terrain tools read.
#include "models/heights/height_field_export.h"
#include "models/heights/height_source.h"
#include "sim/base/binary_file.h"
#include "sim/base/hash.h"
#include "tests/fuzz/formats/target.h"
#include "ui/terrain/ground_view.h"
#include "ui/terrain/terrain_query.h"
#include "visuals/groundfile/ground_file.h"
#include "visuals/groundfile/ground_import.h"
#include "visuals/terrain/ground_query.h"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace octant::tests::formats {

namespace {

namespace asked_points {

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

} // namespace asked_points

namespace eye_points {

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

} // namespace eye_points

namespace ground {

namespace groundfile = visuals::groundfile;
namespace terrain = visuals::terrain;
using groundfile::GroundHeader;

std::string imported(int columns, int rows, bool placed) {
    std::vector<float> heights_m;
    for (int i = 0; i < columns * rows; ++i) { heights_m.push_back(static_cast<float>(100.0 * std::sin(0.3 * i))); }
    models::heights::HeightField field(columns, rows, 30.0, heights_m);
    if (placed) { field.place = GeoPosition{49.3, -123.1}; }
    const std::filesystem::path map = input_folder() / "map.tif";
    models::heights::write_height_field(map, field);
    return bytes_written("seed.ground",
        [&](const auto& file) { groundfile::import_ground({map}, file, {}, [](auto, double) { return false; }); });
}

/// The checksums of the header, of what lies before the tiles and of the checksums, and the layout's; the tiles' own
/// stay as they are.
void seal(std::string& bytes) {
    if (bytes.size() < GroundHeader::bytes) { return; }
    const char* const body = bytes.data() + archive_head_bytes;
    const auto number_at = [&](std::size_t at) { return value_at<double>(body + at); };
    const terrain::GroundShape shape{
        value_at<std::int32_t>(body), value_at<std::int32_t>(body + 4), number_at(8), number_at(16), number_at(24)};
    const auto put = [&bytes](
                         std::size_t at, std::uint64_t value) { std::memcpy(bytes.data() + at, &value, sizeof value); };
    if (shape.columns >= 2 && shape.columns <= 65536 && shape.rows >= 2 && shape.rows <= 65536) {
        const terrain::GroundLayout layout(shape);
        const groundfile::GroundFileLayout plan(layout);
        put(archive_head_bytes + 32, groundfile::hash_of(shape));
        if (bytes.size() == plan.file_bytes) {
            const auto all = std::as_bytes(std::span(bytes));
            put(plan.checksums, checksum_of(all.subspan(GroundHeader::bytes, layout.first_tile())));
            put(archive_head_bytes + 40, checksum_of(all.subspan(plan.checksums)));
        }
    }
    put(archive_head_bytes - 8,
        checksum_of(std::string_view(bytes).substr(archive_head_bytes, GroundHeader::bytes - archive_head_bytes)));
}

/// Looks at every sample and a line of sight, and checks the tiles.
void use(const std::filesystem::path& file) {
    const terrain::GroundTiles ground = groundfile::open_ground(file);
    for (int row = 0; row < ground.rows(); ++row) {
        for (int column = 0; column < ground.columns(); ++column) {
            expect(std::isfinite(ground.height_m(column, row)), "a height");
        }
    }
    const terrain::GroundSamples samples(ground);
    terrain::ground_height_m(samples, 1.0, -1.0);
    const glm::dvec3 end_m(samples.half_extent_m(), 200.0);
    terrain::line_of_sight(samples, -end_m, end_m, octant::wgs84.mean_radius_m());
    groundfile::hash_of_ground(file);
    groundfile::verify_ground(file, 1);
}

const Registered target({
    .name = "ground",
    .file = "input.ground",
    .use = use,
    .seeds =
        [] {
            return std::vector<std::string>{imported(5, 5, false), imported(9, 33, true), imported(2, 2, false)};
        },
    .seal = seal,
});

} // namespace ground

namespace plain_heights {

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

} // namespace plain_heights

} // namespace

} // namespace octant::tests::formats
