#include "sim/base/thread_pool.h"
#include "ui/base/progress.h"
#include "ui/flight/renderer_choice.h"
#include "ui/flight/session.h"
#include "ui/report/png_file.h"
#include "ui/settings/settings.h"
#include "ui/studies/draw_order/study_draw_order.h"
#include "ui/studies/draw_order/study_renderer.h"
#include "visuals/raster/mask_picture.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/picture.h"
#include "visuals/scene/renderer.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::studies::draw_order {

namespace {

namespace scene = visuals::scene;

/// A copy of a plan whose picture, of `size_px` pixels, lies `by_px` further right and down, and has nothing drawn over
/// it.
scene::FramePlan shifted_plan(const scene::FramePlan& plan, const glm::dvec2& by_px, const glm::ivec2& size_px) {
    scene::FramePlan result = plan;
    const glm::vec2 by(2.0 * by_px / glm::dvec2(size_px));
    for (glm::length_t column = 0; column < 4; ++column) {
        glm::vec4& clip = result.view_to_clip[column];
        clip.x += by.x * clip.w;
        clip.y -= by.y * clip.w;
    }
    std::erase_if(
        result.steps, [](const scene::PaintStep& step) { return step.content == scene::PaintStep::Content::Overlay; });
    return result;
}

/// A copy of a plan that shows one of side x side equal parts of its picture, as large as the whole.
scene::FramePlan part_of(const scene::FramePlan& plan, const glm::ivec2& part, int side) {
    scene::FramePlan result = plan;
    const glm::vec2 across = (2.0F * glm::vec2(part) + 1.0F) / static_cast<float>(side);
    const glm::vec2 middle(across.x - 1.0F, 1.0F - across.y);
    for (glm::length_t column = 0; column < 4; ++column) {
        glm::vec4& clip = result.view_to_clip[column];
        clip.x = static_cast<float>(side) * (clip.x - middle.x * clip.w);
        clip.y = static_cast<float>(side) * (clip.y - middle.y * clip.w);
    }
    return result;
}

/// A picture of 8 x 8 samples a pixel: drawn eight times as large in both directions, in 64 parts, so that textures are
/// filtered for the small pixels, too. The sum of all 64, red, green and blue of each pixel, rows from the top. For
/// plans that use no depth.
class Supersampled {
public:
    static constexpr int side = 8;
    static constexpr int samples_per_pixel = side * side;

    /// `renderer` draws one sample a pixel at pictures of that size.
    void draw(
        scene::Renderer& renderer, const scene::FramePlan& plan, const glm::dvec2& by_px, const glm::ivec2& size_px) {
        const auto width = static_cast<std::size_t>(size_px.x);
        const auto height = static_cast<std::size_t>(size_px.y);
        sums_.assign(3 * width * height, 0);
        const scene::FramePlan whole = shifted_plan(plan, by_px, size_px);
        for (int part = 0; part < samples_per_pixel; ++part) {
            const glm::ivec2 at(part % side, part / side);
            renderer.draw(part_of(whole, at, side));
            renderer.finish_and_read(picture_);
            const auto first_column = static_cast<std::size_t>(at.x) * width;
            const auto first_row = static_cast<std::size_t>(at.y) * height;
            for (std::size_t i = 0; i < width * height; ++i) {
                const std::size_t column = (first_column + i % width) / side;
                const std::size_t row = (first_row + i / width) / side;
                std::uint16_t* const sum = sums_.data() + 3 * (row * width + column);
                for (std::size_t k = 0; k < 3; ++k) {
                    sum[k] = static_cast<std::uint16_t>(sum[k] + picture_.rgba[4 * i + k]);
                }
            }
        }
    }

    /// A part of a pixel's colour in levels; `part` counts on from three for each pixel.
    double level(std::size_t part) const { return static_cast<double>(sums_[part]) / samples_per_pixel; }

    std::size_t parts() const { return sums_.size(); }

private:
    std::vector<std::uint16_t> sums_;
    scene::Picture picture_;
};

/// A renderer with a number of samples a pixel.
struct RenderMode {
    std::string_view name;
    std::string_view file_part;
    settings::RendererKind renderer;
    int samples;
};

/// Whose pictures are measured, in this order everywhere.
constexpr std::array render_modes{RenderMode{"OpenGL, 1 sample", "gl-1", settings::RendererKind::Gl, 1},
    RenderMode{"OpenGL, 4 samples", "gl-4", settings::RendererKind::Gl, 4},
    RenderMode{"raster, 1 sample", "raster-1", settings::RendererKind::Raster, 1},
    RenderMode{"raster, 4 samples", "raster-4", settings::RendererKind::Raster, 4},
    RenderMode{"raster, 16 samples", "raster-16", settings::RendererKind::Raster, 16}};
constexpr std::size_t gl_one_sample = 0; ///< indices into render_modes
constexpr std::size_t gl_four_samples = 1;
constexpr std::size_t raster_one_sample = 2;
constexpr std::size_t raster_sixteen_samples = 4;

constexpr double white_level = 255.0;
constexpr double false_change = 16.0; ///< levels
constexpr std::array shifts_px{glm::dvec2(0.0), glm::dvec2(0.5, 0.0), glm::dvec2(0.0, 0.5)};

double decibels(double squares, double parts) {
    return squares > 0.0 ? 10.0 * std::log10(white_level * white_level * parts / squares)
                         : std::numeric_limits<double>::infinity();
}

/// How far the pictures of one way are from what 8 x 8 samples a pixel show. Sums over pictures.
struct PictureQuality {
    /// From supersampled pictures by OpenGL, and by the way's own renderer.
    double squares_to_gl = 0.0;
    double squares_to_own = 0.0;
    double parts = 0.0;         ///< red, green and blue of each pixel
    double largest_error = 0.0; ///< levels, from its own
    /// Pixels that change by more than 16 levels too much or too little when the picture moves by half a pixel, once
    /// right and once down.
    long false_changes = 0;

    double db_to_gl() const { return decibels(squares_to_gl, parts); }

    double db_to_own() const { return decibels(squares_to_own, parts); }

    void add(const PictureQuality& other) {
        squares_to_gl += other.squares_to_gl;
        squares_to_own += other.squares_to_own;
        parts += other.parts;
        largest_error = std::max(largest_error, other.largest_error);
        false_changes += other.false_changes;
    }
};

double level(const scene::Picture& picture, std::size_t part) { return picture.rgba[4 * (part / 3) + part % 3]; }

/// Pixels whose change from one picture to the other differs from that of the references.
long false_changes(const scene::Picture& before, const scene::Picture& after, const Supersampled& true_before,
    const Supersampled& true_after) {
    long count = 0;
    for (std::size_t pixel = 0; pixel < true_before.parts() / 3; ++pixel) {
        double worst = 0.0;
        for (std::size_t part = 3 * pixel; part < 3 * pixel + 3; ++part) {
            const double change = level(after, part) - level(before, part);
            const double should = true_after.level(part) - true_before.level(part);
            worst = std::max(worst, std::abs(change - should));
        }
        count += worst > false_change ? 1 : 0;
    }
    return count;
}

/// In place of a session's renderer: draws each plan in all ways and measures their pictures; the session's own picture
/// is that of the last way. Whatever is drawn over the picture is left out.
class QualityRenderer final : public StudyRenderer {
public:
    /// Throws Error.
    explicit QualityRenderer(const settings::RunSettings& settings) : size_px_(settings.view.size_px) {
        for (const RenderMode& mode : render_modes) {
            settings::RunSettings own = settings;
            own.drawing.renderer = mode.renderer;
            own.view.samples = mode.samples;
            renderers_.push_back(flight::make_renderer(own));
        }
        info_ = renderers_.back()->info();
    }

    /// Of all plans drawn so far.
    const std::array<PictureQuality, render_modes.size()>& quality() const { return quality_; }

    /// Of the last plan.
    const scene::Picture& picture(std::size_t mode) const { return pictures_[mode]; }

    /// visuals::raster::mask_picture() of the last plan without a ground texture.
    const scene::Picture& masks() const { return masks_; }

    void load_models(std::span<const scene::ModelBuffers> models) override {
        models_.assign(models.begin(), models.end());
        StudyRenderer::load_models(models);
    }

    void draw(const scene::FramePlan& plan) override {
        for (std::size_t position = 0; position < positions; ++position) {
            by_gl_[position].draw(*renderers_[gl_one_sample], plan, shifts_px[position], size_px_);
            by_raster_[position].draw(*renderers_[raster_one_sample], plan, shifts_px[position], size_px_);
        }
        for (std::size_t mode = 0; mode < render_modes.size(); ++mode) { measure(mode, plan); }
        if (!plan.ground_texture) { masks_ = visuals::raster::mask_picture(plan, models_, size_px_, workers_); }
    }

    void finish_and_read(scene::Picture& picture) override { picture = pictures_.back(); }

private:
    static constexpr std::size_t positions = 3; ///< in place, half a pixel right, half a pixel down
    using References = std::array<Supersampled, positions>;

    const References& own_references(std::size_t mode) const {
        return render_modes[mode].renderer == settings::RendererKind::Gl ? by_gl_ : by_raster_;
    }

    void measure(std::size_t mode, const scene::FramePlan& plan) {
        std::array<scene::Picture, positions> drawn;
        for (std::size_t position = 0; position < positions; ++position) {
            renderers_[mode]->draw(shifted_plan(plan, shifts_px[position], size_px_));
            renderers_[mode]->finish_and_read(drawn[position]);
        }
        const References& own = own_references(mode);
        PictureQuality quality;
        for (std::size_t part = 0; part < own[0].parts(); ++part) {
            const double here = level(drawn[0], part);
            const double to_own = here - own[0].level(part);
            const double to_gl = here - by_gl_[0].level(part);
            quality.squares_to_own += to_own * to_own;
            quality.squares_to_gl += to_gl * to_gl;
            quality.largest_error = std::max(quality.largest_error, std::abs(to_own));
        }
        quality.parts = static_cast<double>(own[0].parts());
        for (std::size_t position = 1; position < positions; ++position) {
            quality.false_changes += false_changes(drawn[0], drawn[position], own[0], own[position]);
        }
        quality_[mode].add(quality);
        pictures_[mode] = std::move(drawn[0]);
    }

    glm::ivec2 size_px_;
    std::array<PictureQuality, render_modes.size()> quality_;
    std::array<scene::Picture, render_modes.size()> pictures_;
    std::vector<scene::ModelBuffers> models_;
    ThreadPool workers_{1};
    scene::Picture masks_;
    References by_gl_;
    References by_raster_;
};

struct StudiedScene {
    const char* path;
    const char* aircraft;
    const char* terrain;
    scene::View view;
    const char* view_name;
    bool textured = false;
};

// The last one stands apart: both renderers light and filter a texture each in its own way.
constexpr std::array studied_scenes{StudiedScene{"pop-up", "f15", "canyon", scene::View::Chase, "chase"},
    StudiedScene{"jinking", "f15", "hills", scene::View::Cockpit, "cockpit"},
    StudiedScene{"turn", "500md", "canyon", scene::View::Orbit, "orbit"},
    StudiedScene{"straight", "f15", "hills", scene::View::Tower, "tower"},
    StudiedScene{"straight", "500md", "background60", scene::View::Chase, "chase"},
    StudiedScene{"turn", "f15", "canyon", scene::View::Chase, "chase", true}};

using Qualities = std::array<PictureQuality, render_modes.size()>;

std::string name_of(const StudiedScene& studied) {
    return fmt::format("{}-{}-{}-{}{}", studied.path, studied.aircraft, studied.terrain, studied.view_name,
        studied.textured ? "-textured" : "");
}

settings::RunSettings settings_of(const StudiedScene& studied, const PictureStudyOptions& options) {
    settings::RunSettings settings = options.settings;
    settings.path.name = studied.path;
    settings.path.aircraft = {studied.aircraft};
    settings.path.terrain = studied.terrain;
    settings.view.kind = studied.view;
    if (studied.textured) { settings.air.ground_shading = scene::GroundShading::Texture; }
    return settings;
}

void write_picture(const scene::Picture& picture, const std::filesystem::path& file) {
    report::write_png(file, {picture.width, picture.height, 4, std::as_bytes(std::span(picture.rgba))});
}

void write_pictures(const std::string& name, const QualityRenderer& renderer, const std::filesystem::path& out) {
    for (std::size_t mode = 0; mode < render_modes.size(); ++mode) {
        write_picture(renderer.picture(mode), out / fmt::format("{}-{}.png", name, render_modes[mode].file_part));
    }
    if (renderer.masks().width > 0) { write_picture(renderer.masks(), out / fmt::format("{}-masks.png", name)); }
}

Qualities measured(const StudiedScene& studied, const PictureStudyOptions& options, bool quiet) {
    const settings::RunSettings settings = settings_of(studied, options);
    auto made = std::make_unique<QualityRenderer>(settings);
    const QualityRenderer& renderer = *made;
    flight::Session session(settings, flight::PictureContent::World, std::move(made));
    base::Progress progress(name_of(studied), options.frames, quiet);
    for (int i = 0; i < options.frames; ++i) {
        session.draw((2 * i + 1) * session.frames() / (2 * options.frames));
        progress.tick();
    }
    progress.finish();
    write_pictures(name_of(studied), renderer, options.out);
    return renderer.quality();
}

report::ResultTable scene_table(const std::vector<Qualities>& of_scenes, const PictureStudyOptions& options) {
    report::ResultTable table{"Peak signal to noise against 8 x 8 samples a pixel, dB"};
    for (std::size_t i = 0; i < of_scenes.size(); ++i) {
        const Qualities& qualities = of_scenes[i];
        std::vector<report::Cell> row = {{"scene", name_of(studied_scenes[i])}};
        for (std::size_t mode = 0; mode < render_modes.size(); ++mode) {
            row.push_back({std::string(render_modes[mode].name), "{:.1f}", qualities[mode].db_to_own()});
        }
        row.push_back({"raster 16 over OpenGL 4", "{:+.1f}",
            qualities[raster_sixteen_samples].db_to_own() - qualities[gl_four_samples].db_to_own()});
        table.add(std::move(row));
    }
    table.note = fmt::format("{} frames of each path, {}x{}. Against a picture by the same renderer with one sample a "
                             "pixel, eight times as large in both directions. Head-up displays are left out.",
        options.frames, options.settings.view.size_px.x, options.settings.view.size_px.y);
    return table;
}

/// Of all scenes without a texture.
report::ResultTable mode_table(const std::vector<Qualities>& of_scenes) {
    Qualities sums;
    for (std::size_t i = 0; i < of_scenes.size(); ++i) {
        for (std::size_t mode = 0; mode < render_modes.size() && !studied_scenes[i].textured; ++mode) {
            sums[mode].add(of_scenes[i][mode]);
        }
    }
    report::ResultTable table{"All scenes without a texture"};
    const auto of_four = static_cast<double>(sums[gl_four_samples].false_changes);
    for (std::size_t mode = 0; mode < render_modes.size(); ++mode) {
        const PictureQuality& one = sums[mode];
        table.add({{"way", render_modes[mode].name}, {"PSNR to its own 8 x 8, dB", "{:.1f}", one.db_to_own()},
            {"PSNR to OpenGL's 8 x 8, dB", "{:.1f}", one.db_to_gl()},
            {"largest error, levels", "{:.0f}", one.largest_error}, {"pixels that change falsely", one.false_changes},
            {"against OpenGL 4", "{:.3f}", static_cast<double>(one.false_changes) / of_four}});
    }
    table.note = "Falsely: by more than 16 levels more or less than 8 x 8 samples change, when the "
                 "picture moves half a pixel to the right, and when it moves half a pixel down.";
    return table;
}

} // namespace

void study_pictures(const PictureStudyOptions& options) {
    Study study(options);
    const std::vector<Qualities> of_scenes = run_cases(studied_scenes, options,
        [&](const StudiedScene& studied, bool quiet) { return measured(studied, options, quiet); });
    study.add("scenes", scene_table(of_scenes, options));
    study.add("ways", mode_table(of_scenes));
    study.finish("pictures");
    base::print_note(options.quiet, fmt::format("pictures: {}/*.png", options.out.string()));
}

} // namespace octant::ui::studies::draw_order
