#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant {

/// How a text format separates words, in addition to blanks and line ends.
struct TextRules {
    std::string_view separators = {}; ///< more characters that separate words
    std::string_view marks = {};      ///< characters that are words of their own, such as brackets
    char comment = '\0';              ///< begins a comment, which ends with its line
    bool has_strings = false;         ///< "..." is one word with its quotes; \ hides the character behind it
    bool joins_lines = false;         ///< \ at the end of a line, except in a comment after #, joins the next line
    double max_number = std::numeric_limits<double>::max(); ///< absolute value
};

/// Writes at most `size` bytes to `to` and returns their number; 0 at the end.
using TextSource = std::function<std::size_t(char* to, std::size_t size)>;

/// Reads a text word by word or line by line, and refuses what is wrong with an Error "file:line: expected ..., got
/// ...". Words may be on any line until next_line() is called first; from then on they are those of the current line.
/// Views are valid as long as the text, for a TextSource and for joined lines until the next call.
class TextScanner {
public:
    /// Reads `text`, which must outlive the scanner and whose first line is line `line` of the file. Skips a UTF-8 byte
    /// order mark.
    TextScanner(std::filesystem::path path, std::string_view text, const TextRules& rules = {}, int line = 1);

    /// Reads a text that may be larger than memory. Lines and words have at most 65,535 bytes: next_line() throws Error
    /// for a longer line, a longer word is read as several words.
    TextScanner(std::filesystem::path path, TextSource source, const TextRules& rules = {});

    /// Reads a file line by line as above and skips a UTF-8 byte order mark. Throws Error if it is no regular file that
    /// can be read; next_line() throws Error for a zero byte.
    static TextScanner of_file(const std::filesystem::path& path, const TextRules& rules = {});

    /// Advances to the next line, without its line end (LF or CRLF); false if there is none.
    bool next_line();

    /// The current line, including the words that were read.
    std::string_view line() const { return current_line_; }

    /// True if the current line is the last one of the file and has no line end.
    bool is_truncated() const { return is_truncated_; }

    /// The words of the line that were not yet read.
    const std::vector<std::string_view>& words();

    /// The next word, which remains the next one; empty at the end of the text or line.
    std::string_view peek();

    /// The word after the next one. Only for texts in memory.
    std::string_view peek_second();

    /// Reads the next word; empty at the end of the text or line.
    std::string_view word_or_end();

    /// Reads the next word. Throws Error at the end; `what` describes the expected word.
    std::string_view word(std::string_view what);

    /// Reads the next word if it is this one; returns whether it was.
    bool skip(std::string_view word);

    /// Reads the next word if it is a finite number within TextRules::max_number, or an integer from `min` to `max`.
    std::optional<double> take_number();
    std::optional<long> take_integer(
        long min = std::numeric_limits<long>::min(), long max = std::numeric_limits<long>::max());

    /// Reads a number as take_number() does. Throws Error "expected `what`, got ...".
    double number(std::string_view what);

    /// Reads an integer. Throws Error "expected `what` of `min` to `max`, got ..."; without a range "expected `what`".
    long integer(std::string_view what, long min = std::numeric_limits<long>::min(),
        long max = std::numeric_limits<long>::max());

    /// Reads the rest of the current line without blanks at either end. The next word is on a later line.
    std::string_view rest_of_line();

    /// Skips `count` bytes. Throws Error if there are fewer. Only for texts in memory.
    void skip_bytes(std::size_t count, std::string_view what);

    /// Line of the word that was read or peeked last, of the current line the first if lines were joined; from 1.
    int line_number() const { return line_; }

    /// Byte of the text at which the unread part begins; after peek() the first byte of the next word.
    std::size_t offset() const;

    std::size_t bytes_left() const { return rest_.size(); }

    /// Throws Error "file:line: expected ..., got ...".
    [[noreturn]] void refuse(std::string_view expected, std::string_view got) const;

    /// The same about the next word, which may be missing, or about the word that was read last.
    [[noreturn]] void refuse_next(std::string_view expected);
    [[noreturn]] void refuse_last(std::string_view expected) const;

private:
    enum class CharClass : std::uint8_t { Word, Blank, Mark, Comment, Quote };

    CharClass class_of(char c) const { return classes_[static_cast<unsigned char>(c)]; }
    void skip_blanks();
    std::size_t word_size() const;
    bool refill(std::string_view& unread);
    std::string_view raw_line();

    std::filesystem::path path_;
    TextRules rules_;
    std::array<CharClass, 256> classes_{};
    std::string_view text_;        ///< all of it; of a source the part in memory
    std::string_view rest_;        ///< unread part of the text, or of the current line
    std::string_view after_lines_; ///< what follows the current line
    std::string_view current_line_;
    std::string_view word_; ///< peeked or read last
    std::string_view last_word_;
    std::vector<std::string_view> words_;
    std::string joined_; ///< the current line if it was joined
    int line_ = 1;
    int lines_read_ = 0; ///< by next_line()
    bool is_by_line_ = false;
    bool is_truncated_ = false;
    bool refuses_zero_bytes_ = false;
    TextSource source_;
    std::unique_ptr<char[]> buffer_; ///< of a source
    std::size_t text_offset_ = 0;    ///< bytes of the source before text_
};

} // namespace octant
