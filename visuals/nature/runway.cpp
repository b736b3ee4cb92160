#include "visuals/nature/runway.h"

#include "sim/base/units.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <utility>

namespace octant::visuals::nature {

namespace {

constexpr float line_m = 0.9F; ///< width of lines
// The threshold; its stripes are as wide as AC 150/5340-1 has them, 5.75 feet.
constexpr float threshold_begin_m = 6.0F;
constexpr float threshold_m = 30.0F;
constexpr float stripe_width_m = 1.75F; ///< and as far apart, in the middle twice as far
constexpr int stripes_a_side = 6;       ///< of a runway 45 m wide
// The number: 12 m between markings as in Annex 14; its size is that of the AC.
constexpr float apart_m = 12.0F;
constexpr float digits_begin_m = threshold_begin_m + threshold_m + apart_m;
constexpr float digit_m = 18.3F;
constexpr float digit_width_m = 6.1F;
constexpr float digits_apart_m = 4.6F;
constexpr float stroke_m = 1.5F;
// The centre line: stripe and gap are 50 to 75 m together, the stripe the longer of both.
constexpr float lines_begin_m = digits_begin_m + digit_m + apart_m;
constexpr float dash_m = 30.0F;
constexpr float min_gap_m = 20.0F;
// The aiming point; it is as long, as wide and as far apart as in the AC.
constexpr float aim_begin_m = 300.0F;
constexpr float aim_m = 45.0F;
constexpr float aim_width_m = 9.0F;
constexpr float inner_m = 11.0F; ///< from the middle to its inner side, and to the bars'
// The touchdown zone: pairs every 150 m but at the aiming point; bars as in the AC.
constexpr float bar_m = 22.5F;
constexpr float bar_width_m = 1.8F;
constexpr float bars_apart_m = 1.5F;

struct Bars {
    float begin_m;
    int a_side;
};

constexpr std::array touchdown_zone = {Bars{150.0F, 3}, Bars{450.0F, 2}, Bars{600.0F, 2}};

/// Patches of one end, which is the beginning or, turned by half a circle, the other one.
class End {
public:
    End(std::vector<RunwayRectangle>& patches, float length_m, bool is_other)
        : patches_(patches), length_m_(length_m), is_other_(is_other) {}

    /// On both sides of the middle, so far from it.
    void paint_both(float from_m, float long_m, float near_m, float wide_m) {
        paint({from_m, near_m}, {from_m + long_m, near_m + wide_m});
        paint({from_m, -near_m - wide_m}, {from_m + long_m, -near_m});
    }

    /// Along from this end; left of the middle as it is seen from there.
    void paint(const glm::vec2& min_m, const glm::vec2& max_m) {
        if (is_other_) {
            const glm::vec2 all(length_m_, 0.0F);
            patches_.push_back({all - max_m, all - min_m, true});
        } else {
            patches_.push_back({min_m, max_m, true});
        }
    }

private:
    std::vector<RunwayRectangle>& patches_;
    float length_m_;
    bool is_other_;
};

/// Strokes of digits: bits from the top clockwise around, then the middle one.
constexpr std::array<unsigned, 10> strokes = {0x3f, 0x06, 0x5b, 0x4f, 0x66, 0x6d, 0x7d, 0x07, 0x7f, 0x6f};

/// A digit whose left side lies there. Strokes across take the corners, so that none overlap.
void paint_digit(End& end, int digit, float left_m) {
    const float begin_m = digits_begin_m;
    const float middle_m = begin_m + 0.5F * digit_m;
    const float right_m = left_m - digit_width_m;
    const unsigned own = strokes[static_cast<std::size_t>(digit)];
    if (digit == 1) { // one stroke in the middle of its room
        const float at_m = 0.5F * (left_m + right_m - stroke_m);
        end.paint({begin_m, at_m}, {begin_m + digit_m, at_m + stroke_m});
        return;
    }
    const auto across = [&](unsigned bit, float from_m) {
        if ((own >> bit & 1U) != 0) { end.paint({from_m, right_m}, {from_m + stroke_m, left_m}); }
    };
    const float half_m = 0.5F * stroke_m;
    across(0, begin_m + digit_m - stroke_m);
    across(6, middle_m - half_m);
    across(3, begin_m);
    const bool has_top = (own & 0x01U) != 0;
    const bool has_middle = (own & 0x40U) != 0;
    const bool has_bottom = (own & 0x08U) != 0;
    const auto upright = [&](unsigned bit, bool is_upper, float from_m) {
        if ((own >> bit & 1U) == 0) { return; }
        const float low_m =
            is_upper ? middle_m + (has_middle ? half_m : 0.0F) : begin_m + (has_bottom ? stroke_m : 0.0F);
        const float high_m =
            is_upper ? begin_m + digit_m - (has_top ? stroke_m : 0.0F) : middle_m - (has_middle ? half_m : 0.0F);
        end.paint({low_m, from_m}, {high_m, from_m + stroke_m});
    };
    upright(1, true, right_m);
    upright(2, false, right_m);
    upright(5, true, left_m - stroke_m);
    upright(4, false, left_m - stroke_m);
}

void paint_end(End& end, const std::string& number) {
    for (int stripe = 0; stripe < stripes_a_side; ++stripe) {
        const float near_m = stripe_width_m * static_cast<float>(1 + 2 * stripe);
        end.paint_both(threshold_begin_m, threshold_m, near_m, stripe_width_m);
    }
    const float left_m = 0.5F * digits_apart_m + digit_width_m;
    paint_digit(end, number[0] - '0', left_m);
    paint_digit(end, number[1] - '0', -0.5F * digits_apart_m);
    end.paint_both(aim_begin_m, aim_m, inner_m, aim_width_m);
    for (const Bars& bars : touchdown_zone) {
        for (int bar = 0; bar < bars.a_side; ++bar) {
            const float near_m = inner_m + (bar_width_m + bars_apart_m) * static_cast<float>(bar);
            end.paint_both(bars.begin_m, bar_m, near_m, bar_width_m);
        }
    }
}

/// Even stripes from one number to the other.
void paint_centre_line(float length_m, std::vector<RunwayRectangle>& patches) {
    const float free_m = length_m - 2.0F * lines_begin_m;
    const float dashes = std::floor((free_m + min_gap_m) / (dash_m + min_gap_m));
    const float step_m = dash_m + (free_m - dashes * dash_m) / (dashes - 1.0F);
    for (float dash = 0.0F; dash < dashes; ++dash) {
        const float from_m = lines_begin_m + dash * step_m;
        patches.push_back({{from_m, -0.5F * line_m}, {from_m + dash_m, 0.5F * line_m}, true});
    }
}

constexpr float max_rectangle_length_m = 150.0F;

/// A long patch in equal parts.
void add_in_parts(const RunwayRectangle& whole, std::vector<RunwayRectangle>& patches) {
    const float all_m = whole.max_m.x - whole.min_m.x;
    const auto parts = static_cast<int>(std::ceil(all_m / max_rectangle_length_m));
    for (int part = 0; part < parts; ++part) {
        const auto at_m = [&](int i) {
            return whole.min_m.x + all_m * static_cast<float>(i) / static_cast<float>(parts);
        };
        patches.push_back({{at_m(part), whole.min_m.y}, {at_m(part + 1), whole.max_m.y}, whole.is_painted});
    }
}

} // namespace

std::array<std::string, 2> runway_numbers(double heading_rad) {
    const double tenths = deg_from_rad(heading_rad) / 10.0;
    const auto number = [](long tenth) {
        const long own = (tenth % 36 + 36) % 36;
        return fmt::format("{:02}", own == 0 ? 36 : own);
    };
    const long own = std::lround(tenths);
    return {number(own), number(own + 18)};
}

std::vector<RunwayRectangle> runway_rectangles(double length_m, double width_m, double heading_rad) {
    assert(length_m >= 1500.0 && width_m >= 45.0);
    const auto long_m = static_cast<float>(length_m);
    const auto half_m = static_cast<float>(0.5 * width_m);
    std::vector<RunwayRectangle> patches;
    add_in_parts({{0.0F, -half_m}, {long_m, half_m}, false}, patches);
    for (const float inside_m : {half_m - line_m, -half_m}) {
        add_in_parts({{0.0F, inside_m}, {long_m, inside_m + line_m}, true}, patches);
    }
    paint_centre_line(long_m, patches);
    const std::array<std::string, 2> numbers = runway_numbers(heading_rad);
    for (const bool is_other : {false, true}) {
        End end(patches, long_m, is_other);
        paint_end(end, numbers[is_other ? 1 : 0]);
    }
    return patches;
}

namespace {

constexpr glm::vec3 surface_colour(0.31F, 0.31F, 0.32F); ///< display values under a light of 1
constexpr glm::vec3 paint_colour(0.88F, 0.88F, 0.86F);
constexpr double whole_px = 0.6; ///< what looks as wide has its own colour ...
constexpr double min_px = 0.3;   ///< ... and what looks narrower is left out
constexpr int default_triangles = 1600;
constexpr double max_share = 0.2; ///< of the triangles that are aimed at
constexpr double near_m = 700.0;  ///< up to here it may take all of them

class RunwayDecoration final : public GroundDecoration {
public:
    RunwayDecoration(std::shared_ptr<const models::heights::RunwayStrip> strip, const Daylight& day)
        : strip_(std::move(strip)),
          rectangles_(runway_rectangles(strip_->length_m, strip_->width_m, strip_->heading_rad)),
          light_(day.ambient() + day.sunlight() * std::max(static_cast<float>(day.to_sun().z), 0.0F)) {
        std::ranges::stable_sort(rectangles_, {}, [](const RunwayRectangle& one) { return one.min_m.x; });
    }

    /// Nothing stands where the ground is levelled.
    void limit_scenery(const glm::dvec2& middle_m, double cell_m, SceneryDensity& density) const override {
        if (strip_->distance_m(middle_m) <= models::heights::level_margin_m + cell_m) { density = {}; }
    }

    int max_patch_triangles(const glm::dvec3& eye_m, double /*pixel_rad*/, int triangle_target) const override {
        const glm::dvec2 position_m(eye_m);
        const double distance_m = std::hypot(strip_->distance_m(position_m), eye_m.z - strip_->plane_m(position_m));
        const double max_triangles = std::min<double>(default_triangles, max_share * triangle_target);
        return static_cast<int>(max_triangles * std::clamp(near_m / std::max(distance_m, 1.0), 0.1, 1.0));
    }

    /// A marking that looks narrow takes the colour of the surface, and so does not go in a step.
    bool begin_lying(const glm::dvec3& eye_m, double pixel_rad) override {
        eye_m_ = glm::dvec2(eye_m);
        seen_.clear();
        for (const RunwayRectangle& one : rectangles_) {
            const glm::dvec2 middle_m = strip_->place(0.5 * glm::dvec2(one.min_m + one.max_m));
            const double distance_m = glm::distance(glm::dvec3(middle_m, strip_->plane_m(middle_m)), eye_m);
            const glm::vec2 size_m = one.max_m - one.min_m;
            const double seen_px = static_cast<double>(std::min(size_m.x, size_m.y)) / (distance_m * pixel_rad);
            if (seen_px <= min_px) { continue; }
            const auto own = static_cast<float>(std::clamp((seen_px - min_px) / (whole_px - min_px), 0.0, 1.0));
            GroundPatch patch = patch_of(one);
            patch.colour = (one.is_painted ? glm::mix(surface_colour, paint_colour, own) : surface_colour) * light_;
            patch.is_marking = one.is_painted;
            patch.is_required = !one.is_painted;
            patch.surface = models::SurfaceClass::Runway;
            seen_.push_back({glm::dvec2(one.min_m), glm::dvec2(one.max_m), patch});
        }
        return !seen_.empty();
    }

    bool may_lie_in(const glm::dvec2& min_m, const glm::dvec2& max_m) const override {
        const auto [low_m, high_m] = on_strip(min_m, max_m);
        return high_m.x >= 0.0 && low_m.x <= strip_->length_m && low_m.y <= 0.5 * strip_->width_m &&
               high_m.y >= -0.5 * strip_->width_m;
    }

    void find_patches(const glm::dvec2& min_m, const glm::dvec2& max_m, std::vector<GroundPatch>& patches) override {
        const auto [low_m, high_m] = on_strip(min_m + eye_m_, max_m + eye_m_);
        const double first_m = low_m.x - static_cast<double>(max_rectangle_length_m);
        auto one = std::ranges::lower_bound(seen_, first_m, {}, [](const SeenRectangle& seen) { return seen.min_m.x; });
        for (; one != seen_.end() && one->min_m.x < high_m.x; ++one) {
            if (one->max_m.x > low_m.x && one->min_m.y < high_m.y && one->max_m.y > low_m.y) {
                patches.push_back(one->patch);
            }
        }
    }

private:
    /// Along the strip and left of its middle, and on the ground.
    struct SeenRectangle {
        glm::dvec2 min_m;
        glm::dvec2 max_m;
        GroundPatch patch;
    };

    /// What holds a rectangle of the map: along the strip and left of its middle.
    std::pair<glm::dvec2, glm::dvec2> on_strip(const glm::dvec2& min_m, const glm::dvec2& max_m) const {
        const glm::dvec2 half_m = 0.5 * (max_m - min_m);
        const glm::dvec2 middle_m = strip_->strip_from_world(0.5 * (min_m + max_m));
        const glm::dvec2 reach_m(
            glm::dot(glm::abs(strip_->along()), half_m), glm::dot(glm::abs(strip_->left()), half_m));
        return {middle_m - reach_m, middle_m + reach_m};
    }

    GroundPatch patch_of(const RunwayRectangle& one) const {
        GroundPatch::Corners corners = {glm::dvec2(one.min_m), glm::dvec2(one.max_m.x, one.min_m.y),
            glm::dvec2(one.max_m), glm::dvec2(one.min_m.x, one.max_m.y)};
        for (glm::dvec2& corner : corners) { corner = strip_->place(corner) - eye_m_; }
        return GroundPatch(corners);
    }

    std::shared_ptr<const models::heights::RunwayStrip> strip_;
    std::vector<RunwayRectangle> rectangles_;
    glm::vec3 light_;
    std::vector<SeenRectangle> seen_; ///< in this frame
    glm::dvec2 eye_m_{0.0};
};

} // namespace

std::unique_ptr<GroundDecoration> runway_decoration(
    std::shared_ptr<const models::heights::RunwayStrip> strip, const Daylight& day) {
    return std::make_unique<RunwayDecoration>(std::move(strip), day);
}

} // namespace octant::visuals::nature
