#include "ui/studies/study.h"

#include "sim/base/nearest_rank.h"
#include "sim/base/output_file.h"
#include "ui/base/progress.h"
#include "ui/flight/renderer_choice.h"
#include "ui/report/html_text.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <utility>

namespace octant::ui::studies {

Study::Study(base::StudyOutput output) : output_(std::move(output)) { make_folder(output_.out); }

void Study::add(const std::string& file, report::ResultTable table) {
    write_file(output_.out / (file + ".csv"), report::csv_of(table));
    tables_.push_back(std::move(table));
}

void Study::add(std::span<const report::Plot> plots, const std::string& caption) {
    std::string html;
    for (const report::Plot& plot : plots) { html += report::page_plot(plot, report::PlotWidth::FullWidth); }
    plots_html_ += report::card_html(html + report::note_html(caption));
}

void Study::add(const std::string& file, const report::PixelView& picture, const std::string& caption) {
    report::write_png(output_.out / file, picture);
    pictures_markdown_ += fmt::format("![{0}]({0})\n\n{1}\n\n", file, caption);
    pictures_html_ += fmt::format("<figure class=\"card\"><img alt=\"{0}\" src=\"{1}\" style=\"width: auto; max-width: "
                                  "100%\"><figcaption>{0}</figcaption></figure>\n",
        report::escaped(caption), report::url_text(file));
}

void Study::finish(const std::string& page, const std::string& introduction) const {
    const std::string markdown = introduction + report::markdown_of(tables_);
    std::string figures = pictures_markdown_.empty() ? "" : "\n" + pictures_markdown_;
    if (!plots_html_.empty()) { figures += fmt::format("\nPlots: [{0}.html]({0}.html)\n", page); }
    write_file(output_.out / (page + ".md"), markdown + figures);
    std::string html = report::page_head(page, "octant study " + page, true);
    for (const report::ResultTable& table : tables_) { html += report::card_html(report::html_of(table)); }
    write_file(output_.out / (page + ".html"), html + plots_html_ + pictures_html_ + report::page_end());
    std::fputs((output_.json ? report::json_of(tables_) : markdown).c_str(), stdout);
    base::print_note(output_.quiet,
        fmt::format("tables: {0}/{1}.md and one .csv each; plots: {0}/{1}.html", output_.out.string(), page));
}

std::unique_ptr<flight::Session> session_of(settings::RunSettings settings, const DrawingMode& mode) {
    settings.drawing.renderer = mode.renderer;
    settings.surface.hidden_surface = mode.hidden_surface;
    if (mode.samples > 0) { settings.view.samples = mode.samples; }
    if (mode.renderer == settings::RendererKind::Gl) { return std::make_unique<flight::Session>(settings); }
    auto renderer = flight::make_raster_renderer(settings);
    renderer->set_paint_direction(mode.paint_direction);
    return std::make_unique<flight::Session>(settings, flight::PictureContent::World, std::move(renderer));
}

double median_of(std::vector<double> values) {
    std::ranges::sort(values);
    return nearest_rank(values, 500);
}

TimedFlight draw_in_turn(const Sessions& sessions, const DrawInTurnOptions& options) {
    TimedFlight flight{.records = std::vector<Records>(sessions.size()), .left_out = options.left_out};
    base::Progress progress(options.name, options.frames, options.quiet);
    for (int frame = 0; frame < options.frames; ++frame) {
        for (std::size_t turn = 0; turn < sessions.size(); ++turn) {
            const std::size_t i = (turn + static_cast<std::size_t>(frame)) % sessions.size();
            flight.records[i].push_back(sessions[i]->draw(frame));
        }
        progress.tick();
        if (options.after_frame && !options.after_frame(frame, flight.records)) { break; }
    }
    return flight;
}

} // namespace octant::ui::studies
