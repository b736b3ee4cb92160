#include "tests/ui/commands/printed_json.h"

#include <nlohmann/json.hpp>
#include <ostream>
#include <utility>

namespace octant::tests {

using Json = nlohmann::ordered_json;

PrintedJson::PrintedJson(const std::string& text) : part_(std::make_shared<const Json>(Json::parse(text))) {}

PrintedJson::PrintedJson(std::shared_ptr<const Json> part) : part_(std::move(part)) {}

PrintedJson PrintedJson::operator[](std::string_view name) const {
    return PrintedJson({part_, &part_->at(std::string(name))});
}

PrintedJson PrintedJson::operator[](std::size_t place) const { return PrintedJson({part_, &part_->at(place)}); }

std::vector<PrintedJson> PrintedJson::elements() const {
    std::vector<PrintedJson> all;
    for (std::size_t i = 0; i < size(); ++i) { all.push_back((*this)[i]); }
    return all;
}

std::vector<std::string> PrintedJson::names() const {
    std::vector<std::string> all;
    for (const auto& item : part_->items()) { all.push_back(item.key()); }
    return all;
}

std::size_t PrintedJson::size() const { return part_->size(); }

bool PrintedJson::contains(std::string_view name) const { return part_->contains(std::string(name)); }

bool PrintedJson::is_number() const { return part_->is_number(); }

bool PrintedJson::is_null() const { return part_->is_null(); }

double PrintedJson::number() const { return part_->get<double>(); }

std::string PrintedJson::text() const { return part_->get<std::string>(); }

bool PrintedJson::truth() const { return part_->get<bool>(); }

std::string PrintedJson::printed() const { return part_->dump(2); }

PrintedJson PrintedJson::without(std::initializer_list<std::string_view> names) const {
    Json rest = *part_;
    for (const std::string_view name : names) { rest.erase(std::string(name)); }
    return PrintedJson(std::make_shared<const Json>(std::move(rest)));
}

std::ostream& operator<<(std::ostream& out, const PrintedJson& json) { return out << json.printed(); }

} // namespace octant::tests
