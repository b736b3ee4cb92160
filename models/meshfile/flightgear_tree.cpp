#include "models/meshfile/flightgear_tree.h"

#include "models/meshfile/flightgear_paths.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <cstddef>
#include <fmt/format.h>
#include <iterator>
#include <string>
#include <utility>

namespace octant::models::meshfile {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_file_bytes = std::size_t{64} << 20U;
constexpr int most_depth = 8;

XmlElement tree_of(const fs::path& file, int depth);

void include_into(XmlElement& element, const fs::path& file, int depth) {
    const fs::path included =
        element.include.empty() ? fs::path() : flightgear_file(file, element.include);
    if (included.empty()) {
        return;
    }
    if (depth == most_depth) {
        error_at(
            file, element.line, fmt::format("expected includes at most {} deep, got more", depth));
    }
    XmlElement other = tree_of(included, depth + 1);
    element.children.insert(
        element.children.end(),
        std::make_move_iterator(other.children.begin()),
        std::make_move_iterator(other.children.end()));
}

XmlElement tree_of(const fs::path& file, int depth) {
    const std::string text = read_text_file(file, largest_file_bytes);
    XmlElement root = xml_tree(file, text);
    for (XmlElement& child : root.children) {
        include_into(child, file, depth);
    }
    include_into(root, file, depth);
    return root;
}

} // namespace

XmlElement flightgear_tree(const fs::path& file) {
    return tree_of(file, 0);
}

} // namespace octant::models::meshfile
