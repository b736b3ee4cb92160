#include "models/meshfile/meshopt_decoder.h"
#include "sim/base/error.h"

#include <catch2/catch.hpp>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

using namespace octant::models::meshfile;
using Mode = MeshoptView::Mode;
using Filter = MeshoptView::Filter;

namespace {

template <typename Number>
std::vector<Number> numbers(const std::string& bytes) {
    std::vector<Number> found(bytes.size() / sizeof(Number));
    std::memcpy(found.data(), bytes.data(), bytes.size());
    return found;
}

std::string bytes_of(std::initializer_list<int> values) {
    std::string bytes;
    for (const int value : values) { bytes += static_cast<char>(value); }
    return bytes;
}

/// Attributes of four bytes: first byte raw (mode 3), second in four bits, third in two bits, fourth all the same.
std::string packed_attributes() {
    std::string bytes = bytes_of({0xa0});
    bytes += bytes_of({3});
    for (int i = 0; i < 16; ++i) { bytes += static_cast<char>(2); } // each 1 more than the one before
    bytes += bytes_of({2, 0x2f, 0, 0, 0, 0, 0, 0, 0, 40});          // +1, then an escape for +20, then nothing
    bytes += bytes_of({1, 0x10, 0, 0, 0});                          // -1 at the second element
    bytes += bytes_of({0});
    bytes += std::string(28, '\0') + bytes_of({10, 20, 30, 40});
    return bytes;
}

std::string fault_of(std::string_view packed, const MeshoptView& view) {
    try {
        meshopt_unpacked(packed, view);
    } catch (const octant::Error& fault) { return fault.what(); }
    return "accepted";
}

} // namespace

TEST_CASE("attributes are unpacked byte by byte from differences of 0, 2, 4 and 8 bits") {
    const auto bytes =
        numbers<std::uint8_t>(meshopt_unpacked(packed_attributes(), {Mode::Attributes, Filter::None, 3, 4}));
    CHECK(bytes == std::vector<std::uint8_t>{11, 21, 30, 40, 12, 41, 29, 40, 13, 41, 29, 40});
}

TEST_CASE("triangles are unpacked from what they share with the ones before") {
    const std::string table(16, '\0');
    const auto one =
        numbers<std::uint16_t>(meshopt_unpacked(bytes_of({0xe1, 0xf0}) + table, {Mode::Triangles, Filter::None, 3, 2}));
    CHECK(one == std::vector<std::uint16_t>{0, 1, 2});
    const auto strip = numbers<std::uint32_t>(
        meshopt_unpacked(bytes_of({0xe1, 0xf0, 0x00, 0x10}) + table, {Mode::Triangles, Filter::None, 9, 4}));
    CHECK(strip == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 3, 2, 4});
    // 0xff: all corners are written as differences, each from the one before: 5, 7, 4.
    const auto free = numbers<std::uint32_t>(
        meshopt_unpacked(bytes_of({0xe1, 0xff, 0xff, 10, 4, 5}) + table, {Mode::Triangles, Filter::None, 3, 4}));
    CHECK(free == std::vector<std::uint32_t>{5, 7, 4});
}

TEST_CASE("indices are unpacked from differences of two rows") {
    const auto found = numbers<std::uint32_t>(
        meshopt_unpacked(bytes_of({0xd1, 0x14, 0x05, 0x04, 0, 0, 0, 0}), {Mode::Indices, Filter::None, 3, 4}));
    CHECK(found == std::vector<std::uint32_t>{5, 1, 6});
}

TEST_CASE("filters give directions of length 1 and floats of exponents") {
    std::string bytes = bytes_of({0xa0});
    for (const int value : {0, 0, 127, 0}) {
        bytes += bytes_of({3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
        (void)value;
    }
    bytes += std::string(28, '\0') + bytes_of({0, 0, 127, 9});
    const auto up = numbers<std::int8_t>(meshopt_unpacked(bytes, {Mode::Attributes, Filter::Octahedral, 1, 4}));
    CHECK(up == std::vector<std::int8_t>{0, 0, 127, 9});
    bytes.replace(bytes.size() - 4, 4, bytes_of({3, 0, 0, 0xfe})); // 3 * 2^-2
    const auto real = numbers<float>(meshopt_unpacked(bytes, {Mode::Attributes, Filter::Exponential, 1, 4}));
    CHECK(real == std::vector<float>{0.75F});
}

TEST_CASE("packed bytes that end early, other versions and impossible counts are refused") {
    const std::string good = packed_attributes();
    CHECK_THAT(fault_of(good.substr(0, 40), {Mode::Attributes, Filter::None, 3, 4}), Catch::Contains("packed bytes"));
    CHECK_THAT(fault_of(good, {Mode::Attributes, Filter::None, 1'000'000, 4}), Catch::Contains("1000000 elements"));
    CHECK_THAT(fault_of(good, {Mode::Attributes, Filter::None, std::size_t{1} << 60U, 4}), Catch::Contains("at most"));
    CHECK_THAT(fault_of(good, {Mode::Attributes, Filter::None, 3, 3}), Catch::Contains("byteStride"));
    CHECK_THAT(fault_of(good, {Mode::Triangles, Filter::None, 3, 4}), Catch::Contains("version 0xe1, got 0xa0"));
    CHECK_THAT(fault_of("", {Mode::Indices, Filter::None, 3, 4}), Catch::Contains("version 0xd1"));
    CHECK_THAT(
        fault_of(bytes_of({0xe1}), {Mode::Triangles, Filter::None, 3000, 4}), Catch::Contains("whole triangles"));
    for (std::size_t cut = 0; cut < good.size(); ++cut) {
        CHECK(fault_of(good.substr(0, cut), {Mode::Attributes, Filter::None, 40, 4}) != "accepted");
    }
}
