#pragma once

#include "models/heights/height_field.h"
#include "models/heights/import_options.h"
#include "visuals/terrain/bisection_tiles.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace octant::visuals::groundfile {

using terrain::GroundMetadata;
using terrain::GroundShape;

/// What an import is doing, in this order.
enum class ImportStage {
    Scanning, ///< It looks for the lowest and highest height; left out if all are whole metres.
    Reading,
    Filling,  ///< It fills voids, if there are any.
    Building, ///< It builds heights, errors and checksums, tile by tile.
    Writing   ///< It brings what the kernel still holds to the disk.
};

/// Called before a stage begins (with 0) and as it goes on (up to 1). Returns whether what was done so far is to be
/// brought to the disk now, from where a later import can go on. It may throw, which stops the import.
using ImportCallback = std::function<bool(ImportStage stage, double done)>;

struct GroundImportOptions {
    models::heights::ImportOptions source_options;
    int threads = 2;
};

/// What was made.
struct ImportSummary {
    GroundShape shape;
    GroundMetadata metadata;
    std::size_t bytes = 0;                       ///< The size of the file.
    std::string note;                            ///< What became of an earlier, unfinished import; empty without one.
    std::vector<models::heights::MapNote> notes; ///< Of the inputs.
};

/// Makes one mapped file (ground_file.h) of heights that GDAL reads: from one file, or from several that form one
/// ground (models/heights/height_source.h). For one file without voids the bytes are those of make_ground_tiles. Voids
/// are filled, rounded to whole metres where the heights are whole metres.
///
/// It works in OUT.part, which stays when the import is stopped. The next import of the same inputs (names, sizes,
/// times, options) goes on from what was last brought to the disk; another one starts anew, and so does one that was
/// stopped while voids were filled. OUT.part is removed when an input cannot be read. Only one import at a time works
/// in it. Heights that are not whole metres are read twice. OUT appears when everything is done, on the disk and read
/// back from there.
///
/// Memory beside the mapped file, which takes 2 more bytes a sample until it is done: 50 MB, 80 more while voids are
/// filled, GDAL's cache, and what models::heights::HeightSource holds.
///
/// Throws Error as HeightSource does, and for OUT and OUT.part (no permission, disk full, one of the inputs, in use by
/// another import, another kind of file in the place of OUT.part).
ImportSummary import_ground(const std::vector<std::filesystem::path>& inputs, const std::filesystem::path& out,
    const GroundImportOptions& options, const ImportCallback& callback);

} // namespace octant::visuals::groundfile
