#include "models/repair/vertex_welding.h"

#include "models/triangle_mesh.h"

#include <array>
#include <bit>
#include <unordered_map>

namespace octant::models::repair {

namespace {

struct Key {
    std::array<std::uint64_t, 3> place{};
    std::array<std::uint32_t, 3> colour{};

    bool operator==(const Key&) const = default;
};

struct KeyHash {
    std::size_t operator()(const Key& key) const {
        std::uint64_t hash = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            hash = (hash ^ key.place[k]) * 0x9e3779b97f4a7c15ULL;
            hash ^= hash >> 29U;
            hash = (hash ^ key.colour[k]) * 0xbf58476d1ce4e5b9ULL;
            hash ^= hash >> 32U;
        }
        return hash;
    }
};

} // namespace

std::vector<std::uint32_t> first_duplicates(
    std::span<const glm::dvec3> vertices_m, std::span<const glm::vec3> colours, const std::vector<bool>& used) {
    std::unordered_map<Key, std::uint32_t, KeyHash> first_of;
    first_of.reserve(vertices_m.size());
    std::vector<std::uint32_t> firsts(vertices_m.size(), invalid_index);
    for (std::uint32_t v = 0; v < firsts.size(); ++v) {
        if (!used[v]) { continue; }
        Key key;
        for (int k = 0; k < 3; ++k) {
            const auto part = static_cast<std::size_t>(k);
            key.place[part] = std::bit_cast<std::uint64_t>(vertices_m[v][k] + 0.0); // -0 + 0 is 0
            if (!colours.empty()) { key.colour[part] = std::bit_cast<std::uint32_t>(colours[v][k] + 0.0F); }
        }
        firsts[v] = first_of.try_emplace(key, v).first->second;
    }
    return firsts;
}

void average_colours(std::vector<glm::vec3>& colours, std::span<const std::uint32_t> welded) {
    std::vector<glm::vec3> sums(colours.size(), glm::vec3(0.0F));
    std::vector<std::uint32_t> counts(colours.size(), 0);
    for (std::uint32_t v = 0; v < colours.size(); ++v) {
        if (welded[v] != invalid_index) {
            sums[welded[v]] += colours[v];
            ++counts[welded[v]];
        }
    }
    for (std::uint32_t v = 0; v < colours.size(); ++v) {
        if (counts[v] > 1) { colours[v] = sums[v] / static_cast<float>(counts[v]); }
    }
}

} // namespace octant::models::repair
