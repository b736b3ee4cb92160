#pragma once

#include "visuals/verify/certificate.h"
#include "visuals/verify/certificate_tokens.h"

#include <cstdint>
#include <vector>

namespace octant::visuals::verify {

/// Reads the lines of a certificate that tell of the model and of its order: tolerance, vertex,
/// axis, polygon, turning, list and node.
class StructureReader {
public:
    StructureReader(CertificateTokens& words, Certificate& made)
        : words_(words)
        , made_(made) {}

    /// Reads the line at hand if it is one of these; false if its first word is another.
    bool take();

private:
    bool read_tolerance();
    bool read_reference();
    bool read_vertex();
    bool read_axis();
    bool read_polygon(bool turning);
    bool read_list();
    bool read_node();
    int child(bool may_be_nothing, bool may_be_node);

    CertificateTokens& words_;
    Certificate& made_;
    std::vector<bool> used_; ///< One flag for each polygon; all are false between lines.
};

} // namespace octant::visuals::verify
