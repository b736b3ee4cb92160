#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace octant::models::meshfile {

/// An element of an XML file: its name, the text right inside it without blanks at its ends, and the elements in it. Of
/// its attributes only `include` is kept.
struct XmlElement {
    std::string name;
    std::string text;
    std::string include; ///< the attribute of that name; empty where there is none
    std::vector<XmlElement> children;
    int line = 0;

    /// The first child of that name; null where there is none.
    const XmlElement* find(std::string_view child) const;

    /// Its text, empty where there is none.
    std::string_view text_of(std::string_view child) const;
};

/// The outermost element of an XML text. Comments, declarations and processing instructions are left out; nothing
/// outside the text is read. Throws Error "file:line: expected ..., got ...".
XmlElement xml_tree(const std::filesystem::path& file, std::string_view text);

} // namespace octant::models::meshfile
