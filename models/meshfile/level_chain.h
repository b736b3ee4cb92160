#pragma once

#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace octant::models::meshfile {

/// One level of detail of a chain.
struct ChainLevel {
    TriangleMesh mesh;
    /// Certified: the two-sided Hausdorff distance to the finest level is at most this.
    double error_m = 0.0;
};

/// Levels of detail of one model, finest first, each coarser and of a larger error than the one before; the first is
/// the original at error 0. In the axes of the file it was made from.
struct LevelChain {
    std::string name;
    std::vector<ChainLevel> levels;                 ///< at least one
    std::optional<polygons::PolygonModel> polygons; ///< of draw-order size, behind the last level
    double polygons_error_m = 0.0;                  ///< certified, of `polygons`
};

/// Whether a file calls itself a chain by its ending, .chain.
bool is_chain_file(const std::filesystem::path& path);

/// Reads a file of write_chain, or of its version 1, which had no opacities. Throws Error "file: ..." for another
/// version, a wrong checksum and anything that the file cannot hold.
LevelChain read_chain(const std::filesystem::path& path);

/// One versioned, checksummed binary file, with texture coordinates and the encoded pictures of materials inside.
/// Positions are stored in double, every bit of them: the certified errors hold for what is read back as they are.
/// Throws Error.
void write_chain(const std::filesystem::path& path, const LevelChain& chain);

} // namespace octant::models::meshfile
