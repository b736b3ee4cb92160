#include "tests/fuzz/obj_polygons.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <fmt/format.h>
#include <map>
#include <string_view>
#include <utility>

namespace octant::tests::fuzz {

namespace {

std::string number_text(double value, Digits digits) {
    return digits == Digits::All ? fmt::format("{}", value) : fmt::format("{:.6f}", value);
}

std::size_t vertex_of(std::string_view corner, std::size_t count) {
    const auto index = whole_number(corner.substr(0, corner.find('/')));
    const long signed_count = static_cast<long>(count);
    if (!index || *index == 0 || *index > signed_count || *index < -signed_count) {
        throw Error(fmt::format("expected a corner of one of {} vertices, got '{}'", count, corner));
    }
    return static_cast<std::size_t>(*index > 0 ? *index - 1 : signed_count + *index);
}

} // namespace

ObjPolygons obj_polygons(const Soup& soup, Digits digits) {
    ObjPolygons out;
    std::map<std::string, std::size_t> known;
    for (const auto& corners : soup) {
        auto& polygon = out.polygons.emplace_back();
        for (const glm::dvec3& corner : corners) {
            std::string text = fmt::format("{} {} {}", number_text(corner.x, digits), number_text(corner.y, digits),
                number_text(corner.z, digits));
            const auto [at, added] = known.try_emplace(text, out.vertices.size());
            if (added) { out.vertices.push_back(std::move(text)); }
            polygon.push_back(at->second);
        }
    }
    return out;
}

ObjPolygons read_obj_polygons(const std::filesystem::path& file) {
    ObjPolygons out;
    const std::string text = read_text_file(file);
    for (const std::string_view line : split_lines(text)) {
        const auto words = split_words(line);
        if (words.size() > 3 && words[0] == "v") {
            out.vertices.push_back(fmt::format("{} {} {}", words[1], words[2], words[3]));
        } else if (words.size() > 3 && words[0] == "f") {
            auto& polygon = out.polygons.emplace_back();
            for (std::size_t i = 1; i < words.size(); ++i) {
                polygon.push_back(vertex_of(words[i], out.vertices.size()));
            }
        }
    }
    return out;
}

std::string text_of(const ObjPolygons& model, const std::string& comment) {
    std::string text = "# " + comment + "\n";
    std::string faces;
    std::map<std::size_t, std::size_t> number;
    for (const auto& polygon : model.polygons) {
        faces += 'f';
        for (const std::size_t vertex : polygon) {
            const auto [at, added] = number.try_emplace(vertex, number.size() + 1);
            if (added) { text += fmt::format("v {}\n", model.vertices[vertex]); }
            faces += fmt::format(" {}", at->second);
        }
        faces += '\n';
    }
    return text + faces;
}

} // namespace octant::tests::fuzz
