#include "ui/world/referenced_files.h"

#include "models/meshfile/xml_tree.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace octant::ui::world {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_model_bytes = std::size_t{1} << 30U;
constexpr std::size_t max_files = 2'000;

/// What is left of a line after its first word, without quotes.
std::string after_first_word(std::string_view line) {
    constexpr std::string_view around = " \t\r\"";
    const std::size_t word_end = line.find_first_of(" \t");
    line.remove_prefix(std::min(word_end, line.size()));
    const std::size_t first = line.find_first_not_of(around);
    const std::size_t last = line.find_last_not_of(around);
    return first == line.npos ? std::string() : std::string(line.substr(first, last - first + 1));
}

/// Follows names from file to file.
class ReferenceCollector {
public:
    /// `pictures`: where those of an .ac file are looked for first; empty: beside it alone.
    void add_references(const fs::path& file, const fs::path& pictures = {}) {
        try {
            const std::string ending = extension_of(file);
            if (ending == ".ac") {
                add_ac3d_references(file, pictures.empty() ? file.parent_path() : pictures);
            } else if (ending == ".obj") {
                add_obj_references(file);
            } else if (ending == ".mtl") {
                add_material_references(file);
            } else if (ending == ".gltf") {
                add_gltf_references(file);
            } else if (ending == ".xml") {
                add_xml_references(file, models::meshfile::xml_tree(file, text_of(file)));
            }
        } catch (const Error&) { // whoever loads it says so
        }
    }

    std::vector<fs::path> files;

private:
    static std::string text_of(const fs::path& file) { return read_text_file(file, largest_model_bytes); }

    bool add(const fs::path& named) {
        std::error_code ignored;
        if (named.empty() || files.size() >= max_files || !fs::is_regular_file(named, ignored)) { return false; }
        const fs::path file = fs::absolute(named).lexically_normal();
        if (std::ranges::find(files, file) == files.end()) {
            files.push_back(file);
            add_references(file);
        }
        return true;
    }

    /// Searches as models::meshfile::picture_file does.
    void add_picture(const fs::path& folder, std::string name) {
        std::ranges::replace(name, '\\', '/');
        if (!name.empty() && !add(folder / name)) { add(folder / fs::path(name).filename()); }
    }

    void add_ac3d_references(const fs::path& file, const fs::path& pictures) {
        const std::string text = text_of(file);
        for (const std::string_view line : split_lines(text)) {
            if (line.starts_with("texture ")) { add_picture(pictures, after_first_word(line)); }
        }
    }

    void add_obj_references(const fs::path& file) {
        LineReader lines(file);
        while (const auto line = lines.next()) {
            const auto words = split_words(*line);
            if (words.size() < 2 || words.front() != "mtllib") { continue; }
            // One name with blanks, or several.
            add(file.parent_path() / std::string(words[1].data(), line->data() + line->size()));
            for (auto word = words.begin() + 1; word != words.end(); ++word) {
                add(file.parent_path() / std::string(*word));
            }
        }
    }

    void add_material_references(const fs::path& file) {
        const std::string text = text_of(file);
        for (const std::string_view line : split_lines(text)) {
            const auto words = split_words(line);
            if (words.size() >= 2 && words.front() == "map_Kd") {
                add_picture(
                    file.parent_path(), words[1].starts_with('-') ? std::string(words.back()) : after_first_word(line));
            }
        }
    }

    /// All that stands behind "uri", but data that stand there themselves.
    void add_gltf_references(const fs::path& file) {
        constexpr std::string_view key = "\"uri\"";
        const std::string text = text_of(file);
        for (std::size_t at = text.find(key); at != text.npos; at = text.find(key, at)) {
            at += key.size();
            const std::size_t open = text.find('"', at);
            const std::size_t close = open == text.npos ? open : text.find('"', open + 1);
            if (close == text.npos) { return; }
            if (text.compare(open + 1, 5, "data:") != 0) {
                add(file.parent_path() / text.substr(open + 1, close - open - 1));
            }
        }
    }

    void add_xml_references(const fs::path& file, const models::meshfile::XmlElement& element) {
        if (!element.include.empty()) { add(models::meshfile::flightgear_file(file, element.include)); }
        const fs::path pictures =
            models::meshfile::flightgear_pictures(file, std::string(element.text_of("texture-path")));
        for (const models::meshfile::XmlElement& child : element.children) {
            if (child.name == "path") {
                const fs::path named = models::meshfile::flightgear_file(file, child.text);
                add(named);
                if (!pictures.empty() && extension_of(named) == ".ac") { add_references(named, pictures); }
            }
            add_xml_references(file, child);
        }
    }
};

} // namespace

std::vector<fs::path> referenced_files(const fs::path& model) {
    ReferenceCollector following;
    following.add_references(model);
    std::erase(following.files, fs::absolute(model).lexically_normal());
    return std::move(following.files);
}

} // namespace octant::ui::world
