#pragma once

#include "models/simplify/attribute_seams.h"
#include "models/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::commands {

// Several mesh files simplified as one mesh, so that no gap opens along their common borders.

/// One of several files that are joined into one mesh: the range of its materials there and what it holds.
struct SharedBorderFile {
    std::uint32_t first_material = 0;
    std::uint32_t materials = 0;
    bool has_materials = false;
    bool has_colours = false;

    /// The triangles of this file in a joined mesh, with the attributes that the file has.
    models::TriangleMesh part_of(const models::TriangleMesh& joined) const;
};

/// Reads all files into one mesh and appends what each of them holds to `files`. Throws Error.
models::TriangleMesh read_joined(const std::vector<std::string>& names, std::vector<SharedBorderFile>& files);

/// Index of the first file that has triangles in the original but none in the simplified mesh. `original_materials` and
/// `made_materials`: the material of each triangle.
std::optional<std::size_t> vanished_file(const std::vector<SharedBorderFile>& files,
    const std::vector<std::uint32_t>& original_materials, const std::vector<std::uint32_t>& made_materials);

/// Makes straight common borders of the files, such as those of map tiles, straight again in `made`. `original` is the
/// joined mesh with its colours. Returns false when no two files have a vertex in common.
bool align_shared_borders(const models::simplify::AttributeSeams& seams, const std::vector<SharedBorderFile>& files,
    const models::TriangleMesh& original, models::TriangleMesh& made);

/// A folder for files that appear in its parent together, once all are written. Removed with what is still in it.
class UnfinishedFolder {
public:
    explicit UnfinishedFolder(const std::filesystem::path& parent);
    ~UnfinishedFolder();
    UnfinishedFolder(const UnfinishedFolder&) = delete;
    UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;
    UnfinishedFolder(UnfinishedFolder&&) = delete;
    UnfinishedFolder& operator=(UnfinishedFolder&&) = delete;

    const std::filesystem::path& path() const { return path_; }

    /// Throws Error where the parent has a folder of a file's name, or cannot be written.
    void move_into_place() const;

private:
    std::filesystem::path parent_;
    std::filesystem::path path_;
};

} // namespace octant::ui::commands
