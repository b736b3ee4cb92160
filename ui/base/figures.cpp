#include "ui/base/figures.h"

#include <algorithm>
#include <cassert>

namespace octant::ui::base {

Figures& Figures::operator[](std::string_view name) {
    if (std::holds_alternative<std::monostate>(value_)) {
        value_ = Named();
    }
    assert(std::holds_alternative<Named>(value_));
    auto& named = std::get<Named>(value_);
    const auto found = std::ranges::find(named, name, &Named::value_type::first);
    return found == named.end() ? named.emplace_back(std::string(name), Figures()).second
                                : found->second;
}

void Figures::push_back(Figures member) {
    if (std::holds_alternative<std::monostate>(value_)) {
        value_ = List();
    }
    assert(std::holds_alternative<List>(value_));
    std::get<List>(value_).push_back(std::move(member));
}

} // namespace octant::ui::base
