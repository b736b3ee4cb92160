#pragma once

#include "models/meshfile/mesh_file.h"
#include "models/triangle_mesh.h"
#include "ui/base/data_files.h"

#include <filesystem>
#include <memory>

namespace octant::ui::world {

/// The program octant-read-mesh, in the folder of this program; empty if it was not built.
std::filesystem::path reader_program();

/// A mesh file that the readers of models/meshfile read: the file itself or, of a glTF file whose meshes Draco has
/// packed, a plain copy in a temporary folder, which octant-read-mesh makes within its limits of time and memory. The
/// copy lives as long as this.
class UnpackedFile {
public:
    /// Throws Error "file: ..." in one line where the file cannot be unpacked; it names programs that do it where the
    /// program was built without Draco.
    explicit UnpackedFile(const std::filesystem::path& file);

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    std::unique_ptr<base::TemporaryFolder> folder_;
    std::unique_ptr<base::PathAlias> alias_; ///< messages name the file, not its copy
};

/// As meshfile::read_mesh and read_rotating_model, also for packed files. Throw Error.
models::TriangleMesh read_packed_mesh(const std::filesystem::path& file, const models::meshfile::ReadOptions& options);
models::meshfile::RotatingModel read_packed_model(
    const std::filesystem::path& file, const models::meshfile::ReadOptions& options);

} // namespace octant::ui::world
