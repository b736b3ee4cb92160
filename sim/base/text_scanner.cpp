#include "sim/base/text_scanner.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <utility>

namespace octant {

namespace {

constexpr std::size_t max_source_line_bytes = 65535; ///< also of a word
constexpr std::size_t source_piece_bytes = std::size_t{1} << 16U;
constexpr std::string_view blanks = " \t\n\v\f\r";
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

std::string_view without_blanks(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

bool is_comment_line(std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    return line.starts_with('#');
}

/// Removes the backslash at the end; false if there is none.
bool continues(std::string_view& line) {
    if (!line.ends_with('\\')) { return false; }
    line.remove_suffix(1);
    return true;
}

} // namespace

TextScanner::TextScanner(std::filesystem::path path, std::string_view text, const TextRules& rules, int line)
    : path_(std::move(path)), rules_(rules), text_(text), rest_(text), line_(line) {
    if (text.starts_with(byte_order_mark)) { rest_.remove_prefix(byte_order_mark.size()); }
    const auto set = [&](std::string_view characters, CharClass kind) {
        for (const char c : characters) { classes_[static_cast<unsigned char>(c)] = kind; }
    };
    set(blanks, CharClass::Blank);
    set(rules.separators, CharClass::Blank);
    set(rules.marks, CharClass::Mark);
    if (rules.comment != '\0') { set({&rules.comment, 1}, CharClass::Comment); }
    if (rules.has_strings) { set("\"", CharClass::Quote); }
}

TextScanner::TextScanner(std::filesystem::path path, TextSource source, const TextRules& rules)
    : TextScanner(std::move(path), std::string_view(), rules) {
    source_ = std::move(source);
    buffer_ = std::make_unique<char[]>(max_source_line_bytes + source_piece_bytes);
    text_ = rest_ = {buffer_.get(), 0};
}

TextScanner TextScanner::of_file(const std::filesystem::path& path, const TextRules& rules) {
    const auto in = std::make_shared<std::ifstream>(open_file(path));
    TextScanner scanner(
        path,
        [in, path](char* to, std::size_t size) {
            in->read(to, static_cast<std::streamsize>(size));
            if (in->bad()) { throw_error_in(path, "cannot be read to its end"); }
            return static_cast<std::size_t>(in->gcount());
        },
        rules);
    scanner.refuses_zero_bytes_ = true;
    return scanner;
}

/// Moves the unread bytes, at most max_source_line_bytes, to the front of the buffer and reads more behind them; false
/// at the end of the text.
bool TextScanner::refill(std::string_view& unread) {
    if (!source_) { return false; }
    assert(unread.size() <= max_source_line_bytes);
    text_offset_ += static_cast<std::size_t>(unread.data() - text_.data());
    std::memmove(buffer_.get(), unread.data(), unread.size());
    const std::size_t more = source_(buffer_.get() + unread.size(), source_piece_bytes);
    text_ = unread = {buffer_.get(), unread.size() + more};
    word_ = {};
    return more > 0;
}

/// Takes the next line from after_lines_, which must not be empty.
std::string_view TextScanner::raw_line() {
    ++lines_read_;
    std::size_t end = after_lines_.find('\n');
    while (end == std::string_view::npos && after_lines_.size() <= max_source_line_bytes && refill(after_lines_)) {
        end = after_lines_.find('\n');
    }
    std::string_view line = after_lines_.substr(0, end);
    is_truncated_ = end == std::string_view::npos;
    if (source_ && line.size() > max_source_line_bytes) {
        throw_error_at(path_, lines_read_, fmt::format("expected at most {} bytes, got more", max_source_line_bytes));
    }
    after_lines_.remove_prefix(is_truncated_ ? line.size() : end + 1);
    if (refuses_zero_bytes_ && line.find('\0') != std::string_view::npos) {
        throw_error_in(path_, "expected text, got binary data");
    }
    if (line.ends_with('\r')) { line.remove_suffix(1); }
    return line;
}

bool TextScanner::next_line() {
    if (!is_by_line_) {
        is_by_line_ = true;
        after_lines_ = rest_;
        lines_read_ = line_ - 1;
    }
    if (after_lines_.empty() && !refill(after_lines_)) {
        line_ = lines_read_ + 1;
        return false;
    }
    current_line_ = raw_line();
    line_ = lines_read_;
    if (source_ && line_ == 1 && current_line_.starts_with(byte_order_mark)) {
        current_line_.remove_prefix(byte_order_mark.size());
    }
    if (rules_.joins_lines && !is_comment_line(current_line_) && continues(current_line_)) {
        joined_ = current_line_;
        bool has_more = true;
        while (has_more && (!after_lines_.empty() || refill(after_lines_))) {
            std::string_view part = raw_line();
            has_more = continues(part);
            joined_ += ' ';
            joined_ += part;
        }
        current_line_ = joined_;
    }
    rest_ = current_line_;
    word_ = {};
    return true;
}

const std::vector<std::string_view>& TextScanner::words() {
    words_.clear();
    const std::string_view unread = rest_;
    while (!peek().empty()) {
        words_.push_back(word_);
        rest_.remove_prefix(word_.size());
    }
    rest_ = unread;
    word_ = {};
    return words_;
}

/// Skips blanks and comments, and counts the line ends among them: LF, CRLF or CR.
void TextScanner::skip_blanks() {
    std::size_t at = 0;
    const auto reaches = [&](std::size_t place) { // whether the text has this many more bytes
        if (place < rest_.size()) { return true; }
        if (is_by_line_) { return false; }
        rest_.remove_prefix(at);
        place -= at;
        at = 0;
        return refill(rest_) && place < rest_.size();
    };
    for (; reaches(at); ++at) {
        const char c = rest_[at];
        const CharClass kind = class_of(c);
        if (kind == CharClass::Comment) {
            while (reaches(at + 1) && rest_[at + 1] != '\n') { ++at; }
        } else if (kind != CharClass::Blank) {
            break;
        } else if (c == '\n' || (c == '\r' && !is_by_line_ && (!reaches(at + 1) || rest_[at + 1] != '\n'))) {
            ++line_;
        }
    }
    rest_.remove_prefix(std::min(at, rest_.size()));
}

/// Bytes of the word that the unread part begins with.
std::size_t TextScanner::word_size() const {
    if (rest_.empty() || class_of(rest_.front()) == CharClass::Mark) { return std::min<std::size_t>(rest_.size(), 1); }
    std::size_t end = 1;
    if (class_of(rest_.front()) == CharClass::Quote) {
        while (end < rest_.size() && rest_[end] != '"') { end += rest_[end] == '\\' ? 2U : 1U; }
        if (end >= rest_.size()) { refuse("a quote at the end of a string", "the end of the file"); }
        return end + 1;
    }
    while (end < rest_.size() && class_of(rest_[end]) == CharClass::Word) { ++end; }
    return end;
}

std::string_view TextScanner::peek() {
    if (!word_.empty() && word_.data() == rest_.data()) { return word_; }
    skip_blanks();
    std::size_t size = word_size();
    while (size == rest_.size() && size <= max_source_line_bytes && !is_by_line_ && refill(rest_)) {
        size = word_size();
    }
    return word_ = rest_.substr(0, size);
}

std::string_view TextScanner::peek_second() {
    const std::string_view first = peek();
    const std::string_view unread = rest_;
    const int line = line_;
    word_or_end();
    const std::string_view second = peek();
    rest_ = unread;
    line_ = line;
    word_ = first;
    return second;
}

std::string_view TextScanner::word_or_end() {
    last_word_ = peek();
    rest_.remove_prefix(last_word_.size());
    if (rules_.has_strings) { line_ += static_cast<int>(std::ranges::count(last_word_, '\n')); }
    return last_word_;
}

std::string_view TextScanner::word(std::string_view what) {
    if (peek().empty()) { refuse_next(what); }
    return word_or_end();
}

bool TextScanner::skip(std::string_view word) {
    if (word.empty() || peek() != word) { return false; }
    word_or_end();
    return true;
}

std::optional<double> TextScanner::take_number() {
    const auto value = finite_number(peek());
    if (!value || std::abs(*value) > rules_.max_number) { return std::nullopt; }
    word_or_end();
    return value;
}

std::optional<long> TextScanner::take_integer(long min, long max) {
    const auto value = whole_number(peek());
    if (!value || *value < min || *value > max) { return std::nullopt; }
    word_or_end();
    return value;
}

double TextScanner::number(std::string_view what) {
    const auto value = take_number();
    if (!value) { refuse_next(what); }
    return *value;
}

long TextScanner::integer(std::string_view what, long min, long max) {
    const auto value = take_integer(min, max);
    if (!value) {
        const bool names_range = !peek().empty() && min != std::numeric_limits<long>::min();
        refuse_next(names_range ? fmt::format("{} of {} to {}", what, min, max) : std::string(what));
    }
    return *value;
}

std::string_view TextScanner::rest_of_line() {
    const std::string_view rest = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(rest.size());
    return without_blanks(rest);
}

void TextScanner::skip_bytes(std::size_t count, std::string_view what) {
    if (count > rest_.size()) {
        refuse(fmt::format("{} ({} bytes)", what, count), fmt::format("{} to the end of the file", rest_.size()));
    }
    line_ += static_cast<int>(std::ranges::count(rest_.substr(0, count), '\n'));
    rest_.remove_prefix(count);
}

std::size_t TextScanner::offset() const {
    const std::string_view unread = is_by_line_ ? after_lines_ : rest_;
    return text_offset_ + static_cast<std::size_t>(unread.data() - text_.data());
}

void TextScanner::refuse(std::string_view expected, std::string_view got) const {
    throw_error_at(path_, line_, fmt::format("expected {}, got {}", expected, got));
}

void TextScanner::refuse_next(std::string_view expected) {
    const std::string_view next = peek();
    refuse(expected, !next.empty() ? in_quotes(next) : is_by_line_ ? "none" : "the end of the file");
}

void TextScanner::refuse_last(std::string_view expected) const { refuse(expected, in_quotes(last_word_)); }

} // namespace octant
