#include "models/repair/repair_counts.h"

#include <fmt/format.h>
#include <string_view>

namespace octant::models::repair {

std::vector<std::string> describe_counts(const RepairCounts& counts) {
    std::vector<std::string> lines;
    const auto add = [&](std::size_t count, std::string_view one, std::string_view many) {
        if (count > 0) {
            lines.push_back(fmt::format("{} {}", count, count == 1 ? one : many));
        }
    };
    add(counts.unreferenced_vertices,
        "vertex of no triangle taken out",
        "vertices of no triangle taken out");
    add(counts.duplicate_vertices, "duplicate vertex welded", "duplicate vertices welded");
    add(counts.degenerate_triangles,
        "triangle without an area taken out",
        "triangles without an area taken out");
    add(counts.duplicate_triangles, "doubled triangle taken out", "doubled triangles taken out");
    add(counts.flipped_triangles,
        "triangle turned to agree with its neighbours",
        "triangles turned to agree with their neighbours");
    add(counts.split_edges,
        "edge split that more than two triangles or two that disagree share",
        "edges split that more than two triangles or two that disagree share");
    add(counts.split_vertices,
        "vertex split where several fans of triangles met",
        "vertices split where several fans of triangles met");
    add(counts.boundary_loops,
        "hole or open rim left as it is",
        "holes or open rims left as they are");
    return lines;
}

} // namespace octant::models::repair
