#include "visuals/scene/ground_colours.h"

#include "models/colour_vertex.h"
#include "visuals/scene/ground_palette.h"

#include <array>

namespace octant::visuals::scene {

GroundPoint ground_point(const models::HeightField& field, int column, int row) {
    const auto spacing_m = static_cast<float>(field.spacing_m());
    return {
        spacing_m * static_cast<float>(column),
        spacing_m * static_cast<float>(row),
        field.height_m(column, row),
        field.normal_at_sample(column, row)};
}

std::vector<std::uint32_t>
ground_colours(const models::HeightField& field, const Settings& settings) {
    const GroundPalette palette(settings);
    const auto spacing_m = static_cast<float>(field.spacing_m());
    std::vector<std::uint32_t> colours;
    colours.reserve(
        static_cast<std::size_t>(field.columns()) * static_cast<std::size_t>(field.rows()));
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            const GroundPoint point = ground_point(field, column, row);
            colours.push_back(models::packed_colour(palette.lit(point, spacing_m)));
        }
    }
    return colours;
}

glm::vec3 mean_colour(const std::vector<std::uint32_t>& colours) {
    std::array<std::uint64_t, 3> sums{};
    for (const std::uint32_t colour : colours) {
        sums[0] += colour & 0xffU;
        sums[1] += (colour >> 8U) & 0xffU;
        sums[2] += (colour >> 16U) & 0xffU;
    }
    const double scale =
        colours.empty() ? 0.0 : 1.0 / (255.0 * static_cast<double>(colours.size()));
    return glm::vec3(glm::dvec3(
        static_cast<double>(sums[0]) * scale,
        static_cast<double>(sums[1]) * scale,
        static_cast<double>(sums[2]) * scale));
}

} // namespace octant::visuals::scene
