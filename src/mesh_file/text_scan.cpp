#include "mesh_file/text_scan.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

namespace pliant {

namespace {

constexpr std::string_view blanks = " \t\r\v\f";

std::string_view without_plus(std::string_view word)
{
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    return word;
}

/// Also invalid_argument if anything follows the number.
template <class Number>
std::errc parse(std::string_view word, Number& value)
{
    word = without_plus(word);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return end == word.data() + word.size() ? error : std::errc::invalid_argument;
}

template <class Number>
std::optional<Number> parsed(std::string_view word)
{
    Number value = 0;
    if (parse(word, value) != std::errc{}) return {};
    return value;
}

}  // namespace

bool LineScanner::next()
{
    if (position_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', position_), text_.size());
    line_ = text_.substr(position_, end - position_);
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    position_ = std::min(end + 1, text_.size());
    ++number_;
    return true;
}

std::string_view WordScanner::next()
{
    rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(blanks));
    rest_.remove_prefix(word.size());
    return word;
}

std::optional<std::int64_t> integer_from(std::string_view word) { return parsed<std::int64_t>(word); }
std::optional<std::uint64_t> count_from(std::string_view word) { return parsed<std::uint64_t>(word); }

std::optional<float> float_from(std::string_view word)
{
    // Directly to float: via double it would be rounded twice.
    float value = 0;
    std::errc error = parse(word, value);
    if (error == std::errc::result_out_of_range) {
        double wide = 0;
        error = parse(word, wide);
        if (std::abs(wide) >= 1) return {};
        value = static_cast<float>(wide);
    }
    if (error != std::errc{} || !std::isfinite(value)) return {};
    return value;
}

bool is_number(std::string_view word)
{
    double value = 0;
    return parse(word, value) != std::errc::invalid_argument;
}

std::string printable(std::string_view text)
{
    constexpr std::size_t longest = 40;
    std::string result;
    for (const char c : text.substr(0, longest)) result += c >= ' ' && c <= '~' ? c : '?';
    return text.size() > longest ? result + "..." : result;
}

std::string in_quotes(std::string_view text) { return "'" + printable(text) + "'"; }

}  // namespace pliant
