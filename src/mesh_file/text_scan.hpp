// Lines, words and numbers of a text, independent of the locale.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace pliant {

/// Iterates over the lines of a text, without their LF or CRLF.
class LineScanner {
public:
    /// Starts at byte `position`, with `lines_before` lines already counted.
    explicit LineScanner(std::string_view text, std::size_t position = 0, std::size_t lines_before = 0)
        : text_(text), position_(position), number_(lines_before)
    {
    }
    /// False at the end of the text; `line` and `number` are then still those of the last line.
    bool next();
    std::string_view line() const { return line_; }
    std::size_t number() const { return number_; }      ///< of the line, from 1
    std::size_t position() const { return position_; }  ///< first byte after the line

private:
    std::string_view text_, line_;
    std::size_t position_, number_;
};

/// Iterates over the words of a line, separated by blanks and tabs.
class WordScanner {
public:
    explicit WordScanner(std::string_view line) : rest_(line) {}
    /// Empty at the end of the line; words are never empty.
    std::string_view next();

private:
    std::string_view rest_;
};

/// The whole word as an integer; a leading plus is allowed.
std::optional<std::int64_t> integer_from(std::string_view word);
std::optional<std::uint64_t> count_from(std::string_view word);

/// The whole word as a finite number of single precision; numbers too small for it become 0.
std::optional<float> float_from(std::string_view word);

/// Whether the word is a number of any kind, including infinity and NaN.
bool is_number(std::string_view word);

/// The text for a message: shortened, without characters a terminal could trip over.
std::string printable(std::string_view text);
std::string in_quotes(std::string_view text);

}  // namespace pliant
