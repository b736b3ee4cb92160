#pragma once

#include "visuals/verify/certificate.h"
#include "visuals/verify/certificate_words.h"

#include <cstdint>
#include <vector>

namespace octant::visuals::verify {

/// Reads the lines of a certificate that tell of the model and of its order: tolerance, vertex,
/// axis, polygon, turning, list and node.
class StructureReader {
public:
    StructureReader(CertificateWords& words, Certificate& made)
        : words_(words)
        , made_(made) {}

    /// Reads the line at hand if it is one of these; false if its first word is another.
    bool take();

private:
    bool take_tolerance();
    bool take_about();
    bool take_vertex();
    bool take_axis();
    bool take_polygon(bool turning);
    bool take_list();
    bool take_node();
    int child(bool may_be_nothing, bool may_be_node);

    CertificateWords& words_;
    Certificate& made_;
    std::vector<bool> used_; ///< One flag for each polygon; all are false between lines.
};

} // namespace octant::visuals::verify
