#include "models/meshfile/flightgear_xml.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <new>
#include <pugixml.hpp>
#include <system_error>

namespace octant::models::meshfile {

namespace fs = std::filesystem;

fs::path flightgear_file(const fs::path& model, const std::string& name) {
    std::error_code ignored;
    for (fs::path folder = fs::absolute(model).parent_path();; folder = folder.parent_path()) {
        fs::path named = name;
        // "Aircraft/NAME/Models/..." where the aircraft's own folder is called something else
        for (int less = 0; less < 3 && !named.empty(); ++less) {
            if (fs::is_regular_file(folder / named, ignored)) { return folder / named; }
            fs::path shorter;
            for (auto part = std::next(named.begin()); part != named.end(); ++part) { shorter /= *part; }
            named = shorter;
        }
        if (folder == folder.parent_path()) { return {}; }
    }
}

fs::path flightgear_pictures(const fs::path& model, const std::string& texture_path) {
    const fs::path folder = fs::path(texture_path).relative_path();
    return folder.empty() ? fs::path() : model.parent_path() / folder;
}

namespace {

constexpr std::size_t largest_xml_bytes = std::size_t{64} << 20U;
constexpr int max_xml_depth = 100;

/// Makes elements of pugixml's nodes, which have an offset in the text instead of a line.
class XmlConversion {
public:
    XmlConversion(const fs::path& file, std::string_view text)
        : file_(std::make_shared<const fs::path>(file)), text_(text) {}

    [[noreturn]] void refuse(const pugi::xml_parse_result& fault) {
        const auto at = static_cast<std::size_t>(fault.offset);
        const std::string_view left = text_.substr(std::min(at, text_.size()), 20);
        throw_error_at(*file_, line_at(at),
            fmt::format("expected XML, got {} ({})", left.size() < 2 ? "the end of the file" : in_quotes(left),
                fault.description()));
    }

    XmlElement element(const pugi::xml_node& node, int depth) {
        XmlElement made;
        made.line = line_at(static_cast<std::size_t>(node.offset_debug()));
        made.file = file_;
        if (depth > max_xml_depth) {
            made.refuse(fmt::format("elements at most {} deep", max_xml_depth), "a deeper one");
        }
        made.name = node.name();
        made.include = node.attribute("include").value();
        constexpr long most = 100'000;
        if (const auto number = whole_number(node.attribute("n").value()); number && *number >= 0 && *number < most) {
            made.number = static_cast<int>(*number);
        }
        for (const pugi::xml_node& child : node) {
            if (child.type() == pugi::node_element) {
                made.children.push_back(element(child, depth + 1));
            } else {
                made.text += child.value();
            }
        }
        trim(made.text);
        return made;
    }

private:
    /// Offsets must not decrease from call to call.
    int line_at(std::size_t offset) {
        const std::string_view passed = text_.substr(offset_, offset - offset_);
        line_ += static_cast<int>(std::ranges::count(passed, '\n'));
        offset_ = offset;
        return line_;
    }

    static void trim(std::string& text) {
        constexpr std::string_view blanks = " \t\r\n";
        text.erase(0, std::min(text.find_first_not_of(blanks), text.size()));
        text.erase(text.find_last_not_of(blanks) + 1);
    }

    std::shared_ptr<const fs::path> file_;
    std::string_view text_;
    std::size_t offset_ = 0;
    int line_ = 1;
};

} // namespace

const XmlElement* XmlElement::find(std::string_view child) const {
    const auto found = std::ranges::find(children, child, &XmlElement::name);
    return found == children.end() ? nullptr : &*found;
}

std::string_view XmlElement::text_of(std::string_view child) const {
    const XmlElement* found = find(child);
    return found == nullptr ? std::string_view() : std::string_view(found->text);
}

void XmlElement::refuse(std::string_view expected, std::string_view got) const {
    throw_error_at(*file, line, fmt::format("expected {}, got {}", expected, got));
}

XmlElement read_xml(const fs::path& file) {
    const std::string text = read_text_file(file, largest_xml_bytes);
    pugi::xml_document document;
    const pugi::xml_parse_result result =
        document.load_buffer(text.data(), text.size(), pugi::parse_cdata | pugi::parse_escapes, pugi::encoding_utf8);
    XmlConversion conversion(file, text);
    if (result.status == pugi::status_out_of_memory) { throw std::bad_alloc(); }
    if (!result) { conversion.refuse(result); }
    return conversion.element(document.document_element(), 0);
}

} // namespace octant::models::meshfile
