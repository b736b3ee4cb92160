// Reads certificates of painting orders; README.md has their format. Lines that tell of the model
// and its order (structure_reader.cpp) come before the claims (claim_reader.cpp).
#include "visuals/verify/certificate_reader.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "visuals/verify/certificate_tokens.h"
#include "visuals/verify/statement_reader.h"
#include "visuals/verify/structure_reader.h"
#include "visuals/verify/region_plane_counts.h"

#include <optional>
#include <string_view>
#include <utility>

namespace octant::visuals::verify {

namespace {

constexpr std::size_t largest_bytes = std::size_t{2} << 30;

class CertificateParser {
public:
    explicit CertificateParser(const std::filesystem::path& path)
        : words_(path) {
        made_.path = path;
    }

    Certificate read(std::string_view text) {
        for (const std::string_view line : split_lines(text)) {
            if (words_.set_line(line)) {
                take();
            }
        }
        if (!has_header_) {
            throw_error_in(made_.path, "expected 'octant-certificate 1' first, got an empty file");
        }
        finish_structure();
        return std::move(made_);
    }

private:
    void take() {
        if (!has_header_) {
            if (!words_.skip("octant-certificate") || !words_.skip("1")) {
                words_.refuse("'octant-certificate 1' first");
            }
            has_header_ = true;
        } else if (const auto statement = read_statement_kind(words_)) {
            finish_structure();
            claims_->take(*statement);
        } else {
            take_structure();
        }
        words_.end_of_line();
    }

    void take_structure() {
        if (!structure_.take()) {
            words_.refuse("tolerance, about, vertex, axis, polygon, turning, list, node, pairs, "
                          "sum, never, away or unproved");
        }
        if (claims_) {
            throw_error_at(
                made_.path,
                words_.line(),
                "expected pairs, sum, never, away or unproved after the first of them, got "
                "something else");
        }
    }

    /// Once all nodes and lists are read: sees that they are one tree, of which claims may follow.
    void finish_structure() {
        if (!claims_) {
            claims_.emplace(words_, made_, count_region_planes(made_));
            made_.by_node.resize(made_.nodes.size());
            made_.by_list.resize(made_.lists.size());
        }
    }

    CertificateTokens words_;
    Certificate made_;
    StructureReader structure_{words_, made_};
    std::optional<StatementReader> claims_; ///< Nothing until the structure is read.
    bool has_header_ = false;
};

} // namespace

Certificate read_certificate(const std::filesystem::path& path) {
    return certificate_of(read_text_file(path, largest_bytes), path);
}

Certificate certificate_of(std::string_view text, const std::filesystem::path& name) {
    return CertificateParser(name).read(text);
}

} // namespace octant::visuals::verify
