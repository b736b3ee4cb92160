#include "visuals/overlay/overlay.h"
#include "visuals/overlay/stroke_font.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace octant::visuals::overlay {

namespace {

constexpr float labels_per_picture_height = 60.0F; ///< heights of a capital, one above the other
constexpr float min_name_px = 7.0F;
constexpr std::uint32_t name_colour = 0xffffffffU;
constexpr std::uint32_t name_halo_colour = 0xb0000000U;
constexpr float scale_width = 0.18F;    ///< of the picture's width that the scale may take
constexpr double nearest_scale_m = 8.0; ///< within the aircraft a scale says nothing
constexpr double farthest_name_m = 15000.0;

/// 1, 2 or 5 times a power of ten, at most that.
double round_length_m(double max_m) {
    const double ten = std::pow(10.0, std::floor(std::log10(max_m)));
    const double share = max_m / ten;
    return ten * (share >= 5.0 ? 5.0 : share >= 2.0 ? 2.0 : 1.0);
}

char to_upper(char letter) { return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter; }

/// The annotations of one picture.
class PathAnnotations {
public:
    PathAnnotations(
        OverlayCanvas& canvas, const scene::Camera& camera, const glm::ivec2& size_px, const glm::dvec3& aircraft_m)
        : canvas_(canvas), camera_(camera), size_px_(size_px),
          letter_px_(std::max(size_px_.y / labels_per_picture_height, min_name_px)),
          focal_px_(scene::focal_px(camera, size_px.y)), aircraft_m_(std::max(glm::length(aircraft_m), 1.0)) {
        canvas_.begin(glm::mat3(1.0F),
            {std::max(0.14F * letter_px_, 1.2F), 0.12F * letter_px_ + 1.0F, name_colour, name_halo_colour});
        canvas_.clip_to({glm::vec2(0.0F), size_px_});
        const float margin_px = 2.5F * letter_px_;
        draw_north({margin_px + 2.0F * letter_px_, size_px_.y - margin_px - 4.5F * letter_px_});
        if (aircraft_m_ > nearest_scale_m) { draw_scale({margin_px, size_px_.y - margin_px}); }
    }

    /// Writes a name where its position is in the picture, if that is in front of the eye and in view.
    void add(const WorldLabel& label) {
        const glm::dvec3 view = glm::conjugate(camera_.view_to_world) * label.at_m;
        if (-view.z < 1.0 || glm::length(label.at_m) > farthest_name_m) { return; }
        const glm::vec2 at_px = 0.5F * size_px_ + glm::vec2(static_cast<float>(focal_px_ * view.x / -view.z),
                                                      static_cast<float>(focal_px_ * view.y / view.z));
        std::array<char, 24> letters{};
        const std::size_t count = std::min(label.name.size(), letters.size());
        std::transform(
            label.name.begin(), label.name.begin() + static_cast<std::ptrdiff_t>(count), letters.begin(), to_upper);
        const glm::vec2 above(0.0F, 2.0F * letter_px_);
        canvas_.line(at_px - 0.85F * above, at_px);
        canvas_.text({at_px - above, letter_px_, 0.5F}, std::string_view(letters.data(), count));
    }

private:
    /// An arrow in a circle: up is the way one looks, level.
    void draw_north(const glm::vec2& centre_px) {
        const glm::dvec3 ahead = scene::view_direction(camera_);
        const glm::dvec3 up = camera_.view_to_world * glm::dvec3(0.0, 1.0, 0.0);
        // Looking straight down or up, the top of the picture is what lies ahead.
        const glm::dvec2 level = std::abs(ahead.z) < 0.98 ? glm::dvec2(ahead) : glm::dvec2(ahead.z < 0.0 ? up : -up);
        const double heading_rad = std::atan2(level.x, level.y);
        const glm::vec2 north(static_cast<float>(-std::sin(heading_rad)), static_cast<float>(-std::cos(heading_rad)));
        const glm::vec2 across(-north.y, north.x);
        const float radius_px = 2.0F * letter_px_;
        canvas_.circle(centre_px, radius_px);
        const glm::vec2 tip = centre_px + 0.85F * radius_px * north;
        const glm::vec2 foot = centre_px - 0.7F * radius_px * north;
        canvas_.line(foot, tip);
        canvas_.polyline(std::array{tip - 0.55F * radius_px * north + 0.35F * radius_px * across, tip,
            tip - 0.55F * radius_px * north - 0.35F * radius_px * across});
        canvas_.text(
            {centre_px + 1.65F * radius_px * north + glm::vec2(0.0F, 0.5F * letter_px_), letter_px_, 0.5F}, "N");
    }

    void draw_scale(const glm::vec2& from_px) {
        const double max_m = static_cast<double>(scale_width * size_px_.x) * aircraft_m_ / focal_px_;
        const double length_m = round_length_m(std::max(max_m, 0.01));
        const auto length_px = static_cast<float>(length_m * focal_px_ / aircraft_m_);
        const glm::vec2 to_px = from_px + glm::vec2(length_px, 0.0F);
        const glm::vec2 tick(0.0F, 0.6F * letter_px_);
        canvas_.polyline(std::array{from_px - tick, from_px, to_px, to_px - tick});
        const ShortText caption =
            length_m >= 1000.0 ? ShortText("{:g} KM", length_m / 1000.0) : ShortText("{:g} M", length_m);
        canvas_.text({to_px + glm::vec2(letter_px_, 0.0F), letter_px_}, caption.text());
    }

    OverlayCanvas& canvas_;
    const scene::Camera& camera_;
    glm::vec2 size_px_;
    float letter_px_;
    double focal_px_;
    double aircraft_m_; ///< how far it is off
};

} // namespace

scene::OverlayDraw draw_path_annotations(OverlayCanvas& canvas, const scene::Camera& camera, const glm::ivec2& size_px,
    const glm::dvec3& aircraft_m, std::span<const WorldLabel> labels) {
    PathAnnotations annotations(canvas, camera, size_px, aircraft_m);
    for (const WorldLabel& label : labels) { annotations.add(label); }
    return canvas.finish();
}

} // namespace octant::visuals::overlay
