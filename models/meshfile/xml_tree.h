#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace octant::models::meshfile {

/// Finds the file that a path in a FlightGear model names: relative to the model's folder or to a folder above it, such
/// as FlightGear's root. Empty if there is none.
std::filesystem::path flightgear_file(const std::filesystem::path& model, const std::string& name);

/// Returns the folder that a <texture-path> in a FlightGear model names; empty for an empty path.
std::filesystem::path flightgear_pictures(const std::filesystem::path& model, const std::string& texture_path);

/// An element of an XML file: its name, its own text without blanks at the ends, and its child elements. Of its
/// attributes only `include` is read.
struct XmlElement {
    std::string name;
    std::string text;
    std::string include; ///< the attribute of this name; empty if missing
    std::vector<XmlElement> children;
    int line = 0;

    /// The first child of this name; null if there is none.
    const XmlElement* find(std::string_view child) const;

    /// The text of the first child of this name; empty if there is none.
    std::string_view text_of(std::string_view child) const;
};

/// Parses an XML text and returns its root element, without comments, declarations and processing instructions. Reads
/// no other file. Throws Error "file:line: expected ..., got ...".
XmlElement xml_tree(const std::filesystem::path& file, std::string_view text);

} // namespace octant::models::meshfile
