#include "models/meshfile/vrml_tokenizer.h"

#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/word_scanner.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace octant::models::meshfile {

namespace {

constexpr std::string_view vrml_blanks = " \t\r\n,";
constexpr std::string_view marks = "{}[]";
constexpr std::string_view word_ends = " \t\r\n,{}[]#\"";

} // namespace

void VrmlTokenizer::skip_blanks() {
    while (at_ < text_.size()) {
        const char c = text_[at_];
        if (c == '#') {
            at_ = std::min(text_.find('\n', at_), text_.size());
        } else if (vrml_blanks.find(c) != std::string_view::npos) {
            line_ += static_cast<int>(c == '\n');
            ++at_;
        } else {
            return;
        }
    }
}

std::string_view VrmlTokenizer::peek() {
    skip_blanks();
    if (at_ == text_.size()) {
        return {};
    }
    if (is_punctuation(text_.substr(at_, 1))) {
        return text_.substr(at_, 1);
    }
    if (text_[at_] != '"') {
        const std::size_t end = text_.find_first_of(word_ends, at_ + 1);
        return text_.substr(at_, end == std::string_view::npos ? end : end - at_);
    }
    std::size_t end = at_ + 1;
    while (end < text_.size() && text_[end] != '"') {
        end += text_[end] == '\\' ? 2U : 1U;
    }
    if (end >= text_.size()) {
        refuse("a quote at the end of a string", "the end of the file");
    }
    return text_.substr(at_, end + 1 - at_);
}

std::string_view VrmlTokenizer::take(std::string_view what) {
    const std::string_view word = peek();
    if (word.empty()) {
        refuse(what, "the end of the file");
    }
    line_ += static_cast<int>(std::ranges::count(word, '\n'));
    at_ += word.size();
    return word;
}

double VrmlTokenizer::number(std::string_view what) {
    const std::string_view word = take(what);
    const auto value = finite_number(word);
    if (!value || std::abs(*value) > max_coordinate) {
        refuse(what, in_quotes(word));
    }
    return *value;
}

long VrmlTokenizer::whole(std::string_view what) {
    const std::string_view word = take(what);
    const auto value = whole_number(word);
    if (!value) {
        refuse(what, in_quotes(word));
    }
    return *value;
}

bool VrmlTokenizer::is_punctuation(std::string_view word) {
    return !word.empty() && marks.find(word.front()) != std::string_view::npos;
}

void VrmlTokenizer::refuse(std::string_view expected, std::string_view got) const {
    throw_error_at(*path_, line_, fmt::format("expected {}, got {}", expected, got));
}

} // namespace octant::models::meshfile
