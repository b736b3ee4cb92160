#include "visuals/landscape/ground_colours.h"

#include "models/colour_vertex.h"
#include "visuals/landscape/ground_palette.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace octant::visuals::landscape {

TerrainPoint ground_point(const terrain::GroundSamples& ground, int column, int row, int step) {
    const int west = std::max(column - step, 0);
    const int east = std::min(column + step, ground.columns() - 1);
    const int south = std::max(row - step, 0);
    const int north = std::min(row + step, ground.rows() - 1);
    const double rise_east = ground.height_m(east, row) - ground.height_m(west, row);
    const double rise_north = ground.height_m(column, north) - ground.height_m(column, south);
    const glm::dvec3 normal(
        -rise_east / ((east - west) * ground.spacing_m()), -rise_north / ((north - south) * ground.spacing_m()), 1.0);
    const auto spacing_m = static_cast<float>(ground.spacing_m());
    return {spacing_m * static_cast<float>(column), spacing_m * static_cast<float>(row),
        static_cast<float>(ground.height_m(column, row)), glm::vec3(glm::normalize(normal))};
}

std::vector<std::uint32_t> ground_colours(
    const models::heights::HeightField& field, const scene::AirSettings& settings) {
    const terrain::GroundSamples ground(field);
    const GroundPalette palette(settings, climate_at(field.place), make_relief_shadows(ground, settings));
    const auto spacing_m = static_cast<float>(field.spacing_m());
    std::vector<std::uint32_t> colours;
    colours.reserve(static_cast<std::size_t>(field.columns()) * static_cast<std::size_t>(field.rows()));
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            const TerrainPoint point = ground_point(ground, column, row, 1);
            colours.push_back(models::packed_colour(palette.lit_colour(point, spacing_m)));
        }
    }
    return colours;
}

TerrainPoint nearest_point(const terrain::GroundSamples& ground, const glm::dvec2& at_m, double footprint_m) {
    const glm::dvec2 place = ground.grid_from_world(at_m.x, at_m.y);
    const int column = std::clamp(static_cast<int>(std::lround(place.x)), 0, ground.columns() - 1);
    const int row = std::clamp(static_cast<int>(std::lround(place.y)), 0, ground.rows() - 1);
    const int step = std::max(static_cast<int>(footprint_m / (2.0 * ground.spacing_m())), 1);
    return ground_point(ground, column, row, step);
}

glm::vec3 nearest_colour(
    const terrain::GroundSamples& ground, const GroundPalette& palette, const glm::dvec2& at_m, double footprint_m) {
    return palette.lit_colour(nearest_point(ground, at_m, footprint_m), static_cast<float>(footprint_m));
}

glm::vec3 mean_colour(const std::vector<std::uint32_t>& colours) {
    std::array<std::uint64_t, 3> sums{};
    for (const std::uint32_t colour : colours) {
        sums[0] += colour & 0xffU;
        sums[1] += (colour >> 8U) & 0xffU;
        sums[2] += (colour >> 16U) & 0xffU;
    }
    const double scale = colours.empty() ? 0.0 : 1.0 / (255.0 * static_cast<double>(colours.size()));
    return glm::vec3(glm::dvec3(static_cast<double>(sums[0]) * scale, static_cast<double>(sums[1]) * scale,
        static_cast<double>(sums[2]) * scale));
}

} // namespace octant::visuals::landscape
