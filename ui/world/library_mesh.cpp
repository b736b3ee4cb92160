#include "ui/world/library_mesh.h"

#include "models/meshfile/mesh_file.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/utf8.h"
#include "ui/report/child_program.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace octant::ui::world {

namespace {

namespace fs = std::filesystem;

struct Library {
    /// What octant-read-mesh calls it.
    std::string_view word;
    std::string_view name;
    std::string_view endings;
};

/// As with Octant's own readers. Of larger files the libraries read for a minute and then find no room for them.
constexpr std::uintmax_t largest_bytes = std::uintmax_t{1} << 30U;

constexpr std::array libraries{
    Library{"assimp", "Assimp", ".3ds .ase .b3d .blend .dae .dxf .fbx .lwo .lws .md2 .ms3d .x"},
    Library{"osg", "OpenSceneGraph", ".flt .ive .osg .osgb .osgt"}};

const Library* library_of(const fs::path& file) {
    const std::string ending = extension_of(file);
    for (const Library& library : libraries) {
        const auto endings = split_words(library.endings);
        if (std::ranges::find(endings, ending) != endings.end()) { return &library; }
    }
    return nullptr;
}

/// In the reader's own words where it told what it expected; else it crashed or met its limits.
[[noreturn]] void refuse(const fs::path& file, const Library& library, std::string_view error_line) {
    if (const std::string named = file.string() + ": "; error_line.starts_with(named)) {
        error_line.remove_prefix(named.size());
    }
    constexpr std::size_t longest = 300;
    const std::string words = one_line(error_line.substr(0, longest));
    throw_error_in(file, words.starts_with("expected ")
                             ? words
                             : fmt::format("expected a mesh that {} can read; its reader: {}", library.name, words));
}

/// Beside this program; empty where it was not built.
fs::path reader_program() {
    std::error_code ignored;
    const fs::path reader = fs::read_symlink("/proc/self/exe", ignored).parent_path() / "octant-read-mesh";
    return fs::is_regular_file(reader, ignored) ? reader : fs::path();
}

/// A folder that goes with what lies in it.
class ShortFolder {
public:
    ShortFolder() {
        std::string name = (fs::temp_directory_path() / "octant-mesh-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) {
            throw Error(fmt::format("{}: expected a folder that can be made, got none", name));
        }
        path_ = name;
    }

    ~ShortFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }

    ShortFolder(const ShortFolder&) = delete;
    ShortFolder& operator=(const ShortFolder&) = delete;
    ShortFolder(ShortFolder&&) = delete;
    ShortFolder& operator=(ShortFolder&&) = delete;

    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

} // namespace

bool is_library_file(const fs::path& file) { return library_of(file) != nullptr; }

models::TriangleMesh read_library_mesh(const fs::path& file, const models::meshfile::ReadOptions& options) {
    const Library& library = *library_of(file);
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) { throw_error_in(file, "expected a file that can be read, got none"); }
    if (fs::file_size(file, ignored) > largest_bytes) {
        throw_error_in(file, fmt::format("expected at most {} bytes, got more", largest_bytes));
    }
    const fs::path program = reader_program();
    if (program.empty()) {
        throw_error_in(file,
            fmt::format("expected a build with {} for {} files, got one without", library.name, extension_of(file)));
    }
    const ShortFolder folder;
    const fs::path out = folder.path() / "mesh.obj";
    auto child = report::ChildProgram::start({program.string(), std::string(library.word),
        options.pictures ? "pictures" : "-", options.backs ? "backs" : "-", file.string(), out.string()});
    if (!child) { throw_error_in(program, "expected a program that can be run, got another file"); }
    const report::ProgramResult ending = child->finish();
    if (!ending.succeeded) { refuse(file, library, ending.last_error_line); }
    models::TriangleMesh mesh = models::meshfile::read_mesh(out);
    mesh.name = file.stem().string();
    return mesh;
}

std::string library_formats() {
    if (reader_program().empty()) { return "no formats by libraries: built without Assimp and OpenSceneGraph"; }
    std::string text;
    for (const Library& library : libraries) {
        text += fmt::format("{}by {}: {}", text.empty() ? "" : "\n", library.name, library.endings);
    }
    return text;
}

} // namespace octant::ui::world
