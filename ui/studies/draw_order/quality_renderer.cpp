#include "ui/studies/draw_order/quality_renderer.h"

#include "ui/flight/make_renderer.h"
#include "visuals/raster/mask_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace octant::ui::studies::draw_order {

namespace scene = visuals::scene;

namespace {

constexpr double white_level = 255.0;
constexpr double false_change = 16.0; ///< levels
constexpr std::array shifts_px{glm::dvec2(0.0), glm::dvec2(0.5, 0.0), glm::dvec2(0.0, 0.5)};

double decibels(double squares, double parts) {
    return squares > 0.0 ? 10.0 * std::log10(white_level * white_level * parts / squares)
                         : std::numeric_limits<double>::infinity();
}

double level(const scene::Picture& picture, std::size_t part) {
    return picture.rgba[4 * (part / 3) + part % 3];
}

/// Pixels whose change from one picture to the other differs from that of the references.
long false_changes(
    const scene::Picture& before,
    const scene::Picture& after,
    const Supersampled& true_before,
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

} // namespace

double PictureQuality::db_to_gl() const {
    return decibels(squares_to_gl, parts);
}

double PictureQuality::db_to_own() const {
    return decibels(squares_to_own, parts);
}

void PictureQuality::add(const PictureQuality& other) {
    squares_to_gl += other.squares_to_gl;
    squares_to_own += other.squares_to_own;
    parts += other.parts;
    largest_error = std::max(largest_error, other.largest_error);
    false_changes += other.false_changes;
}

QualityRenderer::QualityRenderer(const settings::RunSettings& settings)
    : settings_(settings) {
    for (std::size_t mode = 0; mode < render_modes.size(); ++mode) {
        settings::RunSettings own = settings;
        own.drawing.renderer = render_modes[mode].renderer;
        own.view.samples = render_modes[mode].samples;
        renderers_[mode] = flight::make_renderer(own);
    }
    info_ = renderers_.back()->info();
}

std::unique_ptr<scene::Renderer> QualityRenderer::sibling(const glm::ivec2& size_px, int) const {
    settings::RunSettings own = settings_;
    own.view.size_px = size_px;
    return std::make_unique<QualityRenderer>(own);
}

void QualityRenderer::resize(const glm::ivec2& size_px, std::optional<int>) {
    settings_.view.size_px = size_px;
    for (std::size_t mode = 0; mode < render_modes.size(); ++mode) {
        renderers_[mode]->resize(size_px, render_modes[mode].samples);
    }
}

void QualityRenderer::load_models(std::span<const scene::ModelBuffers> models) {
    models_.assign(models.begin(), models.end());
    for (const auto& renderer : renderers_) {
        renderer->load_models(models);
    }
}

void QualityRenderer::load_ground_texture(const scene::GroundTexture& texture) {
    for (const auto& renderer : renderers_) {
        renderer->load_ground_texture(texture);
    }
}

void QualityRenderer::warm_up() {
    for (const auto& renderer : renderers_) {
        renderer->warm_up();
    }
}

void QualityRenderer::draw(const scene::FramePlan& plan) {
    const glm::ivec2& size_px = settings_.view.size_px;
    for (std::size_t position = 0; position < positions; ++position) {
        by_gl_[position].draw(*renderers_[gl_one_sample], plan, shifts_px[position], size_px);
        by_raster_[position].draw(
            *renderers_[raster_one_sample], plan, shifts_px[position], size_px);
    }
    for (std::size_t mode = 0; mode < render_modes.size(); ++mode) {
        measure(mode, plan);
    }
    if (!plan.ground_texture) {
        masks_ = visuals::raster::mask_picture(plan, models_, size_px, workers_);
    }
}

const QualityRenderer::References& QualityRenderer::own_references(std::size_t mode) const {
    return render_modes[mode].renderer == settings::RendererKind::Gl ? by_gl_ : by_raster_;
}

void QualityRenderer::measure(std::size_t mode, const scene::FramePlan& plan) {
    std::array<scene::Picture, positions> drawn;
    for (std::size_t position = 0; position < positions; ++position) {
        renderers_[mode]->draw(shifted_plan(plan, shifts_px[position], settings_.view.size_px));
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

} // namespace octant::ui::studies::draw_order
