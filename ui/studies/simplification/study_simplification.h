#pragma once

#include "ui/base/study_output.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

namespace octant::ui::studies::simplification {

struct SimplificationStudyOptions : base::StudyOutput {
    std::optional<std::filesystem::path> bunny; ///< bun_zipper.ply; not shipped
    std::vector<std::filesystem::path> meshes;  ///< more meshes
    std::vector<std::size_t> faces;             ///< goals; empty = 15, 5 and 2.5 % of each mesh
    std::optional<std::filesystem::path> peers; ///< octant-peers; empty = the one beside us
    bool paper_only = false;                    ///< tables 1 and 2, nothing of other methods
};

/// Tables 1 and 2 of Y. Kim and B. U. Lee's "Error measure for vertex simplification" with ours
/// beside, for the bunny where it is given, the coloured globe, a torus, a finely cut F-15 and
/// other meshes; then how far every way to simplify, ours and other libraries', goes from the
/// original and how long it takes. Prints the tables and writes them to `out` as CSV and together
/// as Markdown, with a figure as PNG. Throws Error.
void study_simplification(const SimplificationStudyOptions& options);

} // namespace octant::ui::studies::simplification
