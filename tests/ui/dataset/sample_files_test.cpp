#include "sim/base/output_file.h"
#include "sim/base/random_generator.h"
#include "tests/scratch.h"
#include "ui/dataset/contact_sheet.h"
#include "ui/dataset/sample_files.h"
#include "ui/report/png_file.h"
#include "ui/report/zip_file.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

using namespace octant;
using namespace octant::ui::dataset;
using Catch::Contains;

namespace {

constexpr int width = 6;
constexpr int height = 4;
constexpr std::size_t pixels = 24;

/// A box of 4 x 2 x 1 m with its middle 20 m ahead of a camera that looks north from 0, 0, 100.
octant::Box box_ahead() {
    octant::Box box;
    box.object_id = 1;
    const std::array visible{1.0, 1.0, 4.0, 3.0};
    std::copy(visible.begin(), visible.end(), box.visible_px);
    std::copy(visible.begin(), visible.end(), box.whole_px);
    for (int i = 0; i < 8; ++i) { // body axes of an aircraft that flies north: x north, y east, z down
        box.corners_m[i] = {
            (i & 2) != 0 ? 1.0 : -1.0, 20.0 + ((i & 1) != 0 ? 2.0 : -2.0), 100.0 - ((i & 4) != 0 ? 0.5 : -0.5)};
    }
    box.visible_share = 0.75;
    box.distance_m = 20.0;
    box.pixels = 5;
    return box;
}

Sample made_sample() {
    Sample sample;
    sample.index = 7;
    sample.varied = {{"clouds", "0.25"}};
    sample.time_s = 12.5;
    sample.aircraft = {"f15"};
    sample.states.resize(1);
    SamplePicture picture;
    picture.number = 7;
    picture.camera = "front";
    picture.lens.width = width;
    picture.lens.height = height;
    picture.lens.intrinsics = Intrinsics{5.0, 5.0, 2.5, 1.5};
    picture.pose.eye_m = {0.0, 0.0, 100.0};
    const double half = std::sqrt(0.5); // x forward to north, y right to east, z down
    picture.pose.attitude = {0.0, half, half, 0.0};
    Frames& frames = picture.frames;
    frames.count = 1;
    frames.width = width;
    frames.height = height;
    RandomGenerator random(5);
    for (std::size_t i = 0; i < pixels; ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            frames.rgb.push_back(static_cast<std::uint8_t>(random.between(0.0, 256.0)));
            frames.normal.push_back(static_cast<float>(random.between(-1.0, 1.0)));
        }
        frames.depth_m.push_back(static_cast<float>(random.between(1.0, 400.0)));
        frames.class_id.push_back(static_cast<std::uint8_t>(i % 9));
        frames.object_id.push_back(i % 5 == 2 ? 1 : 0);
        frames.flow_px.push_back(static_cast<float>(random.between(-3.0, 3.0)));
        frames.flow_px.push_back(static_cast<float>(random.between(-3.0, 3.0)));
        frames.coverage.push_back(static_cast<float>(i % 17) / 16.0F);
    }
    frames.depth_m[0] = std::numeric_limits<float>::infinity();
    frames.flow_px[2] = std::numeric_limits<float>::quiet_NaN();
    octant::Object object;
    object.name = "f15";
    object.kind = "f15";
    picture.objects = {{object, box_ahead()}};
    sample.pictures = {picture};
    return sample;
}

constexpr Outputs all{true, true, true, true, true, true, true, true};

std::string bytes_named(const std::vector<NamedBytes>& files, const std::string& name) {
    for (const auto& [each, bytes] : files) {
        if (each == name) { return bytes; }
    }
    FAIL("there is no " << name);
    return {};
}

} // namespace

TEST_CASE("run lengths go down the columns and begin with what is no object") {
    // 1 0 0
    // 1 1 0
    const std::vector<std::uint32_t> ids{1, 0, 2, 1, 1, 2};
    CHECK(mask_runs(ids, 3, 2, 1) == std::vector<std::uint32_t>{0, 2, 1, 1, 2});
    CHECK(mask_runs(ids, 3, 2, 2) == std::vector<std::uint32_t>{4, 2});
    CHECK(mask_runs(ids, 3, 2, 9) == std::vector<std::uint32_t>{6});
}

TEST_CASE("run lengths are written as COCO's tools write them") {
    // By hand: five bits a letter from '0' on, 32 = more follow; from the fourth on the difference to two before.
    CHECK(compressed_runs(std::vector<std::uint32_t>{0, 2, 1, 1, 2}) == "021O1");
    CHECK(compressed_runs(std::vector<std::uint32_t>{6}) == "6");
    CHECK(compressed_runs(std::vector<std::uint32_t>{100, 20}) == "T3d0");
    CHECK(compressed_runs(std::vector<std::uint32_t>{16}) == "`0");
}

TEST_CASE("an array file has numpy's header and the values behind it") {
    const std::vector<float> values{1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F};
    const std::array<std::size_t, 2> shape{2, 3};
    const std::string file = npy_bytes("<f4", shape, std::as_bytes(std::span(values)));
    CHECK(file.substr(0, 8) == std::string("\x93NUMPY\x01\x00", 8));
    const std::size_t header = static_cast<unsigned char>(file[8]) + 256U * static_cast<unsigned char>(file[9]);
    CHECK((10 + header) % 64 == 0);
    CHECK(file.size() == 10 + header + 24);
    CHECK(file.substr(10, 60) == "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), } ");
    CHECK(file[9 + header] == '\n');
    CHECK(std::memcmp(file.data() + 10 + header, values.data(), 24) == 0);
    const std::array<std::size_t, 1> one{6};
    CHECK_THAT(npy_bytes("<f4", one, std::as_bytes(std::span(values))), Contains("'shape': (6,), }"));
}

TEST_CASE("the files of a sample are those that their names promise, the sample's own last") {
    const Sample sample = made_sample();
    for (const Format format : {Format::Coco, Format::Kitti, Format::Npz}) {
        for (const Outputs& wanted : {all, Outputs{.rgb = true}, Outputs{.depth = true, .boxes = true}}) {
            const auto files = files_of(sample, format, wanted);
            std::vector<std::string> names;
            for (const auto& [name, bytes] : files) { names.push_back(name); }
            auto promised = picture_file_names(7, format, wanted);
            promised.push_back(sample_file_name(7));
            CHECK(names == promised);
            CHECK(files == files_of(sample, format, wanted));
            const auto json = nlohmann::json::parse(files.back().second);
            CHECK(json.at("sample") == 7);
            CHECK(json.at("pictures")[0].contains("objects") == wanted.boxes);
        }
    }
}

TEST_CASE("KITTI's labels are in the camera's axes") {
    const auto files = files_of(made_sample(), Format::Kitti, all);
    std::istringstream label(bytes_named(files, "label_2/000007.txt"));
    std::string kind;
    std::vector<double> numbers;
    label >> kind;
    for (double number = 0.0; label >> number;) { numbers.push_back(number); }
    CHECK(kind == "f15");
    REQUIRE(numbers.size() == 14);
    CHECK(numbers[1] == 1); // 0.75 of it is visible
    CHECK(std::vector(numbers.begin() + 3, numbers.begin() + 7) == std::vector{1.0, 1.0, 3.0, 2.0});
    CHECK(std::vector(numbers.begin() + 7, numbers.begin() + 10) == std::vector{1.0, 2.0, 4.0});
    CHECK(numbers[10] == Approx(0.0).margin(1e-4));
    CHECK(numbers[11] == Approx(0.5)); // the lower side's middle is below the axis
    CHECK(numbers[12] == Approx(20.0));
    CHECK(numbers[13] == Approx(-1.570796)); // it flies away from the camera: KITTI's x axis turned to z
    CHECK_THAT(bytes_named(files, "calib/000007.txt"),
        Contains("P2: 5.000000000000e+00 0 2.500000000000e+00 0 0 5.000000000000e+00 1.500000000000e+00 0 0 0 1 0\n"));
}

TEST_CASE("pictures of 1 and 3 channels and of 8 and 16 bits are whole PNG files") {
    const auto files = files_of(made_sample(), Format::Kitti, all);
    const auto picture = ui::report::picture_from_png("rgb", bytes_named(files, "image_2/000007.png"));
    const Sample sample = made_sample();
    REQUIRE(picture.bytes.size() == sample.pictures[0].frames.rgb.size());
    CHECK(std::memcmp(picture.bytes.data(), sample.pictures[0].frames.rgb.data(), picture.bytes.size()) == 0);
    const std::string depth = bytes_named(files, "depth/000007.png");
    CHECK(static_cast<int>(depth[24]) == 16); // bits and kind of colour, in the header
    CHECK(static_cast<int>(depth[25]) == 0);
    const std::string flow = bytes_named(files, "flow/000007.png");
    CHECK(static_cast<int>(flow[24]) == 16);
    CHECK(static_cast<int>(flow[25]) == 2);
    CHECK(static_cast<int>(bytes_named(files, "semantic/000007.png")[24]) == 8);
}

TEST_CASE("annotations count on from sample to sample and leave out what nobody sees") {
    Sample sample = made_sample();
    sample.pictures[0].objects.push_back(sample.pictures[0].objects[0]);
    sample.pictures[0].objects[1].box.pixels = 0;
    const std::string text = files_of(sample, Format::Coco, all).back().second;
    const std::vector<std::string> kinds{"500md", "f15"};
    std::uint64_t next = 41;
    const CocoParts parts = coco_parts(text, kinds, next);
    CHECK(next == 42);
    const auto json = nlohmann::json::parse(coco_annotations(std::vector{parts}, kinds));
    REQUIRE(json.at("annotations").size() == 1);
    const auto& annotation = json.at("annotations")[0];
    CHECK(annotation.at("id") == 41);
    CHECK(annotation.at("image_id") == 7);
    CHECK(annotation.at("category_id") == 2);
    CHECK(annotation.at("bbox") == std::vector{1.0, 1.0, 3.0, 2.0});
    CHECK(annotation.at("area") == 5);
    CHECK(annotation.at("segmentation").at("size") == std::vector{4, 6});
    CHECK(json.at("categories")[1].at("name") == "f15");
    CHECK(json.at("images")[0].at("file_name") == "images/000007.png");
    CHECK(json.at("images")[0].at("arrays") == "arrays/000007.npz");
}

TEST_CASE("a contact sheet shows pictures of PNG and of array files alike") {
    const auto folder = tests::empty_folder("contact-sheet");
    const Sample sample = made_sample();
    write_file(folder / "a.png", bytes_named(files_of(sample, Format::Coco, all), "images/000007.png"));
    write_file(folder / "a.npz", bytes_named(files_of(sample, Format::Npz, all), "npz/000007.npz"));
    const std::string of_png = contact_sheet_png(std::vector{folder / "a.png", folder / "a.png"});
    CHECK(of_png == contact_sheet_png(std::vector{folder / "a.npz", folder / "a.npz"}));
    const auto sheet = ui::report::picture_from_png("sheet", of_png);
    CHECK(sheet.width_px == 332);
    CHECK(sheet.height_px == 114); // as high as the pictures of three by two need
}

TEST_CASE("a zip file in memory has its entries, and the same bytes each time") {
    const auto file = tests::scratch_file("memory.zip");
    const std::vector<ui::report::ZipContent> entries{
        {"a.txt", "some text"}, {"b", std::string(100000, 'b')}, {"c", ""}};
    const std::string bytes = ui::report::zip_bytes(entries);
    CHECK(bytes == ui::report::zip_bytes(entries));
    CHECK(bytes.size() < 2000);
    write_file(file, bytes);
    CHECK(ui::report::zip_entries(file).size() == 3);
    for (const auto& entry : entries) { CHECK(ui::report::zip_text(file, entry.name, 1000000) == entry.bytes); }
}
