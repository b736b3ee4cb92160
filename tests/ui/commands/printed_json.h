#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <iosfwd>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace octant::tests {

template <class T>
concept JsonNumber = std::is_arithmetic_v<T> && !std::same_as<T, bool>;

/// JSON that the program printed, or a part of it, for looking at. Keeps the headers of the JSON library, which take
/// seconds to compile, out of the tests. What is not there, or of another kind than asked for, is thrown as an
/// exception, which fails the test.
class PrintedJson {
public:
    explicit PrintedJson(const std::string& text);

    PrintedJson operator[](std::string_view name) const;
    PrintedJson operator[](std::size_t place) const;

    std::vector<PrintedJson> elements() const;

    /// Of an object's members.
    std::vector<std::string> names() const;

    std::size_t size() const;
    bool contains(std::string_view name) const;
    bool is_number() const;
    bool is_null() const;
    double number() const;
    std::string text() const;
    bool truth() const;
    std::string printed() const;

    /// The same object without the members of these names.
    PrintedJson without(std::initializer_list<std::string_view> names) const;

    friend bool operator==(const PrintedJson& a, const PrintedJson& b) { return a.printed() == b.printed(); }

    friend bool operator==(const PrintedJson& a, const JsonNumber auto& b) {
        return a.number() == static_cast<double>(b);
    }

    friend bool operator==(const PrintedJson& a, const std::same_as<bool> auto& b) { return a.truth() == b; }

    friend bool operator==(const PrintedJson& a, std::string_view b) { return a.text() == b; }

    friend std::partial_ordering operator<=>(const PrintedJson& a, const PrintedJson& b) {
        return a.number() <=> b.number();
    }

    friend std::partial_ordering operator<=>(const PrintedJson& a, const JsonNumber auto& b) {
        return a.number() <=> static_cast<double>(b);
    }

    friend std::ostream& operator<<(std::ostream& out, const PrintedJson& json);

private:
    explicit PrintedJson(std::shared_ptr<const nlohmann::ordered_json> part);

    std::shared_ptr<const nlohmann::ordered_json> part_; ///< shares the whole
};

} // namespace octant::tests
