#include "models/polygons/mtl_reader.h"

#include "models/polygons/obj_line_reader.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <fmt/format.h>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace octant::models::polygons {

namespace {

constexpr std::size_t largest_mtl_bytes = std::size_t{16} << 20U;

class MtlReading {
public:
    explicit MtlReading(const std::filesystem::path& path) : path_(path) {}

    std::vector<Material> read() {
        const std::string text = read_text_file(path_, largest_mtl_bytes);
        for (const std::string_view line : split_lines(without_byte_order_mark(text))) {
            ++line_;
            const auto words = split_words(line);
            if (!words.empty() && words[0] == "newmtl") {
                add_material(std::string(after_first_word(line)));
            } else if (!words.empty() && words[0] == "Kd") {
                set_colour(words, line);
            }
        }
        return std::move(materials_);
    }

private:
    void add_material(const std::string& name) {
        if (name.empty()) { throw_error_at(path_, line_, "expected a material name after newmtl, got none"); }
        if (!names_.insert(name).second) {
            throw_error_at(path_, line_, fmt::format("expected a new material name, got '{}' again", printable(name)));
        }
        materials_.push_back({.name = name});
    }

    void set_colour(const std::vector<std::string_view>& words, std::string_view line) {
        if (materials_.empty()) { throw_error_at(path_, line_, "expected newmtl before Kd, got Kd"); }
        glm::vec3 colour(0.0F);
        bool good = words.size() == 4;
        for (int part = 0; good && part < 3; ++part) {
            const auto value = finite_number(words[static_cast<std::size_t>(part) + 1]);
            good = value && *value >= 0.0 && *value <= 1.0;
            colour[part] = good ? static_cast<float>(*value) : 0.0F;
        }
        if (!good) {
            throw_error_at(path_, line_,
                fmt::format("expected Kd and three numbers 0..1, got '{}'", printable(std::string(line))));
        }
        materials_.back().colour = colour;
    }

    std::filesystem::path path_;
    std::vector<Material> materials_;
    std::set<std::string> names_;
    int line_ = 0;
};

} // namespace

std::vector<Material> read_mtl(const std::filesystem::path& path) { return MtlReading(path).read(); }

std::map<std::string, std::string> pictures_of_mtl(const std::filesystem::path& path) {
    const std::string text = read_text_file(path, largest_mtl_bytes);
    std::map<std::string, std::string> pictures;
    std::string material;
    for (const std::string_view line : split_lines(without_byte_order_mark(text))) {
        const auto words = split_words(line);
        if (!words.empty() && words[0] == "newmtl") {
            material = std::string(after_first_word(line));
        } else if (words.size() >= 2 && words[0] == "map_Kd") {
            const bool has_options = words[1].starts_with('-'); // else the name may have blanks
            pictures.insert_or_assign(material, std::string(has_options ? words.back() : after_first_word(line)));
        }
    }
    return pictures;
}

std::map<std::string, float> opacities_of_mtl(const std::filesystem::path& path) {
    const std::string text = read_text_file(path, largest_mtl_bytes);
    std::map<std::string, float> by_d;
    std::map<std::string, float> all; // by Tr at first
    std::string material;
    for (const std::string_view line : split_lines(without_byte_order_mark(text))) {
        const auto words = split_words(line);
        if (!words.empty() && words[0] == "newmtl") { material = std::string(after_first_word(line)); }
        const auto value = words.size() == 2 ? finite_number(words[1]) : std::nullopt;
        if (!value || *value < 0.0 || *value > 1.0) { continue; }
        if (words[0] == "d") {
            by_d.insert_or_assign(material, static_cast<float>(*value));
        } else if (words[0] == "Tr" && *value < 1.0) {
            all.insert_or_assign(material, 1.0F - static_cast<float>(*value));
        }
    }
    for (const auto& [name, opacity] : by_d) { all.insert_or_assign(name, opacity); }
    std::erase_if(all, [](const auto& one) { return one.second >= 1.0F; });
    return all;
}

} // namespace octant::models::polygons
