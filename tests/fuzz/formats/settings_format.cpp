#include "sim/base/output_file.h"
#include "tests/fuzz/formats/target.h"
#include "ui/settings/settings_file.h"

#include <nlohmann/json.hpp>

namespace octant::tests::formats::settings_format {

namespace {

namespace settings = ui::settings;

/// Settings that were taken are the same when they are written and read again.
void use(const std::filesystem::path& file) {
    const std::string text = settings::settings_json(settings::read_settings(file)).dump();
    const std::filesystem::path written = file.parent_path() / "again.json";
    write_file(written, text);
    expect(settings::settings_json(settings::read_settings(written)).dump() == text, "the same again");
}

const Registered target({
    .name = "settings",
    .file = "settings.json",
    .use = use,
    .seeds =
        [] {
            return std::vector<std::string>{
                "{}", settings::settings_json({}).dump(), settings::settings_json({}).dump(1)};
        },
    .words = {"null", "\"\"", "[]", "{}", "true", "1e308", "-1", "\"f15\"", "\"canyon\"", "\"#ff0000\"", "[0,0,0]",
        "\"\\u0000\""},
});

} // namespace

} // namespace octant::tests::formats::settings_format
