#include "ui/base/json_file_name.h"

#include "sim/base/utf8.h"

#include <cstddef>
#include <fmt/format.h>
#include <string_view>

namespace octant::ui::base {

namespace {

constexpr std::string_view mark = "bytes:";

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length == 0) { return false; }
        text.remove_prefix(length);
    }
    return true;
}

/// The value of a hexadecimal digit as json_from_file_name writes it, or -1.
int digit_of(char letter) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    const std::size_t at = digits.find(letter);
    return at == std::string_view::npos ? -1 : static_cast<int>(at);
}

} // namespace

std::string json_from_file_name(const std::string& name) {
    if (is_utf8(name) && !name.starts_with(mark)) { return name; }
    std::string text(mark);
    for (const char letter : name) {
        const auto byte = static_cast<unsigned char>(letter);
        text += byte < 0x80 && letter != '%' ? std::string(1, letter) : fmt::format("%{:02X}", byte);
    }
    return text;
}

std::string file_name_from_json(const std::string& text) {
    if (!text.starts_with(mark)) { return text; }
    std::string name;
    for (std::size_t at = mark.size(); at < text.size(); ++at) {
        const bool pair =
            text[at] == '%' && at + 2 < text.size() && digit_of(text[at + 1]) >= 0 && digit_of(text[at + 2]) >= 0;
        if (pair) {
            name += static_cast<char>(16 * digit_of(text[at + 1]) + digit_of(text[at + 2]));
            at += 2;
        } else {
            name += text[at];
        }
    }
    return name;
}

} // namespace octant::ui::base
