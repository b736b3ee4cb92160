#include "sim/base/output_file.h"
#include "tests/fuzz/formats/target.h"
#include "ui/window/key_map.h"

namespace octant::tests::formats::window_keys_format {

namespace {

/// Wrong lines are told and left out; what was taken is the same when it is written and read again.
void use(const std::filesystem::path& file) {
    const ui::window::KeyMapFile read = ui::window::read_key_map(file);
    for (const std::string& fault : read.errors) {
        expect(fault.starts_with(file.string()), "a fault that names the file, got " + fault);
        expect(fault.find('\n') == fault.npos, "a fault of one line, got " + fault);
    }
    const std::filesystem::path written = file.parent_path() / "again";
    const std::string text = ui::window::text_of_key_map(read.keys);
    write_file(written, text);
    const ui::window::KeyMapFile again = ui::window::read_key_map(written);
    expect(ui::window::text_of_key_map(again.keys) == text, "the same keys again");
}

const Registered target({
    .name = "window_keys",
    .file = "keys",
    .use = use,
    .seeds =
        [] {
            return std::vector<std::string>{ui::window::text_of_key_map({}), "# c\n\n"};
        },
    .words = {" = ", "none", "Space", "F1", "axis ", "reversed", "left", "#", "-1", "99", "\r\n"},
});

} // namespace

} // namespace octant::tests::formats::window_keys_format
