// A file is: signature, version, the key, the order, and a checksum of all bytes before it. The key
// is a copy of all that decides the order, not a hash of it, so that a file is either of this very
// model or not used.
#include "visuals/ordercache/order_cache.h"

#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "visuals/ordercache/binary_file.h"
#include "visuals/ordercache/order_file_format.h"

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace octant::visuals::ordercache {

namespace fs = std::filesystem;
using draworder::OrderedModel;
using draworder::OrderOptions;
using models::polygons::PolygonModel;

namespace {

/// "octorder" as a little-endian machine writes it; another machine's files read as something else.
constexpr std::uint64_t signature = 0x726564726f74636fULL;
constexpr std::size_t checksum_bytes = sizeof(std::uint64_t);
/// Larger orders are not kept, and larger files not read.
constexpr std::size_t max_bytes = std::size_t{1} << 30;

fs::path file_of_key(const fs::path& folder, std::string_view key) {
    return folder / fmt::format("{:016x}.order", checksum_of(key));
}

std::string file_bytes(std::string_view key, const OrderedModel& ordered) {
    BinaryWriter out;
    out.number(signature);
    out.number(order_version);
    out.text(key);
    out.raw(encode_order(ordered));
    out.number(checksum_of(out.bytes()));
    return out.bytes();
}

/// Throws Error "expected ..., got ...".
OrderedModel
from_file_bytes(std::string_view bytes, std::string_view key, const PolygonModel& given) {
    BinaryReader head(bytes);
    if (head.number<std::uint64_t>() != signature) {
        throw Error("expected a kept painting order, got another kind of file");
    }
    if (const auto version = head.number<std::uint32_t>(); version != order_version) {
        throw Error(fmt::format("expected version {}, got {}", order_version, version));
    }
    if (head.bytes_left() < checksum_bytes) {
        throw Error("expected a checksum, got the end of the file");
    }
    const std::string_view summed = bytes.substr(0, bytes.size() - checksum_bytes);
    const auto checksum = BinaryReader(bytes.substr(summed.size())).number<std::uint64_t>();
    if (checksum_of(summed) != checksum) {
        throw Error(fmt::format(
            "expected bytes of checksum {:016x}, got {:016x}", checksum, checksum_of(summed)));
    }
    BinaryReader rest(summed.substr(bytes.size() - head.bytes_left()));
    if (rest.text() != key) {
        throw Error("expected the order of this model, got that of another one");
    }
    return decode_order(summed.substr(summed.size() - rest.bytes_left()), given);
}

/// Throws Error "file: expected ..., got ...".
OrderedModel read_order(const fs::path& file, std::string_view key, const PolygonModel& given) {
    const std::string bytes = read_file(file, max_bytes);
    try {
        return from_file_bytes(bytes, key, given);
    } catch (const Error& fault) {
        throw_error_in(file, fault.what());
    }
}

/// The order that a file holds; nothing, and a note where there is a file, when it cannot be used.
std::optional<OrderedModel> kept_order(
    const fs::path& file,
    std::string_view key,
    const PolygonModel& given,
    std::vector<std::string>& notes) {
    std::error_code ignored;
    if (!fs::exists(file, ignored)) {
        return std::nullopt;
    }
    try {
        return read_order(file, key, given);
    } catch (const Error& fault) {
        notes.push_back(fmt::format("order cache {}: computed anew", fault.what()));
        return std::nullopt;
    }
}

/// Writes the file of an order; a note where that is not possible.
void keep(
    const fs::path& file,
    std::string_view key,
    const OrderedModel& ordered,
    std::vector<std::string>& notes) {
    const std::string bytes = file_bytes(key, ordered);
    try {
        if (bytes.size() > max_bytes) {
            throw_error_in(
                file, fmt::format("expected at most {} bytes, got {}", max_bytes, bytes.size()));
        }
        write_file(file, bytes);
    } catch (const Error& fault) {
        notes.push_back(fmt::format("order cache {}: not kept", fault.what()));
    }
}

} // namespace

void make_cache_folder(const fs::path& folder) {
    try {
        make_folder(folder);
    } catch (const Error& fault) {
        throw Error(fmt::format("order cache {}", fault.what()));
    }
    if (::access(folder.c_str(), R_OK | W_OK | X_OK) != 0) {
        throw Error(fmt::format(
            "order cache {}: expected a folder to read and write in, got: {}",
            folder.string(),
            std::strerror(errno)));
    }
}

CachedOrder cached_order(const fs::path& folder, PolygonModel model, const OrderOptions& options) {
    const std::string key = encode_key(model, options);
    const fs::path file = file_of_key(folder, key);
    std::vector<std::string> notes;
    if (auto kept = kept_order(file, key, model, notes)) {
        return {std::move(*kept), true, file, {}};
    }
    OrderedModel ordered = draworder::ordered(std::move(model), options);
    keep(file, key, ordered, notes);
    return {std::move(ordered), false, file, std::move(notes)};
}

} // namespace octant::visuals::ordercache
