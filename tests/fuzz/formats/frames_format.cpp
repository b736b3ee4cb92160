#include "tests/fuzz/formats/target.h"
#include "ui/report/frame_csv.h"
#include "ui/report/statistics.h"

namespace octant::tests::formats::frames_format {

namespace {

/// Computes the figures of a report, and writes the rows.
void use(const std::filesystem::path& file) {
    const ui::report::FrameFile read = ui::report::read_frame_csv(file);
    const ui::report::Statistics statistics = ui::report::statistics_of(read.records);
    expect(statistics.frames <= static_cast<int>(read.records.size()), "no more frames than rows");
    for (const ui::report::FrameRecord& record : read.records) {
        expect(ui::report::frame_csv_line(record).ends_with('\n'), "a line");
    }
}

std::vector<std::string> seeds() {
    std::string text = ui::report::frame_csv_header();
    std::vector<std::string> all{text};
    for (int frame = 0; frame < 5; ++frame) {
        ui::report::FrameRecord record;
        record.frame = frame;
        record.warm_up = frame < 2;
        record.sim_time_s = frame / 60.0;
        record.frame_ms = 10.0 + 5.0 * frame;
        record.terrain_triangles = 5000;
        record.stress = 0.9;
        text += ui::report::frame_csv_line(record);
    }
    all.push_back(text);
    all.push_back(text.substr(0, text.size() - 20));
    return all;
}

const Registered target({
    .name = "frames",
    .file = "frames.csv",
    .use = use,
    .seeds = seeds,
    .words = {"frame,", "warm_up,", "overrun,", ",,", "\r\n", "-1,", "2147483647"},
});

} // namespace

} // namespace octant::tests::formats::frames_format
