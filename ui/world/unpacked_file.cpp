#include "ui/world/unpacked_file.h"

#include "sim/base/binary_file.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/report/child_program.h"

#include <fmt/format.h>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace octant::ui::world {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view draco_name = "KHR_draco_mesh_compression";

bool is_packed(const fs::path& file) {
    constexpr std::size_t largest_bytes = std::size_t{1} << 28U;
    const std::string ending = extension_of(file);
    std::error_code ignored;
    if ((ending != ".glb" && ending != ".gltf") || !fs::is_regular_file(file, ignored) ||
        fs::file_size(file, ignored) > largest_bytes) {
        return false;
    }
    return read_file(file, largest_bytes).find(draco_name) != std::string::npos;
}

} // namespace

fs::path reader_program() {
    std::error_code ignored;
    const fs::path reader = fs::read_symlink("/proc/self/exe", ignored).parent_path() / "octant-read-mesh";
    return fs::is_regular_file(reader, ignored) ? reader : fs::path();
}

UnpackedFile::UnpackedFile(const fs::path& file) : path_(file) {
    if (!is_packed(file)) { return; }
    const fs::path program = reader_program();
    if (program.empty()) { return; } // the reader names programs that unpack it
    folder_ = std::make_unique<base::TemporaryFolder>();
    alias_ = std::make_unique<base::PathAlias>(folder_->path(), file.string());
    path_ = folder_->path() / (file.stem().string() + ".glb");
    auto child = report::ChildProgram::start({program.string(), "draco", "-", "-", file.string(), path_.string()});
    if (!child) { throw_error_in(program, "expected a program that can be run, got another file"); }
    const report::ProgramResult ending = child->finish();
    if (ending.succeeded) { return; }
    std::string words = one_line(ending.last_error_line.substr(0, 300));
    if (const std::string named = file.string() + ": "; words.starts_with(named)) { words.erase(0, named.size()); }
    throw_error_in(file, words.find("expected ") != words.npos
                             ? words
                             : fmt::format("expected a glTF file that Draco unpacks; its reader: {}", words));
}

models::TriangleMesh read_packed_mesh(const fs::path& file, const models::meshfile::ReadOptions& options) {
    const UnpackedFile plain(file);
    models::TriangleMesh mesh =
        base::with_named_errors([&] { return models::meshfile::read_mesh(plain.path(), options); });
    for (std::string& note : mesh.notes) { note = base::with_path_aliases(std::move(note)); }
    return mesh;
}

models::meshfile::RotatingModel read_packed_model(const fs::path& file, const models::meshfile::ReadOptions& options) {
    const UnpackedFile plain(file);
    models::meshfile::RotatingModel model =
        base::with_named_errors([&] { return models::meshfile::read_rotating_model(plain.path(), options); });
    for (std::string& note : model.body.notes) { note = base::with_path_aliases(std::move(note)); }
    return model;
}

} // namespace octant::ui::world
