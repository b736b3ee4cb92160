#include "tests/ui/commands/json_schema.h"

#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/base/json_value.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <regex>

namespace octant::tests {

namespace {

using Json = nlohmann::ordered_json;

bool is_of(const std::string& type, const Json& value) {
    return (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
           (type == "string" && value.is_string()) || (type == "boolean" && value.is_boolean()) ||
           (type == "null" && value.is_null()) || (type == "number" && value.is_number()) ||
           (type == "integer" && value.is_number_integer());
}

class Checker {
public:
    explicit Checker(const Json& root) : root_(root) {}

    void check(const Json& schema, const Json& value, const std::string& at) {
        if (schema.is_boolean()) {
            expect(schema.get<bool>(), at, "nothing");
            return;
        }
        for (const auto& [word, wanted] : schema.items()) { check_word(schema, word, wanted, value, at); }
    }

    std::vector<std::string> faults;

private:
    void expect(bool holds, const std::string& at, const std::string& what) {
        if (!holds) { faults.push_back(at + ": expected " + what); }
    }

    bool fits(const Json& schema, const Json& value) {
        Checker alone(root_);
        alone.check(schema, value, "");
        return alone.faults.empty();
    }

    void check_word(
        const Json& schema, const std::string& word, const Json& wanted, const Json& value, const std::string& at) {
        if (word == "$ref") {
            check(root_.at(Json::json_pointer(wanted.get<std::string>().substr(1))), value, at);
        } else if (word == "type") {
            const bool fits_one =
                wanted.is_array() ? std::ranges::any_of(wanted, [&](const Json& type) { return is_of(type, value); })
                                  : is_of(wanted, value);
            expect(fits_one, at, wanted.dump() + ", got " + value.dump().substr(0, 60));
        } else if (word == "enum") {
            expect(std::ranges::find(wanted, value) != wanted.end(), at, "one of " + wanted.dump());
        } else if (word == "pattern") {
            expect(!value.is_string() ||
                       std::regex_search(value.get<std::string>(), std::regex(wanted.get<std::string>())),
                at, wanted.dump() + ", got " + value.dump());
        } else if (word == "minimum") {
            expect(!value.is_number() || value.get<double>() >= wanted.get<double>(), at, ">= " + wanted.dump());
        } else if (word == "maximum") {
            expect(!value.is_number() || value.get<double>() <= wanted.get<double>(), at, "<= " + wanted.dump());
        } else if (word == "required") {
            for (const Json& name : wanted) { expect(!value.is_object() || value.contains(name), at, name.dump()); }
        } else if (word == "properties") {
            for (const auto& [name, inner] : wanted.items()) {
                if (value.is_object() && value.contains(name)) { check(inner, value[name], at + "/" + name); }
            }
        } else if (word == "additionalProperties") {
            check_others(schema, wanted, value, at);
        } else if (word == "items") {
            for (std::size_t i = 0; value.is_array() && i < value.size(); ++i) {
                check(wanted, value[i], at + "/" + std::to_string(i));
            }
        } else if (word == "minItems" || word == "maxItems") {
            const auto count = wanted.get<std::size_t>();
            expect(!value.is_array() || (word == "minItems" ? value.size() >= count : value.size() <= count), at,
                word + " " + wanted.dump());
        } else if (word == "anyOf") {
            const bool any = std::ranges::any_of(wanted, [&](const Json& each) { return fits(each, value); });
            expect(any, at, "one of several, got " + value.dump().substr(0, 200));
        } else {
            const bool remark =
                word == "$schema" || word == "$id" || word == "$defs" || word == "title" || word == "description";
            expect(remark, at, "no word '" + word + "' in a schema");
        }
    }

    void check_others(const Json& schema, const Json& wanted, const Json& value, const std::string& at) {
        if (!value.is_object()) { return; }
        for (const auto& [name, inner] : value.items()) {
            if (!schema.contains("properties") || !schema["properties"].contains(name)) {
                check(wanted, inner, at + "/" + name);
            }
        }
    }

    const Json& root_;
};

} // namespace

std::vector<std::string> schema_faults(const std::string& json_text, const std::filesystem::path& schema_file) {
    const Json schema = Json::parse(read_file(schema_file));
    const Json value = Json::parse(json_text, nullptr, false);
    if (value.is_discarded()) { return {"expected JSON, got " + json_text.substr(0, 200)}; }
    Checker checker(schema);
    checker.check(schema, value, "");
    return checker.faults;
}

void check_row_schema(
    const std::filesystem::path& schema_file, const std::string& pointer, const ui::base::JsonValue& row_schema) {
    Json schema = Json::parse(read_file(schema_file));
    Json& object = schema.at(Json::json_pointer(pointer));
    const Json row = Json::parse(ui::base::json_of_results(row_schema));
    if (std::getenv("OCTANT_WRITE_SCHEMAS") != nullptr) {
        object["properties"].update(row["properties"]);
        for (const Json& name : row["required"]) {
            if (std::ranges::find(object["required"], Json(name)) == object["required"].end()) {
                object["required"].push_back(name);
            }
        }
        write_file(schema_file, schema.dump(1) + "\n");
    }
    for (const auto& [name, property] : row["properties"].items()) {
        INFO(schema_file.filename() << pointer << " " << name);
        CHECK(object["properties"].value(name, Json()) == property);
        CHECK(std::ranges::find(object["required"], Json(name)) != object["required"].end());
    }
}

} // namespace octant::tests
