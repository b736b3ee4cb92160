#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/scratch.h"
#include "ui/dataset/dataset.h"
#include "ui/dataset/dataset_folder.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

using namespace octant;
using namespace octant::ui::dataset;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;

Dataset small_set() {
    Dataset set;
    set.settings.path.terrain = "none";
    set.varied = {varied_among("path", {"straight", "turn"})};
    set.cameras = {default_rig(Camera())};
    set.cameras[0].camera.width = 4;
    set.cameras[0].camera.height = 2;
    set.outputs.rgb = true;
    set.outputs.boxes = true;
    set.count = 3;
    set.seed = 5;
    return set;
}

Sample sample_of(std::uint64_t index) {
    Sample sample;
    sample.index = index;
    SamplePicture picture;
    picture.number = index;
    picture.camera = "chase";
    picture.lens.width = 4;
    picture.lens.height = 2;
    picture.frames.width = 4;
    picture.frames.height = 2;
    picture.frames.rgb.assign(24, static_cast<std::uint8_t>(index));
    picture.frames.object_id.assign(8, 1);
    SampleObject object;
    object.object.kind = "f15";
    object.box.object_id = 1;
    object.box.pixels = 8;
    picture.objects = {object};
    sample.pictures = {picture};
    return sample;
}

void check_refused(const fs::path& folder, const Dataset& set, const std::string& expected) {
    INFO(expected);
    CHECK_THROWS_WITH(DatasetFolder(folder, set).check(), Contains(expected));
}

} // namespace

TEST_CASE("a data set is finished when its last sample is, and goes on where it was") {
    const fs::path path = tests::empty_folder("set") / "data";
    const Dataset set = small_set();
    const DatasetFolder folder(path, set);
    folder.check();
    CHECK_FALSE(fs::exists(path)); // looking leaves nothing
    folder.prepare();
    folder.write(sample_of(2));
    folder.write(sample_of(0));
    CHECK(folder.is_finished(2));
    CHECK_FALSE(folder.is_finished(1));
    CHECK_FALSE(folder.finish());
    CHECK_FALSE(fs::exists(path / "README.md"));
    write_file(path / "images/.octant-1-0.part", "half a picture of a killed program");
    const DatasetFolder again(path, set);
    again.prepare();
    again.write(sample_of(1));
    CHECK(again.finish());
    CHECK_FALSE(fs::exists(path / "images/.octant-1-0.part"));
    CHECK(fs::exists(path / "contact-sheet.png"));
    CHECK_THAT(read_file(path / "annotations.json"), Contains("\"categories\": [{\"id\":1,\"name\":\"f15\""));
    const std::string card = read_file(path / "README.md");
    CHECK_THAT(card,
        Contains("octant dataset --path straight --path turn --terrain none --outputs rgb,boxes --count 3 --seed 5 "
                 "--format coco"));
    CHECK_THAT(card, Contains("Objects with visible pixels, in all pictures: 3."));
    CHECK_THAT(card, Contains("`--no-effects` draws blades"));
    CHECK_THAT(card, Contains("| path | straight\\|turn |") && Contains("contact-sheet.png"));
    fs::remove(path / "images/000001.png");
    CHECK_FALSE(again.is_finished(1));
}

TEST_CASE("a folder with another data set is refused, and the first difference named") {
    const fs::path path = tests::empty_folder("other-set") / "data";
    const Dataset set = small_set();
    DatasetFolder(path, set).prepare();
    DatasetFolder(path, set).check();
    Dataset other = set;
    other.seed = 6;
    check_refused(path, other, "dataset.json: expected the data set that was begun here, with seed 5, got 6");
    other = set;
    other.count = 2;
    check_refused(path, other, "with count 3, got 2");
    other.count = 30;
    DatasetFolder(path, other).check(); // it may grow
    other = set;
    other.format = Format::Npz;
    check_refused(path, other, "with format coco, got npz");
    other = set;
    other.settings.air.clouds = 0.5;
    check_refused(path, other, "with settings.clouds ");
    other = set;
    other.varied = {varied_among("path", {"turn"})};
    check_refused(path, other, "with vary.path straight|turn, got turn");
    other = set;
    other.cameras_text = "[[camera]]";
    check_refused(path, other, "with cameras_file ");
    other = set;
    other.settings.surface.order_cache = "none"; // which decides nothing
    DatasetFolder(path, other).check();
}

TEST_CASE("folders of others are refused and left as they are") {
    const fs::path path = tests::empty_folder("foreign");
    write_file(path / "letter.txt", "Dear all");
    const Dataset set = small_set();
    check_refused(path, set, "expected an empty folder or that of a data set");
    write_file(path / "dataset.json", "[1, 2]");
    check_refused(path, set, "dataset.json:1: expected a data set's description");
    check_refused(path / "letter.txt", set, "expected a folder, got a file");
    check_refused(path / "letter.txt/data", set, "letter.txt");
    CHECK(read_file(path / "dataset.json") == "[1, 2]");
}

TEST_CASE("parts have each sample once, and lists name samples that there are") {
    std::vector<std::uint64_t> all;
    for (int part = 1; part <= 7; ++part) {
        for (const std::uint64_t index : indices_of_part(std::to_string(part) + "/7", 100)) { all.push_back(index); }
    }
    REQUIRE(all.size() == 100);
    for (std::uint64_t i = 0; i < 100; ++i) { CHECK(all[i] == i); }
    CHECK(indices_of_part("2/3", 1).empty());
    CHECK_THROWS_WITH(indices_of_part("3/2", 10), Contains("--part: expected K/N"));
    CHECK(indices_from("7,2-4,3", 10) == std::vector<std::uint64_t>{2, 3, 4, 7});
    for (const char* wrong : {"10", "4-2", "-1", "a", "", "2-10"}) {
        INFO(wrong);
        CHECK_THROWS_WITH(indices_from(wrong, 10), Contains("--only: expected numbers of samples from 0 to 9"));
    }
}

TEST_CASE("outputs and formats are read by their names, and labels are words") {
    const Outputs outputs = outputs_from("rgb,flow,boxes");
    CHECK(names_of(outputs) == std::vector<std::string>{"rgb", "flow", "boxes"});
    CHECK_THROWS_WITH(
        outputs_from("rgb,colour"), Contains("--outputs: expected rgb, depth, class") && Contains("'colour'"));
    CHECK_THROWS_WITH(outputs_from(""), Contains("--outputs: expected"));
    CHECK(label_of_kind("models/my plane.obj") == "my_plane");
    CHECK(label_of_kind("f15-detailed") == "f15-detailed");
}
