#include "ui/terrain/map_picture.h"

#include "visuals/overlay/stroke_font.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::terrain {

namespace {

constexpr double longest_side_px = 900.0;
constexpr int margin_px = 12;
constexpr int legend_px = 120; ///< width of the legend
constexpr int bar_px = 18;     ///< width of its bar
constexpr int letter_px = 2;   ///< of a step of the letters' grid
constexpr glm::vec3 background_colour(0.97F, 0.97F, 0.96F);
constexpr glm::vec3 text_colour(0.10F, 0.10F, 0.12F);
constexpr glm::vec3 red(0.86F, 0.06F, 0.10F);

/// From the lowest to the highest.
constexpr std::array<glm::vec3, 6> tints = {{
    {0.36F, 0.55F, 0.40F},
    {0.62F, 0.72F, 0.44F},
    {0.88F, 0.82F, 0.55F},
    {0.76F, 0.58F, 0.38F},
    {0.62F, 0.47F, 0.40F},
    {0.96F, 0.95F, 0.95F},
}};

glm::vec3 tint_of(double share) {
    const double at = std::clamp(share, 0.0, 1.0) * (tints.size() - 1.0);
    const std::size_t low = std::min(static_cast<std::size_t>(at), tints.size() - 2);
    return glm::mix(tints.at(low), tints.at(low + 1), static_cast<float>(at) - static_cast<float>(low));
}

class Canvas {
public:
    Canvas(int width_px, int height_px) : picture_{width_px, height_px, 3, {}} {
        picture_.bytes.resize(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * 3);
        for (int y = 0; y < height_px; ++y) {
            for (int x = 0; x < width_px; ++x) { put(x, y, background_colour); }
        }
    }

    /// Nothing outside the picture.
    void put(int x, int y, const glm::vec3& colour) {
        if (x < 0 || y < 0 || x >= picture_.width_px || y >= picture_.height_px) { return; }
        const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width_px) +
                                       static_cast<std::size_t>(x));
        for (int channel = 0; channel < 3; ++channel) {
            picture_.bytes[at + static_cast<std::size_t>(channel)] =
                static_cast<std::byte>(std::lround(255.0F * glm::clamp(colour[channel], 0.0F, 1.0F)));
        }
    }

    /// Two pixels thick.
    void line(const glm::dvec2& from, const glm::dvec2& to, const glm::vec3& colour) {
        const int steps = std::max(1, static_cast<int>(std::ceil(2.0 * glm::distance(from, to))));
        for (int i = 0; i <= steps; ++i) {
            const glm::ivec2 at(glm::round(glm::mix(from, to, static_cast<double>(i) / steps)));
            for (const glm::ivec2 by : {glm::ivec2(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
                put(at.x + by.x, at.y + by.y, colour);
            }
        }
    }

    void ring(const glm::dvec2& middle, double radius_px, const glm::vec3& colour) {
        constexpr int corners = 32;
        const auto corner = [&](int i) {
            const double angle = i * 2.0 * 3.141592653589793 / corners;
            return middle + radius_px * glm::dvec2(std::cos(angle), std::sin(angle));
        };
        for (int i = 0; i < corners; ++i) { line(corner(i), corner(i + 1), colour); }
    }

    /// Digits, capitals and a few signs from the lower left corner on.
    void text(const glm::dvec2& lower_left, std::string_view words, const glm::vec3& colour) {
        glm::dvec2 at = lower_left;
        for (const char letter : words) {
            glm::dvec2 before = at;
            for (const auto& point : visuals::overlay::glyph_strokes(letter)) {
                const glm::dvec2 next = at + static_cast<double>(letter_px) * glm::dvec2(point.x, -point.y);
                line(point.begins_stroke ? next : before, next, colour);
                before = next;
            }
            at.x += visuals::overlay::glyph_advance * letter_px;
        }
    }

    report::Picture take() { return std::move(picture_); }

private:
    report::Picture picture_;
};

/// Where the map lies in the picture.
struct MapFrameInPicture {
    const visuals::terrain::GroundSamples& ground;
    double px_per_sample = 1.0;
    int width_px = 1;
    int height_px = 1;

    /// Bilinear, at a pixel's middle.
    double height_m(double x_px, double y_px) const {
        const double column = std::clamp(x_px / px_per_sample - 0.5, 0.0, ground.columns() - 1.001);
        const double row = std::clamp((height_px - y_px) / px_per_sample - 0.5, 0.0, ground.rows() - 1.001);
        return models::heights::bilinear_height_at_sample(ground, {column, row});
    }

    glm::dvec2 pixel_of(const glm::dvec2& place_m) const {
        const glm::dvec2 grid = ground.grid_from_world(place_m.x, place_m.y) + 0.5;
        return {margin_px + grid.x * px_per_sample, margin_px + height_px - grid.y * px_per_sample};
    }
};

MapFrameInPicture map_frame_of(const visuals::terrain::GroundSamples& ground) {
    const double scale = longest_side_px / std::max(ground.columns(), ground.rows());
    const auto pixels = [scale](int samples) { return std::max(1, static_cast<int>(std::lround(scale * samples))); };
    return {ground, scale, pixels(ground.columns()), pixels(ground.rows())};
}

/// The range of the colours.
glm::dvec2 colour_range_m(const MapFrameInPicture& sheet) {
    std::vector<double> heights_m;
    for (int y = 0; y < sheet.height_px; y += 2) {
        for (int x = 0; x < sheet.width_px; x += 2) { heights_m.push_back(sheet.height_m(x + 0.5, y + 0.5)); }
    }
    std::ranges::sort(heights_m);
    const std::size_t cut = heights_m.size() / 200;
    return {heights_m[cut], heights_m[heights_m.size() - 1 - cut]};
}

void draw_relief(const MapFrameInPicture& sheet, const glm::dvec2& range_m, Canvas& canvas) {
    const double relief_m = std::max(range_m.y - range_m.x, 1e-3);
    const double pixel_m = sheet.ground.spacing_m() / sheet.px_per_sample;
    const double extent_m = pixel_m * std::max(sheet.width_px, sheet.height_px);
    // Gentle ground is exaggerated, so that its slopes show.
    const double exaggeration = std::clamp(0.25 * extent_m / relief_m, 1.0, 40.0);
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(-1.0, 1.0, 1.2));
    const double step_px = std::max(1.0, 0.5 * sheet.px_per_sample);
    for (int y = 0; y < sheet.height_px; ++y) {
        for (int x = 0; x < sheet.width_px; ++x) {
            const glm::dvec2 at(x + 0.5, y + 0.5);
            const double across_m = 2.0 * step_px * pixel_m / exaggeration;
            const glm::dvec3 normal =
                glm::normalize(glm::dvec3(sheet.height_m(at.x - step_px, at.y) - sheet.height_m(at.x + step_px, at.y),
                    sheet.height_m(at.x, at.y + step_px) - sheet.height_m(at.x, at.y - step_px), across_m));
            const double light = 0.35 + 0.95 * std::max(0.0, glm::dot(normal, to_sun));
            const double share = (sheet.height_m(at.x, at.y) - range_m.x) / relief_m;
            canvas.put(margin_px + x, margin_px + y, tint_of(share) * static_cast<float>(light));
        }
    }
}

void draw_legend(const MapFrameInPicture& sheet, const glm::dvec2& range_m, Canvas& canvas) {
    const int left_px = 2 * margin_px + sheet.width_px;
    constexpr int ticks = 4;
    for (int y = 0; y < sheet.height_px; ++y) {
        const glm::vec3 tint = tint_of(1.0 - (y + 0.5) / sheet.height_px);
        for (int x = 0; x < bar_px; ++x) { canvas.put(left_px + x, margin_px + y, tint); }
    }
    constexpr double half_letter_px = 0.5 * letter_px * visuals::overlay::glyph_height;
    for (int i = 0; i <= ticks; ++i) {
        const double share = static_cast<double>(i) / ticks;
        const double y_px = margin_px + (1.0 - share) * (sheet.height_px - 1);
        const double right_px = left_px + bar_px;
        canvas.line({right_px, y_px}, {right_px + 4.0, y_px}, text_colour);
        const double inside_px =
            std::clamp(y_px, margin_px + half_letter_px, margin_px + sheet.height_px - half_letter_px);
        canvas.text({right_px + 9.0, inside_px + half_letter_px},
            fmt::format("{}{}", std::lround(glm::mix(range_m.x, range_m.y, share)), i == ticks ? " M" : ""),
            text_colour);
    }
}

void draw_marks(const MapFrameInPicture& sheet, std::span<const models::heights::MapNote> notes, Canvas& canvas) {
    constexpr double radius_px = 12.0;
    for (std::size_t i = 0; i < notes.size(); ++i) {
        const std::vector<glm::dvec2>& places_m = notes[i].places_m;
        std::optional<glm::dvec2> last; // rings of a long seam leave it to be seen
        for (const glm::dvec2& place_m : places_m) {
            const glm::dvec2 at = sheet.pixel_of(place_m);
            if (!last || glm::distance(at, *last) >= 4.0 * radius_px) {
                canvas.ring(at, radius_px, red);
                last = at;
            }
        }
        if (!places_m.empty()) {
            const glm::dvec2 at = sheet.pixel_of(places_m[places_m.size() / 2]);
            const std::string number = fmt::format("{}", i + 1);
            const double width_px = letter_px * visuals::overlay::text_width(number.size());
            const double x_px = std::clamp(at.x + radius_px + 5.0, 0.0, margin_px + sheet.width_px - width_px - 2.0);
            canvas.text({x_px, std::max(at.y - 4.0, 2.0 * margin_px)}, number, red);
        }
    }
}

} // namespace

report::Picture map_picture(
    const visuals::terrain::GroundSamples& ground, std::span<const models::heights::MapNote> notes) {
    const MapFrameInPicture sheet = map_frame_of(ground);
    const glm::dvec2 range_m = colour_range_m(sheet);
    Canvas canvas(3 * margin_px + sheet.width_px + legend_px, 2 * margin_px + sheet.height_px);
    draw_relief(sheet, range_m, canvas);
    draw_legend(sheet, range_m, canvas);
    draw_marks(sheet, notes, canvas);
    return canvas.take();
}

} // namespace octant::ui::terrain
