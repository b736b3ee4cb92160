#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/ui/report/scratch.h"
#include "ui/base/data_files.h"
#include "ui/report/folder_lock.h"
#include "ui/report/html_report.h"
#include "ui/report/loaded_recording.h"
#include "ui/report/packed_recording.h"
#include "ui/report/recording_writer.h"
#include "ui/report/zip_file.h"

#include <catch2/catch.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

using namespace octant;
using namespace octant::ui::report;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;

/// A finished recording with a copy of an input and a terrain beside the folder.
void record(const fs::path& folder) {
    write_file(folder.parent_path() / "map.bil", "heights");
    write_file(folder.parent_path() / "map.hdr", "their size");
    RunInfo info;
    info.title = "a flight";
    info.settings_json = R"({"path":"inputs/p.toml","terrain":"../map.bil"})";
    info.files = {{"inputs/p.toml", "legs"}};
    record_frames(folder, made_up_frames(20, 10.0), {1, 2, {}}, info);
    write_png(folder / "picture-00003.png", made_up_picture(20, 10, 3).view());
}

} // namespace

TEST_CASE("a packed recording is the same wherever it is unpacked, and the same bytes each time") {
    const ScratchFolder scratch;
    record(scratch / "rec");
    write_file(scratch / "rec/notes.txt", "mine");
    const PackResult packing = pack_recording(scratch / "rec", scratch / "a.zip", false);
    CHECK(packing.files == 7);
    REQUIRE(packing.notes.size() == 1);
    CHECK_THAT(packing.notes[0], Contains("map.bil does not lie in the recording"));
    pack_recording(scratch / "rec", scratch / "b.zip", false);
    CHECK(read_file(scratch / "a.zip") == read_file(scratch / "b.zip"));

    const LoadedRecording before = load_recording(scratch / "rec");
    const LoadedRecording after = load_recording(scratch / "a.zip");
    const fs::path folder = after.folder.path;
    CHECK(after.name == "a");
    CHECK(after.statistics == before.statistics);
    CHECK(after.pictures.size() == 1);
    CHECK(read_file(folder / "inputs/p.toml") == "legs");
    CHECK(read_file(folder / "picture-00003.png") == read_file(scratch / "rec/picture-00003.png"));
    CHECK_FALSE(fs::exists(folder / "notes.txt"));
}

TEST_CASE("the folder of an unpacked recording goes with its last owner, and with it its name in messages") {
    const ScratchFolder scratch;
    record(scratch / "rec");
    pack_recording(scratch / "rec", scratch / "a.zip", false);
    std::optional<RecordingFolder> one = open_recording(scratch / "a.zip");
    const fs::path folder = one->path;
    const std::string file = (folder / "run.json").string();
    std::optional<RecordingFolder> other = one;
    one.reset();
    CHECK(fs::exists(file));
    CHECK(ui::base::with_path_aliases(file) == (scratch / "a.zip/run.json").string());
    other.reset();
    CHECK_FALSE(fs::exists(folder.parent_path()));
    CHECK(ui::base::with_path_aliases(file) == file);
    CHECK(open_recording(scratch / "rec").path == scratch / "rec");
}

TEST_CASE("what is read out of a packed recording is called by the packed file") {
    const ScratchFolder scratch;
    record(scratch / "rec");
    pack_recording(scratch / "rec", scratch / "a.zip", false);
    fs::create_directory(scratch / "other");
    fs::copy_file(scratch / "a.zip", scratch / "other/a.zip");
    const std::vector<LoadedRecording> both = {
        load_recording(scratch / "a.zip"), load_recording(scratch / "other/a.zip")};
    CHECK(both[0].display_name == (scratch / "a.zip").string());
    CHECK(both[1].display_name == (scratch / "other/a.zip").string());
    const std::string page = html_report(both, {.folder = scratch / "there"});
    CHECK_THAT(page, Contains(both[0].display_name) && Contains(both[1].display_name));
    CHECK_THAT(page, !Contains(both[0].folder.path.string()) && !Contains(both[1].folder.path.string()));
    CHECK(load_recording(scratch / "rec").display_name == (scratch / "rec").string());
}

TEST_CASE("a terrain is packed where that is asked for, with what belongs to it") {
    const ScratchFolder scratch;
    record(scratch / "rec");
    CHECK(pack_recording(scratch / "rec", scratch / "a.zip", true).notes.empty());
    const RecordingFolder opened = open_recording(scratch / "a.zip");
    const fs::path& folder = opened.path;
    const auto run = nlohmann::json::parse(read_file(folder / "run.json"));
    CHECK(run["settings"]["terrain"] == "inputs/terrain/map.bil");
    CHECK(read_file(folder / "inputs/terrain/map.bil") == "heights");
    CHECK(read_file(folder / "inputs/terrain/map.hdr") == "their size");
}

TEST_CASE("files that are no packed recordings are refused and write nothing") {
    const ScratchFolder scratch;
    record(scratch / "rec");
    int files = 0; // each under a name of its own: the library keeps what it knows of a name
    const auto zip_with = [&](const auto&... bytes) {
        const fs::path zip = scratch / fmt::format("{}.zip", files++);
        (write_file(zip, bytes), ...);
        return zip;
    };
    const auto recording_with = [&](const std::string& name) {
        const fs::path zip = zip_with();
        ZipWriter writer(zip);
        if (name != "frames.csv") { writer.add("run.json", R"({"format":"octant recording"})"); }
        writer.add(name, "bytes");
        writer.finish();
        return zip;
    };
    CHECK_THROWS_WITH(open_recording(recording_with("evil.txt")), Contains("expected only the files of a recording"));
    for (const std::string name : {"../evil", "inputs/../../evil"}) { // the library leaves them out
        CHECK_FALSE(fs::exists(open_recording(recording_with(name)).path.parent_path() / "evil"));
    }
    CHECK_THROWS_WITH(open_recording(recording_with("frames.csv")), Contains("got one without run.json"));
    CHECK_THROWS_WITH(open_recording(zip_with("PK is how they begin")), Contains("expected a zip file"));
    pack_recording(scratch / "rec", scratch / "whole.zip", false);
    std::string bytes = read_file(scratch / "whole.zip");
    CHECK_THROWS_AS(open_recording(zip_with(bytes.substr(0, bytes.size() / 2))), Error);
    bytes[bytes.size() / 3] = static_cast<char>(bytes[bytes.size() / 3] ^ 0x55);
    const fs::path zip = zip_with(bytes);
    CHECK_THROWS_AS(open_recording(zip), Error);
    CHECK_THROWS_AS(pack_recording(scratch / "nothing", zip, false), Error);
    const FolderLock lock(scratch / "rec");
    CHECK_THROWS_WITH(pack_recording(scratch / "rec", zip, false), Contains("got one that is being written"));
}
