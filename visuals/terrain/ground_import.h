#pragma once

#include "models/heights/import_options.h"
#include "visuals/terrain/ground_tiles.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace octant::visuals::terrain {

/// What an import is doing, in this order.
enum class ImportStage {
    Scanning, ///< looks for the lowest and highest height; left out where all are whole metres
    Reading,
    Filling,  ///< voids, where there are any
    Building, ///< heights, errors, checksums, tile by tile
    Writing   ///< what the kernel still holds to the disk
};

/// Told before a stage begins (0) and as it goes on (to 1). Answers whether what was done so far
/// shall be brought to the disk now, from where a later import goes on. May throw, which stops the
/// import.
using ImportWatch = std::function<bool(ImportStage stage, double done)>;

struct GroundImportOptions {
    models::heights::ImportOptions picture;
    int threads = 2;
};

struct ImportSummary {
    GroundShape shape;
    GroundFacts facts;
    std::size_t bytes = 0; ///< of the file
    std::string note;      ///< what became of an earlier, unfinished import; empty without one
};

/// Makes one mapped file (ground_file.h) of heights that GDAL reads: one file, or several that form
/// one ground (models/height_source.h). The same bytes as ground_of for one file without voids.
/// Voids are filled, rounded to whole metres where the heights are.
///
/// Works in OUT.part, which stays when the import is stopped: the next import of the same inputs
/// (names, sizes, times, options) goes on from what was brought to the disk last, else starts anew;
/// a stop while voids are filled starts anew, too. OUT.part goes when an input cannot be read. One
/// import at a time works in it. Heights that are not whole metres are read twice. OUT appears when
/// all is done and on the disk.
///
/// Memory beside the mapped file, which takes 2 bytes a sample more until it is done: 50 MB, 80
/// more while voids are filled, GDAL's cache, and what models::HeightSource holds.
///
/// Throws Error as models::HeightSource and for OUT and OUT.part (no permission, disk full, an
/// input, in use by another import, a file of another kind in the place of OUT.part).
ImportSummary import_ground(
    const std::vector<std::filesystem::path>& inputs,
    const std::filesystem::path& out,
    const GroundImportOptions& options,
    const ImportWatch& watch);

} // namespace octant::visuals::terrain
