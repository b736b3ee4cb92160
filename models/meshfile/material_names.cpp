#include "models/meshfile/material_names.h"

#include <fmt/format.h>
#include <set>
#include <string_view>

namespace octant::models::meshfile {

namespace {

std::string without_marks(std::string_view name) {
    std::string out(name);
    for (char& c : out) {
        const bool is_control = static_cast<unsigned char>(c) < 0x20;
        if (is_control || c == '"' || c == '\\' || c == 0x7f) { c = '_'; }
    }
    out.erase(0, out.find_first_not_of(' '));
    return out.substr(0, out.find_last_not_of(' ') + 1);
}

} // namespace

std::vector<std::string> unique_material_names(std::span<const Material> materials) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    for (const Material& material : materials) {
        const std::string wanted = without_marks(material.name);
        const std::string base = wanted.empty() ? "material" : wanted;
        std::string name = base;
        for (int number = 2; !taken.insert(name).second; ++number) { name = fmt::format("{}_{}", base, number); }
        names.push_back(name);
    }
    return names;
}

} // namespace octant::models::meshfile
