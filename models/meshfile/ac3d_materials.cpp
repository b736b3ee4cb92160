#include "models/meshfile/ac3d_materials.h"

#include "sim/base/text_file.h"

#include <algorithm>
#include <utility>

namespace octant::models::meshfile {

namespace {

float colour_part(std::string_view word, const WordScanner& words) {
    const auto value = finite_number(word);
    if (!value || *value < 0.0 || *value > 1.0) {
        words.refuse("a part of a colour of 0 to 1", in_quotes(word));
    }
    return static_cast<float>(*value);
}

/// Of a transparency as the file has it; words that are no numbers are opaque.
float opacity_of(std::string_view trans) {
    return 1.0F - static_cast<float>(std::clamp(finite_number(trans).value_or(0.0), 0.0, 1.0));
}

} // namespace

std::string read_ac3d_name(std::string_view& line, const WordScanner& words) {
    const bool quoted = line.starts_with('"');
    const std::size_t end = line.find(quoted ? '"' : ' ', quoted ? 1 : 0);
    if (quoted && end == std::string_view::npos) {
        words.refuse("a name in quotes", in_quotes(line));
    }
    const std::size_t last = std::min(end, line.size());
    std::string name(line.substr(quoted ? 1 : 0, last - (quoted ? 1 : 0)));
    line.remove_prefix(std::min(last + 1, line.size()));
    return name;
}

void Ac3dMaterials::take(std::string_view word, WordScanner& words) {
    if (word == "MATERIAL") {
        take_line(words);
    } else if (word == "MAT") {
        read_block(words);
    } else {
        words.refuse("MATERIAL or OBJECT", in_quotes(word));
    }
}

/// Reads the rest of a line MATERIAL "name" rgb R G B ...
void Ac3dMaterials::take_line(WordScanner& words) {
    std::string_view rest = words.rest_of_line();
    Material material{.name = read_ac3d_name(rest, words)};
    const auto parts = split_words(rest);
    if (parts.size() < 4 || parts[0] != "rgb") {
        words.refuse("rgb and three numbers", in_quotes(rest));
    }
    for (int part = 0; part < 3; ++part) {
        material.colour[part] = colour_part(parts[static_cast<std::size_t>(part) + 1], words);
    }
    const auto trans = std::ranges::find(parts, "trans");
    const bool has_trans = trans != parts.end() && trans + 1 != parts.end();
    materials_.push_back({std::move(material), has_trans ? opacity_of(*(trans + 1)) : 1.0F, {}});
}

/// Reads MAT "name", lines such as rgb R G B, ENDMAT, which version c of the format has.
void Ac3dMaterials::read_block(WordScanner& words) {
    std::string_view rest = words.rest_of_line();
    Material material{.name = read_ac3d_name(rest, words)};
    float opacity = 1.0F;
    for (std::string_view word; (word = words.word("ENDMAT")) != "ENDMAT";) {
        for (int part = 0; word == "rgb" && part < 3; ++part) {
            material.colour[part] = colour_part(words.word("a part of a colour"), words);
        }
        const auto rest_words = split_words(words.rest_of_line());
        if (word == "trans" && !rest_words.empty()) {
            opacity = opacity_of(rest_words[0]);
        }
    }
    materials_.push_back({std::move(material), opacity, {}});
}

std::uint32_t
Ac3dMaterials::used(std::uint32_t number, const std::string& picture, MeshBuilder& mesh) {
    if (number == invalid_index) {
        return invalid_index;
    }
    FileMaterial& material = materials_[number];
    const auto [at, is_new] = material.index_by_picture.try_emplace(picture, invalid_index);
    if (is_new) {
        material.material.picture = picture;
        at->second = mesh.add_material(material.material, material.opacity);
    }
    return at->second;
}

} // namespace octant::models::meshfile
