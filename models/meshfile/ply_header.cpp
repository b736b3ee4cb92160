#include "models/meshfile/ply_header.h"

#include "models/meshfile/word_scanner.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <array>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace octant::models::meshfile {

namespace {

using Words = std::vector<std::string_view>;

constexpr std::size_t max_properties = 1000; ///< of all elements

struct TypeName {
    std::string_view name;
    PlyType type;
};

constexpr std::array<TypeName, 16> type_names{
    {{"char", PlyType::i8},
     {"int8", PlyType::i8},
     {"uchar", PlyType::u8},
     {"uint8", PlyType::u8},
     {"short", PlyType::i16},
     {"int16", PlyType::i16},
     {"ushort", PlyType::u16},
     {"uint16", PlyType::u16},
     {"int", PlyType::i32},
     {"int32", PlyType::i32},
     {"uint", PlyType::u32},
     {"uint32", PlyType::u32},
     {"float", PlyType::f32},
     {"float32", PlyType::f32},
     {"double", PlyType::f64},
     {"float64", PlyType::f64}}};

/// The least that one element takes in the body: what a count is held against.
std::size_t min_element_bytes(const PlyElement& element, PlyEncoding form) {
    std::size_t bytes = 0;
    for (const PlyProperty& property : element.properties) {
        bytes += form == PlyEncoding::ascii ? 2
                 : property.is_list     ? bytes_of(property.count_type)
                                        : bytes_of(property.type);
    }
    return bytes;
}

class HeaderReading {
public:
    HeaderReading(const std::filesystem::path& path, std::string_view bytes)
        : path_(path)
        , bytes_(bytes) {}

    PlyHeader read() {
        if (next_line() != "ply") {
            refuse("'ply'", in_quotes(text_));
        }
        bool has_form = false;
        while (next_line() != "end_header") {
            const Words words = split_words(text_);
            if (words.empty() || words[0] == "comment" || words[0] == "obj_info") {
                continue;
            }
            if (words[0] == "format") {
                take_form(words);
                has_form = true;
            } else if (words[0] == "element") {
                take_element(words);
            } else if (words[0] == "property") {
                take_property(words);
            } else {
                refuse("format, element, property, comment or end_header", in_quotes(text_));
            }
        }
        if (!has_form) {
            refuse("a format line in the header", "none");
        }
        header_.body_at = at_;
        header_.body_line = line_ + 1;
        check_counts();
        return std::move(header_);
    }

private:
    [[noreturn]] void refuse(std::string_view expected, std::string_view got) const {
        throw_error_at(path_, line_, fmt::format("expected {}, got {}", expected, got));
    }

    std::string_view next_line() {
        ++line_;
        const std::size_t end = bytes_.find('\n', at_);
        if (end == std::string_view::npos) {
            refuse("end_header", "the end of the file");
        }
        text_ = bytes_.substr(at_, end - at_);
        at_ = end + 1;
        while (!text_.empty() && (text_.back() == '\r' || text_.back() == ' ')) {
            text_.remove_suffix(1);
        }
        return text_;
    }

    void take_form(const Words& words) {
        const std::string_view form = words.size() > 1 ? words[1] : std::string_view();
        if (words.size() != 3 || words[2] != "1.0") {
            refuse("'format FORM 1.0'", in_quotes(text_));
        }
        if (form == "ascii") {
            header_.form = PlyEncoding::ascii;
        } else if (form == "binary_little_endian") {
            header_.form = PlyEncoding::little_endian;
        } else if (form == "binary_big_endian") {
            header_.form = PlyEncoding::big_endian;
        } else {
            refuse("ascii, binary_little_endian or binary_big_endian", in_quotes(form));
        }
    }

    void take_element(const Words& words) {
        const auto count = words.size() == 3 ? whole_number(words[2]) : std::nullopt;
        if (!count || *count < 0) {
            refuse("'element NAME COUNT'", in_quotes(text_));
        }
        element_lines_.push_back(line_);
        header_.elements.push_back({std::string(words[1]), static_cast<std::size_t>(*count), {}});
    }

    PlyType type_of(std::string_view name) const {
        for (const TypeName& known : type_names) {
            if (known.name == name) {
                return known.type;
            }
        }
        refuse("a type such as uchar, int or float", in_quotes(name));
    }

    void take_property(const Words& words) {
        const bool is_list = words.size() == 5 && words[1] == "list";
        if (!is_list && words.size() != 3) {
            refuse("'property TYPE NAME' or 'property list TYPE TYPE NAME'", in_quotes(text_));
        }
        if (header_.elements.empty()) {
            refuse("an element before its property", in_quotes(text_));
        }
        if (++properties_ > max_properties) {
            refuse(fmt::format("at most {} properties", max_properties), "more");
        }
        PlyProperty property;
        property.name = std::string(words.back());
        property.is_list = is_list;
        property.type = type_of(words[words.size() - 2]);
        if (is_list) {
            property.count_type = type_of(words[2]);
            if (normalization_divisor(property.count_type) == 1.0) {
                refuse("a whole number as the count of a list", in_quotes(text_));
            }
        }
        header_.elements.back().properties.push_back(std::move(property));
    }

    void check_counts() {
        const std::size_t room = bytes_.size() - header_.body_at;
        // The last number of an ascii body may stand without a blank behind it.
        const std::size_t spare = header_.form == PlyEncoding::ascii ? 1 : 0;
        for (std::size_t i = 0; i < header_.elements.size(); ++i) {
            const PlyElement& element = header_.elements[i];
            const std::size_t least = min_element_bytes(element, header_.form);
            if (least > 0 && element.count > (room + spare) / least) {
                line_ = element_lines_[i];
                refuse(
                    fmt::format(
                        "at most {} of {} in a file of this size",
                        (room + spare) / least,
                        in_quotes(element.name)),
                    std::to_string(element.count));
            }
        }
    }

    std::filesystem::path path_;
    std::string_view bytes_;
    std::string_view text_;
    std::size_t at_ = 0;
    int line_ = 0;
    std::size_t properties_ = 0;
    std::vector<int> element_lines_;
    PlyHeader header_;
};

} // namespace

std::size_t bytes_of(PlyType type) {
    switch (type) {
    case PlyType::i8:
    case PlyType::u8:
        return 1;
    case PlyType::i16:
    case PlyType::u16:
        return 2;
    case PlyType::i32:
    case PlyType::u32:
    case PlyType::f32:
        return 4;
    case PlyType::f64:
        break;
    }
    return 8;
}

double normalization_divisor(PlyType type) {
    switch (type) {
    case PlyType::i8:
        return 127.0;
    case PlyType::u8:
        return 255.0;
    case PlyType::i16:
        return 32767.0;
    case PlyType::u16:
        return 65535.0;
    case PlyType::i32:
        return 2147483647.0;
    case PlyType::u32:
        return 4294967295.0;
    case PlyType::f32:
    case PlyType::f64:
        break;
    }
    return 1.0;
}

PlyHeader read_ply_header(const std::filesystem::path& path, std::string_view bytes) {
    return HeaderReading(path, bytes).read();
}

} // namespace octant::models::meshfile
