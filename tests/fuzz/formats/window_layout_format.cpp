#include "sim/base/text_file.h"
#include "tests/fuzz/formats/target.h"
#include "ui/window/panel_columns.h"

namespace octant::tests::formats::window_layout_format {

namespace {

/// Takes anything; what it kept is the same when it is written and read again.
void use(const std::filesystem::path& file) {
    namespace window = ui::window;
    const std::string kept = window::text_of_layout(window::layout_from(read_file(file)));
    expect(window::text_of_layout(window::layout_from(kept)) == kept, "the same layout again");
}

std::vector<std::string> seeds() {
    const std::string panels = ui::window::text_of_layout({{"Scene", {}}, {"First steps", {}}, {"Terrain", {}}});
    return {panels, "[Table][0x00000001,999999999]\n" + panels, ""};
}

const Registered target({
    .name = "window_layout",
    .file = "layout.ini",
    .use = use,
    .seeds = seeds,
    .words = {"[Window]", "Pos=", "Size=", "[Table][0x1,9]", "nan", "inf", "\n", ","},
});

} // namespace

} // namespace octant::tests::formats::window_layout_format
