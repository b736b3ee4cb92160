#include "ui/world/refine_mesh_cache.h"

#include "sim/base/error.h"
#include "sim/base/file_status.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "visuals/ordercache/binary_file.h"
#include "visuals/refine/progressive_file.h"

#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::world {

namespace fs = std::filesystem;
namespace ordercache = visuals::ordercache;
namespace refine = visuals::refine;

namespace {

template <class Item>
void add_list(Hash& hash, const std::vector<Item>& list) {
    hash.add_word(list.size());
    hash.add(std::as_bytes(std::span(list)));
}

/// Another number for each seed.
std::uint64_t hash_of(const models::TriangleMesh& mesh, std::uint64_t seed) {
    Hash hash;
    hash.add_word(seed);
    hash.add_word(refine_mesh_cache_version);
    add_list(hash, mesh.vertices_m);
    add_list(hash, mesh.colours);
    add_list(hash, mesh.triangles);
    add_list(hash, mesh.normals);
    add_list(hash, mesh.corner_normals);
    add_list(hash, mesh.triangle_materials);
    for (const models::Material& material : mesh.materials) {
        hash.add(std::as_bytes(std::span(&material.colour, 1)));
    }
    return hash.value();
}

/// The file beside a hierarchy that tells what was repaired before it was made.
fs::path repairs_file(fs::path file) {
    return file.replace_extension(".repairs");
}

void write_repairs(const fs::path& file, const std::vector<std::string>& repairs) {
    ordercache::BinaryWriter out;
    out.number(std::uint64_t{repairs.size()});
    for (const std::string& line : repairs) {
        out.text(line);
    }
    out.number(checksum_of(out.bytes()));
    write_file(file, out.bytes());
}

/// Throws Error.
std::vector<std::string> read_repairs(const fs::path& file) {
    constexpr std::size_t max_bytes = std::size_t{1} << 16U;
    const std::string bytes = read_file(file, max_bytes);
    try {
        ordercache::BinaryReader in(bytes);
        std::vector<std::string> repairs(in.count(sizeof(std::uint64_t)));
        for (std::string& line : repairs) {
            line = in.text();
        }
        const std::string_view summed(bytes.data(), bytes.size() - in.bytes_left());
        if (in.number<std::uint64_t>() != checksum_of(summed) || in.bytes_left() > 0) {
            throw Error("expected the bytes of its checksum, got others");
        }
        return repairs;
    } catch (const Error& fault) {
        throw_error_in(file, fault.what());
    }
}

/// Without its notes. Nothing, and a note where there is a file, when it cannot be used.
std::optional<RefineMesh> read_cached_mesh(const fs::path& file, std::vector<std::string>& notes) {
    if (!path_exists(file)) {
        return std::nullopt;
    }
    try {
        RefineMesh kept;
        kept.mesh = std::make_shared<const refine::ProgressiveMesh>(refine::read_progressive(file));
        if (!kept.mesh->parts().notes.empty()) {
            throw_error_in(file, "expected a whole file, got one that was cut off");
        }
        kept.repairs = read_repairs(repairs_file(file));
        return kept;
    } catch (const Error& fault) {
        notes.push_back(fmt::format("order cache {}: made anew", fault.what()));
        return std::nullopt;
    }
}

} // namespace

fs::path refine_mesh_cache_file(const fs::path& folder, const models::TriangleMesh& mesh) {
    return folder / fmt::format("{:016x}{:016x}.pm", hash_of(mesh, 1), hash_of(mesh, 2));
}

RefineMesh
cached_refine_mesh(const fs::path& folder, const RefineMeshOptions& input, models::TriangleMesh mesh) {
    const fs::path file = refine_mesh_cache_file(folder, mesh);
    std::vector<std::string> notes;
    if (auto kept = read_cached_mesh(file, notes)) {
        kept->notes = std::move(mesh.notes);
        note_repairs(input, *kept);
        return std::move(*kept);
    }
    RefineMesh made = make_refine_mesh(input, std::move(mesh));
    try {
        write_repairs(repairs_file(file), made.repairs); // first: a hierarchy never lacks them
        refine::write_progressive(file, *made.mesh);
    } catch (const Error& fault) {
        notes.push_back(fmt::format("order cache {}: not kept", fault.what()));
    }
    made.notes.insert(made.notes.end(), notes.begin(), notes.end());
    return made;
}

} // namespace octant::ui::world
