// Builds a ground in memory from a height field that is in memory: for made ground and small files. Large files are
// imported into a mapped file instead (ground_import.cpp), by the same GroundAssembler.
#include "visuals/terrain/ground_builder.h"

#include "sim/base/parallel_for.h"
#include "visuals/terrain/ground_assembler.h"

#include <cstring>
#include <memory>
#include <vector>

namespace octant::visuals::terrain {

namespace {

std::vector<std::int16_t> numbers_of(const models::heights::HeightField& field, const GroundShape& shape, int threads) {
    const auto columns = static_cast<std::size_t>(shape.columns);
    std::vector<std::int16_t> numbers(columns * static_cast<std::size_t>(shape.rows));
    parallel_for(static_cast<std::size_t>(shape.rows), threads, [&](std::size_t row, std::size_t /*w*/) {
        for (std::size_t column = 0; column < columns; ++column) {
            const float height_m = field.height_m(static_cast<int>(column), static_cast<int>(row));
            numbers[row * columns + column] = stored_number(height_m, shape);
        }
    });
    return numbers;
}

} // namespace

GroundTiles make_ground_tiles(const models::heights::HeightField& field, int threads) {
    const GroundShape shape = shape_of(field.columns(), field.rows(), field.spacing_m(),
        static_cast<double>(field.lowest_m()), static_cast<double>(field.highest_m()));
    const std::vector<std::int16_t> numbers = numbers_of(field, shape, threads);
    const StoredHeights heights = stored_heights(numbers, shape, false);
    const GroundLayout layout(shape);
    const std::shared_ptr<std::byte[]> memory(new std::byte[layout.total_bytes()]);
    std::memset(memory.get(), 0, layout.first_tile());
    const std::span<std::byte> bytes(memory.get(), layout.total_bytes());
    GroundAssembler assembly(shape, layout, heights, bytes, threads);
    const HeightStatistics figures = assembly.write_overview();
    const auto put = [&bytes](std::size_t /*index*/, std::size_t offset, std::span<const std::byte> tile) {
        std::memcpy(bytes.data() + offset, tile.data(), tile.size());
    };
    for (std::size_t tile = 0; tile < assembly.tiles();) { tile = assembly.build(tile, assembly.tiles(), put); }
    const GroundMetadata metadata{
        field.name, field.place, field.system, field.filled_voids, figures.lowest_m, figures.highest_m, figures.mean_m};
    return {shape, metadata, bytes, memory};
}

} // namespace octant::visuals::terrain
