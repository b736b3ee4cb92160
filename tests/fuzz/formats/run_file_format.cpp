#include "tests/fuzz/formats/target.h"
#include "ui/report/run_file.h"
#include "ui/settings/settings_file.h"

#include <nlohmann/json.hpp>

namespace octant::tests::formats::run_file_format {

namespace {

/// A run file is read for its report, and for its settings to fly them again.
void use(const std::filesystem::path& file) {
    ui::report::is_run_file(file);
    ui::report::read_run_file(file);
    ui::settings::read_settings(file);
}

std::vector<std::string> seeds() {
    ui::report::RunInfo info;
    info.title = "a flight";
    info.settings_json = ui::settings::settings_json({}).dump();
    info.version = "0.1.0";
    info.commit = "abc1234";
    info.device = "some, renderer";
    info.path_offset_m = {0.0, 0.0, 412.5};
    info.machine.cpu = "cpu, fast";
    info.machine.cores = 2;
    info.machine.memory_kb = 1024;
    info.facts = {{"lowest height", "61 m"}};
    info.notes = {"a note"};
    info.inputs = {{"a.obj", "0123456789abcdef"}};
    ui::report::RunSummary end;
    end.state_hash = 12345;
    end.picture_hash = 6789;
    end.cpu_times = {1000, 500, 10, 100};
    return {ui::report::run_json(info), ui::report::run_json(info, end, {})};
}

const Registered target({
    .name = "run_file",
    .file = "run.json",
    .use = use,
    .seeds = seeds,
    .words = {"\"cores\":", "\"settings\":", "\"machine\":", "\"summary\":", "\"path_offset_m\":", "null", "[]", "{}",
        "true", "1e308", "\"\\u0000\"", "\"\\ud800\"", "\"f15\""},
});

} // namespace

} // namespace octant::tests::formats::run_file_format
