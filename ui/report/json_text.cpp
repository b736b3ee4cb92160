#include "ui/report/json_text.h"

#include "sim/base/error.h"

#include <algorithm>
#include <fmt/format.h>

namespace octant::ui::report {

namespace {

constexpr int deepest_nesting = 64;

} // namespace

int line_of_byte(const std::string& text, std::size_t byte) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
    return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
}

nlohmann::ordered_json parsed_json(const std::filesystem::path& path, const std::string& text) {
    using Json = nlohmann::ordered_json;
    const auto shallow = [&](int depth, Json::parse_event_t, Json&) {
        if (depth > deepest_nesting) {
            throw_error_in(path, fmt::format("expected at most {} levels of nesting, got more", deepest_nesting));
        }
        return true;
    };
    try {
        return Json::parse(text, shallow);
    } catch (const Json::parse_error& fault) {
        throw_error_at(path, line_of_byte(text, fault.byte == 0 ? 0 : fault.byte - 1),
            "expected JSON, got something else or a part of it");
    } catch (const Json::exception&) {
        throw_error_in(path, "expected JSON with numbers that fit into 64 bits, got others");
    }
}

} // namespace octant::ui::report
