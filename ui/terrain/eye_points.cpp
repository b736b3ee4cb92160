#include "ui/terrain/eye_points.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"
#include "visuals/terrain/ground_query.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace octant::ui::terrain {

namespace scene = visuals::scene;

std::vector<EyePoint> read_eye_points(const std::filesystem::path& file, const std::string& map) {
    const std::string text = read_text_file(file);
    std::vector<EyePoint> points;
    int line_number = 0;
    for (const std::string_view line : split_lines(text)) {
        ++line_number;
        const auto fields = split_fields(line, ',');
        if (line.empty() || line.front() == '#' || fields.front() != map) { continue; }
        std::array<double, 5> numbers{};
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            const auto number = fields.size() == 6 ? finite_number(fields[k + 1]) : std::optional<double>();
            if (!number) {
                throw_error_at(file, line_number,
                    fmt::format(
                        "expected map,x_m,y_m,agl_m,heading_deg,pitch_deg, got '{}'", printable(std::string(line))));
            }
            numbers[k] = *number;
        }
        points.push_back({line_number, numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]});
    }
    if (points.empty()) { throw_error_in(file, fmt::format("expected rows of map '{}', got none", printable(map))); }
    return points;
}

scene::Camera camera_at(const EyePoint& point, const visuals::terrain::GroundSamples& ground, double fov_deg) {
    const auto ground_m = visuals::terrain::ground_height_m(ground, point.x_m, point.y_m);
    if (!ground_m) {
        throw Error(fmt::format(
            "eye points, line {}: expected a place on the map, got {},{}", point.line, point.x_m, point.y_m));
    }
    const double heading_rad = rad_from_deg(point.heading_deg);
    const double pitch_rad = rad_from_deg(point.pitch_deg);
    const glm::dvec3 eye_m(point.x_m, point.y_m, *ground_m + point.agl_m);
    const glm::dvec3 ahead(
        std::sin(heading_rad) * std::cos(pitch_rad), std::cos(heading_rad) * std::cos(pitch_rad), std::sin(pitch_rad));
    scene::Camera camera = scene::camera_looking_at(eye_m, eye_m + ahead);
    camera.vertical_fov_rad = rad_from_deg(fov_deg);
    return camera;
}

} // namespace octant::ui::terrain
