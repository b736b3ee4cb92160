#include "ui/base/path_alias.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace octant::ui::base {

namespace {

using PathAliases = std::vector<std::pair<std::string, std::string>>;

/// Folders and what they are called.
PathAliases& path_aliases() {
    static PathAliases all;
    return all;
}

} // namespace

void set_path_alias(const std::filesystem::path& folder, const std::string& name) {
    path_aliases().emplace_back(folder.string(), name);
}

std::string with_path_aliases(std::string text) {
    for (const auto& [folder, name] : path_aliases()) {
        for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder, at + name.size())) {
            text.replace(at, folder.size(), name);
        }
    }
    return text;
}

} // namespace octant::ui::base
