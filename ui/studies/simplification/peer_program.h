#pragma once

#include "models/triangle_mesh.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace octant::ui::studies::simplification {

/// A way to simplify of another library.
struct PeerMethod {
    const char* name;  ///< as the program octant-peers knows it
    const char* shown; ///< in tables
};

inline constexpr const char* lindstrom_turk_name = "cgal-lindstrom-turk";

/// What the program was built with, tried on a small mesh. Throws Error as simplified_by_peer.
std::vector<PeerMethod>
methods_of_peer(const std::filesystem::path& program, const std::filesystem::path& folder);

/// The program octant-peers beside ours; nothing when it is not there.
std::optional<std::filesystem::path> find_peer_program();

struct PeerResult {
    models::TriangleMesh mesh;
    double time_ms = 0.0; ///< median, without reading and writing
};

/// Simplifies by another library: a program is run in `folder`, which must be there, on files that
/// are removed again. Nothing when the program was built without that library. Throws Error when it
/// cannot be run or fails.
std::optional<PeerResult> simplified_by_peer(
    const std::filesystem::path& program,
    const std::string& method,
    const models::TriangleMesh& mesh,
    std::size_t faces,
    const std::filesystem::path& folder);

} // namespace octant::ui::studies::simplification
