#pragma once

#include <filesystem>
#include <memory>
#include <optional>
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
/// attributes only `include` and `n` are read.
struct XmlElement {
    std::string name;
    std::string text;
    std::string include;       ///< the attribute of this name; empty if missing
    std::optional<int> number; ///< the attribute `n`, which counts elements of one name
    std::vector<XmlElement> children;
    std::shared_ptr<const std::filesystem::path> file;
    int line = 0;

    /// Throws Error "file:line: expected ..., got ...".
    [[noreturn]] void refuse(std::string_view expected, std::string_view got) const;

    /// The first child of this name; null if there is none.
    const XmlElement* find(std::string_view child) const;

    /// The text of the first child of this name; empty if there is none.
    std::string_view text_of(std::string_view child) const;
};

/// Reads an XML file and returns its first element; files that it includes are not opened. Bytes of text are kept as
/// they are, whatever encoding the file declares, and unknown entities, too. Throws Error "file:line: expected ...,
/// got ..." for faulty XML, for elements more than 100 deep and for files above 64 MiB.
XmlElement read_xml(const std::filesystem::path& file);

} // namespace octant::models::meshfile
