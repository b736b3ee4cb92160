#include "visuals/groundfile/import_rows.h"

#include "models/heights/height_raster.h"
#include "visuals/groundfile/integer_voids.h"
#include "visuals/terrain/ground_assembler.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace octant::visuals::groundfile {

namespace {

static_assert(void_value == models::heights::void_height_m);

void take_range(double lowest_m, double highest_m, ImportProgress& progress) {
    progress.lowest_m = std::min(progress.lowest_m, lowest_m);
    progress.highest_m = std::max(progress.highest_m, highest_m);
}

void read_integer_metres(
    models::heights::HeightSource& source,
    int first_row,
    std::span<std::int16_t> numbers,
    ImportProgress& progress) {
    source.read(first_row, numbers);
    std::int16_t lowest_m = std::numeric_limits<std::int16_t>::max();
    std::int16_t highest_m = void_value;
    int voids = 0;
    for (const std::int16_t number : numbers) {
        const bool is_void = number == void_value;
        voids += is_void ? 1 : 0;
        lowest_m = std::min(lowest_m, is_void ? lowest_m : number);
        highest_m = std::max(highest_m, number);
    }
    progress.voids += voids;
    if (static_cast<std::size_t>(voids) < numbers.size()) {
        take_range(lowest_m, highest_m, progress);
    }
}

void read_fractions(
    models::heights::HeightSource& source,
    int first_row,
    std::span<std::int16_t> numbers,
    ImportProgress& progress) {
    std::vector<float> heights_m(numbers.size());
    source.read(first_row, heights_m);
    const terrain::GroundShape shape =
        terrain::shape_of(1, 1, 1.0, progress.lowest_m, progress.highest_m);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const bool is_void = std::isnan(heights_m[i]);
        progress.voids += is_void ? 1 : 0;
        numbers[i] = is_void ? void_value : terrain::stored_number(heights_m[i], shape);
    }
}

} // namespace

void scan_rows(
    models::heights::HeightSource& source, int first_row, int count, ImportProgress& progress) {
    std::vector<float> heights_m(
        static_cast<std::size_t>(count) * static_cast<std::size_t>(source.columns()));
    source.read(first_row, heights_m);
    for (const float height_m : heights_m) {
        if (!std::isnan(height_m)) {
            take_range(height_m, height_m, progress);
        }
    }
}

void read_rows(
    models::heights::HeightSource& source,
    int first_row,
    std::span<std::int16_t> numbers,
    ImportProgress& progress) {
    if (source.has_integer_metres()) {
        read_integer_metres(source, first_row, numbers, progress);
    } else {
        read_fractions(source, first_row, numbers, progress);
    }
}

} // namespace octant::visuals::groundfile
