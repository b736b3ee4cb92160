#include "ui/base/other_names.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace octant::ui::base {

namespace {

using Names = std::vector<std::pair<std::string, std::string>>;

/// Folders and what they are called.
Names& names() {
    static Names all;
    return all;
}

} // namespace

void call_by(const std::filesystem::path& folder, const std::string& name) {
    names().emplace_back(folder.string(), name);
}

std::string with_other_names(std::string text) {
    for (const auto& [folder, name] : names()) {
        for (std::size_t at = text.find(folder); at != std::string::npos;
             at = text.find(folder, at + name.size())) {
            text.replace(at, folder.size(), name);
        }
    }
    return text;
}

} // namespace octant::ui::base
