#include "models/meshfile/byte_reader.h"

#include "sim/base/error.h"

#include <fmt/format.h>

namespace octant::models::meshfile {

std::string_view ByteReader::take(std::size_t count, const char* what) {
    if (bytes_left() < count) {
        refuse(fmt::format("{} ({} bytes)", what, count), fmt::format("{} to the end of the file", bytes_left()));
    }
    at_ += count;
    return bytes_.substr(at_ - count, count);
}

void ByteReader::refuse_at(std::size_t at, const std::string& expected, const std::string& got) const {
    throw_error_in(path_, fmt::format("at byte {}: expected {}, got {}", at, expected, got));
}

} // namespace octant::models::meshfile
