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

constexpr std::size_t largest_xml_bytes = std::size_t{64} << 20U;
constexpr int max_include_depth = 8;
constexpr int max_files = 500;

XmlElement tree_of(const fs::path& file, int depth, int& files);

void include_into(XmlElement& element, const fs::path& file, int depth, int& files) {
    const fs::path included =
        element.include.empty() ? fs::path() : flightgear_file(file, element.include);
    if (included.empty()) {
        return;
    }
    if (depth == max_include_depth) {
        throw_error_at(
            file, element.line, fmt::format("expected includes at most {} deep, got more", depth));
    }
    if (++files > max_files) {
        throw_error_at(
            file, element.line, fmt::format("expected at most {} includes, got more", max_files));
    }
    XmlElement other = tree_of(included, depth + 1, files);
    element.children.insert(
        element.children.end(),
        std::make_move_iterator(other.children.begin()),
        std::make_move_iterator(other.children.end()));
}

XmlElement tree_of(const fs::path& file, int depth, int& files) {
    const std::string text = read_text_file(file, largest_xml_bytes);
    XmlElement root = xml_tree(file, text);
    for (XmlElement& child : root.children) {
        include_into(child, file, depth, files);
    }
    include_into(root, file, depth, files);
    return root;
}

} // namespace

XmlElement flightgear_tree(const fs::path& file) {
    int files = 0;
    return tree_of(file, 0, files);
}

} // namespace octant::models::meshfile
