#include "ui/study_draw_order.h"

#include "sim/base/output_file.h"
#include "ui/order_tables.h"
#include "ui/progress.h"
#include "ui/table_text.h"

#include <cstdio>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace octant::ui {

void study_draw_order(const DrawOrderStudyOptions& options) {
    make_folder(options.out);
    std::vector<OrderedInEveryWay> models;
    for (const char* name : {"f15", "500md", "concave"}) {
        say(options.quiet, fmt::format("ordering {} by octants, cells and tree", name));
        models.push_back(order_in_every_way(name));
    }
    std::vector<std::string> files;
    std::vector<report::HtmlTable> tables;
    const auto add = [&](const char* file, report::HtmlTable table) {
        say(options.quiet, fmt::format("{}: {}", file, table.title));
        files.emplace_back(file);
        tables.push_back(std::move(table));
    };
    add("table-4", paper_order_table());
    add("methods", method_table(models));
    add("wrong-pixels", wrong_pixel_table(models));
    add("bsp", bsp_table(models));
    std::string markdown;
    for (std::size_t i = 0; i < tables.size(); ++i) {
        write_file(options.out / (files[i] + ".csv"), csv_of(tables[i]));
        markdown += (i == 0 ? "" : "\n") + markdown_of(tables[i]);
    }
    write_file(options.out / "draw-order.md", markdown);
    std::fputs((options.json ? json_of(tables) : markdown).c_str(), stdout);
    say(options.quiet,
        fmt::format("tables: {0}/draw-order.md and one .csv each", options.out.string()));
}

} // namespace octant::ui
