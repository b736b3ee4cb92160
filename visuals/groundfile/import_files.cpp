// The files around an import: nothing of the user's is overwritten, and a finished file appears
// under its name in one step.
#include "visuals/groundfile/import_files.h"

#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "visuals/groundfile/ground_file.h"
#include "visuals/groundfile/ground_header.h"
#include "visuals/groundfile/mapped_file.h"

#include <bit>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <string>
#include <system_error>

namespace octant::visuals::groundfile {

using std::filesystem::path;

std::uint64_t
hash_of_inputs(const std::vector<path>& inputs, const models::heights::ImportOptions& options) {
    Hash hash;
    hash.add_word(GroundHeader::current_version);
    hash.add_word(std::bit_cast<std::uint64_t>(options.spacing_m));
    hash.add_word(std::bit_cast<std::uint64_t>(options.height_scale.value_or(0.0)));
    for (const std::optional<std::string>& text : {options.system, options.band}) {
        hash.add_word(text ? text->size() + 1 : 0);
        const std::string bytes = text.value_or("");
        hash.add(std::as_bytes(std::span(bytes)));
    }
    hash.add_word(options.voids.only ? 1 : 0);
    hash.add_word(options.voids.values.size());
    hash.add(std::as_bytes(std::span(options.voids.values)));
    for (const path& input : inputs) {
        std::error_code code;
        const std::string name = std::filesystem::absolute(input, code).string();
        hash.add(std::as_bytes(std::span(name)));
        hash.add_word(std::filesystem::file_size(input, code));
        hash.add_word(static_cast<std::uint64_t>(
            std::filesystem::last_write_time(input, code).time_since_epoch().count()));
    }
    return hash.value();
}

void check_output(const std::vector<path>& inputs, const path& out, const path& part) {
    std::error_code code;
    for (const path& written : {out, part}) {
        for (const path& input : inputs) {
            if (std::filesystem::equivalent(input, written, code)) {
                throw_error_in(written, "expected a file to write, got one of the inputs");
            }
        }
        if (std::filesystem::exists(written, code) &&
            !std::filesystem::is_regular_file(written, code)) {
            throw_error_in(written, "expected a file to write, got a folder, device or pipe");
        }
    }
}

void check_partial_file(const path& part) {
    std::error_code code;
    if (!is_ground_file(part) && std::filesystem::file_size(part, code) > 0) {
        throw_error_in(
            part,
            "expected what an earlier import left, got another kind of file: move it away or "
            "choose another --out");
    }
}

void rename_into_place(const path& part, const path& out) {
    std::error_code code;
    std::filesystem::rename(part, out, code);
    if (code) {
        throw_error_in(out, fmt::format("cannot be written: {}", code.message()));
    }
    sync_folder_of(out);
}

} // namespace octant::visuals::groundfile
