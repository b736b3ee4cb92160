#include "ui/studies/simplification/peer_program.h"

#include "models/meshfile/mesh_file.h"
#include "sim/base/error.h"
#include "ui/report/child_program.h"

#include <array>
#include <cstdint>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

namespace octant::ui::studies::simplification {

namespace {

namespace fs = std::filesystem;

constexpr const char* repeats = "3";

/// A file that goes when it is no longer needed.
class TemporaryFile {
public:
    explicit TemporaryFile(fs::path file)
        : path(std::move(file)) {}

    ~TemporaryFile() {
        std::error_code ignored;
        fs::remove(path, ignored);
    }

    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    TemporaryFile(TemporaryFile&&) = delete;
    TemporaryFile& operator=(TemporaryFile&&) = delete;

    const fs::path path;
};

double time_in(const fs::path& program, const std::string& output) {
    const auto json = nlohmann::json::parse(output, nullptr, false);
    if (!json.is_object() || !json.contains("time_ms") || !json["time_ms"].is_number()) {
        throw_error_in(
            program,
            fmt::format("expected a line of JSON with time_ms, got '{}'", printable(output)));
    }
    return json["time_ms"].get<double>();
}

/// Positions and triangles only.
models::TriangleMesh bare(const models::TriangleMesh& mesh) {
    models::TriangleMesh shape;
    shape.vertices_m = mesh.vertices_m;
    shape.triangles = mesh.triangles;
    return shape;
}

constexpr std::array peer_methods = {
    PeerMethod{"meshoptimizer", "meshoptimizer"},
    PeerMethod{lindstrom_turk_name, "CGAL Lindstrom-Turk"},
    PeerMethod{"cgal-garland-heckbert", "CGAL Garland-Heckbert"},
    PeerMethod{"openmesh-quadric", "OpenMesh quadric"}};

models::TriangleMesh octahedron() {
    models::TriangleMesh mesh;
    mesh.vertices_m = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (std::uint32_t i = 0; i < 4; ++i) {
        mesh.triangles.push_back({i, (i + 1) % 4, 4});
        mesh.triangles.push_back({(i + 1) % 4, i, 5});
    }
    return mesh;
}

} // namespace

std::vector<PeerMethod> methods_of_peer(const fs::path& program, const fs::path& folder) {
    std::vector<PeerMethod> there;
    for (const PeerMethod& method : peer_methods) {
        if (simplified_by_peer(program, method.name, octahedron(), 6, folder)) {
            there.push_back(method);
        }
    }
    return there;
}

std::optional<fs::path> find_peer_program() {
    std::error_code failed;
    const fs::path program = fs::read_symlink("/proc/self/exe", failed);
    const fs::path peers = program.parent_path() / "octant-peers";
    if (failed || !fs::is_regular_file(peers, failed)) {
        return std::nullopt;
    }
    return peers;
}

std::optional<PeerResult> simplified_by_peer(
    const fs::path& program,
    const std::string& method,
    const models::TriangleMesh& mesh,
    std::size_t faces,
    const fs::path& folder) {
    const TemporaryFile input(folder / "peer-input.obj");
    const TemporaryFile output(folder / "peer-output.obj");
    models::meshfile::write_mesh(input.path, bare(mesh));
    auto child = report::ChildProgram::start(
        {fs::absolute(program).string(),
         method,
         input.path.string(),
         fmt::format("{}", faces),
         output.path.string(),
         "--repeat",
         repeats});
    if (!child) {
        throw_error_in(program, "expected the program octant-peers, got nothing that can be run");
    }
    const report::ProgramResult ending = child->finish();
    if (!ending.succeeded) {
        if (ending.output.rfind("not built with", 0) == 0) {
            return std::nullopt;
        }
        throw_error_in(program, fmt::format("{} failed: {}", method, printable(ending.last_error_line)));
    }
    PeerResult result;
    result.time_ms = time_in(program, ending.output);
    result.mesh = models::meshfile::read_mesh(output.path);
    return result;
}

} // namespace octant::ui::studies::simplification
