#include "ui/studies/draw_order/study_pictures.h"

#include "sim/base/output_file.h"
#include "sim/base/parallel_for.h"
#include "ui/base/progress.h"
#include "ui/flight/session.h"
#include "ui/report/html_text.h"
#include "ui/report/png_file.h"
#include "ui/report/table_text.h"
#include "ui/studies/draw_order/quality_renderer.h"

#include <array>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::studies::draw_order {

namespace scene = visuals::scene;

namespace {

struct StudiedScene {
    const char* path;
    const char* aircraft;
    const char* terrain;
    scene::View view;
    const char* view_name;
    bool textured = false;
};

// The last one stands apart: both renderers light and filter a texture each in its own way.
constexpr std::array studied_scenes{
    StudiedScene{"pop-up", "f15", "canyon", scene::View::Chase, "chase"},
    StudiedScene{"jinking", "f15", "hills", scene::View::Cockpit, "cockpit"},
    StudiedScene{"turn", "500md", "canyon", scene::View::Orbit, "orbit"},
    StudiedScene{"straight", "f15", "hills", scene::View::Tower, "tower"},
    StudiedScene{"straight", "500md", "background60", scene::View::Chase, "chase"},
    StudiedScene{"turn", "f15", "canyon", scene::View::Chase, "chase", true}};

using Qualities = std::array<PictureQuality, render_modes.size()>;

std::string name_of(const StudiedScene& studied) {
    return fmt::format(
        "{}-{}-{}-{}{}",
        studied.path,
        studied.aircraft,
        studied.terrain,
        studied.view_name,
        studied.textured ? "-textured" : "");
}

settings::RunSettings settings_of(const StudiedScene& studied, const PictureStudyOptions& options) {
    settings::RunSettings settings = options.settings;
    settings.path.name = studied.path;
    settings.path.aircraft = {studied.aircraft};
    settings.path.terrain = studied.terrain;
    settings.view.kind = studied.view;
    if (studied.textured) {
        settings.air.ground_shading = scene::GroundShading::Texture;
    }
    return settings;
}

void write_picture(const scene::Picture& picture, const std::filesystem::path& file) {
    report::write_png(
        file, {picture.width, picture.height, 4, std::as_bytes(std::span(picture.rgba))});
}

void write_pictures(
    const std::string& name, const QualityRenderer& renderer, const std::filesystem::path& out) {
    for (std::size_t mode = 0; mode < render_modes.size(); ++mode) {
        write_picture(
            renderer.picture(mode), out / fmt::format("{}-{}.png", name, render_modes[mode].file_part));
    }
    if (renderer.masks().width > 0) {
        write_picture(renderer.masks(), out / fmt::format("{}-masks.png", name));
    }
}

Qualities measured(const StudiedScene& studied, const PictureStudyOptions& options) {
    const settings::RunSettings settings = settings_of(studied, options);
    auto made = std::make_unique<QualityRenderer>(settings);
    const QualityRenderer& renderer = *made;
    flight::Session session(settings, flight::PictureContent::World, std::move(made));
    base::Progress progress(name_of(studied), options.frames, options.quiet);
    for (int i = 0; i < options.frames; ++i) {
        session.draw((2 * i + 1) * session.frames() / (2 * options.frames));
        progress.show(i + 1);
    }
    progress.finish();
    write_pictures(name_of(studied), renderer, options.out);
    return renderer.quality();
}

std::vector<std::string> noise_cells(const std::string& name, const Qualities& qualities) {
    std::vector<std::string> cells{name};
    for (const PictureQuality& one : qualities) {
        cells.push_back(fmt::format("{:.1f}", one.db_to_own()));
    }
    cells.push_back(fmt::format(
        "{:+.1f}",
        qualities[raster_sixteen_samples].db_to_own() - qualities[gl_four_samples].db_to_own()));
    return cells;
}

report::HtmlTable
scene_table(const std::vector<Qualities>& of_scenes, const PictureStudyOptions& options) {
    report::HtmlTable table;
    table.title = "Peak signal to noise against 8 x 8 samples a pixel, dB";
    table.header = {"scene"};
    for (const RenderMode& mode : render_modes) {
        table.header.emplace_back(mode.name);
    }
    table.header.emplace_back("raster 16 over OpenGL 4");
    for (std::size_t i = 0; i < of_scenes.size(); ++i) {
        table.rows.push_back(noise_cells(name_of(studied_scenes[i]), of_scenes[i]));
    }
    table.note = fmt::format(
        "{} frames of each path, {}x{}. Against a picture by the same renderer with one sample a "
        "pixel, eight times as large in both directions. Head-up displays are left out.",
        options.frames,
        options.settings.view.size_px.x,
        options.settings.view.size_px.y);
    return table;
}

/// Of all scenes without a texture.
report::HtmlTable mode_table(const std::vector<Qualities>& of_scenes) {
    Qualities sums;
    for (std::size_t i = 0; i < of_scenes.size(); ++i) {
        for (std::size_t mode = 0; mode < render_modes.size() && !studied_scenes[i].textured; ++mode) {
            sums[mode].add(of_scenes[i][mode]);
        }
    }
    report::HtmlTable table;
    table.title = "All scenes without a texture";
    table.header = {
        "way",
        "PSNR to its own 8 x 8, dB",
        "PSNR to OpenGL's 8 x 8, dB",
        "largest error, levels",
        "pixels that change falsely",
        "against OpenGL 4"};
    const auto of_four = static_cast<double>(sums[gl_four_samples].false_changes);
    for (std::size_t mode = 0; mode < render_modes.size(); ++mode) {
        const PictureQuality& one = sums[mode];
        table.rows.push_back(
            {std::string(render_modes[mode].name),
             fmt::format("{:.1f}", one.db_to_own()),
             fmt::format("{:.1f}", one.db_to_gl()),
             fmt::format("{:.0f}", one.largest_error),
             fmt::format("{}", one.false_changes),
             fmt::format("{:.3f}", static_cast<double>(one.false_changes) / of_four)});
    }
    table.note = "Falsely: by more than 16 levels more or less than 8 x 8 samples change, when the "
                 "picture moves half a pixel to the right, and when it moves half a pixel down.";
    return table;
}

} // namespace

void study_pictures(const PictureStudyOptions& options) {
    make_folder(options.out);
    std::vector<Qualities> of_scenes(studied_scenes.size());
    PictureStudyOptions of_scene = options;
    of_scene.quiet = options.quiet || options.jobs > 1; // progress of one at a time only
    parallel_for(of_scenes.size(), options.jobs, [&](std::size_t i, std::size_t /*worker*/) {
        of_scenes[i] = measured(studied_scenes[i], of_scene);
    });
    const std::array tables{scene_table(of_scenes, options), mode_table(of_scenes)};
    const std::string markdown =
        report::markdown_of(tables[0]) + "\n" + report::markdown_of(tables[1]);
    write_file(options.out / "scenes.csv", report::csv_of(tables[0]));
    write_file(options.out / "ways.csv", report::csv_of(tables[1]));
    write_file(options.out / "pictures.md", markdown);
    std::fputs((options.json ? report::json_of(tables) : markdown).c_str(), stdout);
    base::print_note(
        options.quiet,
        fmt::format("tables: {0}/pictures.md; pictures: {0}/*.png", options.out.string()));
}

} // namespace octant::ui::studies::draw_order
