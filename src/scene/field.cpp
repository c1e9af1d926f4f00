#include "scene/field.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <vector>

namespace pliant::scene_format {

std::string member_path(const std::string& path, std::string_view key)
{
    const std::string name = printable(key);
    return path.empty() ? name : path + "." + name;
}

std::string element_path(const std::string& path, std::size_t index)
{
    return path + "[" + std::to_string(index) + "]";
}

std::string expected_number(const Range& range, const char* unit, NumberKind kind)
{
    const std::string noun = kind == NumberKind::whole ? "a whole number " : "a number ";
    const std::string min = number_text(range.min), max = with_unit(number_text(range.max), unit);
    return noun +
           (range.min_excluded ? "above " + min + " and at most " + max : "between " + min + " and " + max);
}

void require_number(const std::string& path, double value, const Range& range, const char* unit,
                    NumberKind kind)
{
    const bool above_min = range.min_excluded ? value > range.min : value >= range.min;
    if (above_min && value <= range.max) return;
    throw FieldError(path, "is " + with_unit(number_text(value), unit) + ", but must be " +
                               expected_number(range, unit, kind));
}

std::string number_text(double value)
{
    const bool plain = std::abs(value) < 1e6 && value == std::floor(value);
    char buffer[64];
    const auto end = plain ? std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed)
                           : std::to_chars(buffer, buffer + sizeof buffer, value);
    std::string text(buffer, end.ptr);
    const auto exponent = text.find('e');
    if (exponent == std::string::npos) return text;
    if (text[exponent + 1] == '+') text.erase(exponent + 1, 1);
    const auto digits = text.find_first_of("0123456789", exponent);
    if (digits != std::string::npos && text[digits] == '0') text.erase(digits, 1);  // writes e09 as e9
    return text;
}

std::string with_unit(const std::string& value, const char* unit)
{
    return *unit == '\0' ? value : value + " " + unit;
}

std::string in_quotes(std::string_view text) { return "\"" + printable(text) + "\""; }

std::string printable(std::string_view text)
{
    constexpr std::size_t longest = 120;
    std::string line;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool continues = (byte & 0xC0U) == 0x80U;  // inside a UTF-8 character, which must not be cut
        if (line.size() >= longest && !continues) return line + "...";
        line += byte < 0x20U || byte == 0x7FU ? '?' : c;
    }
    return line;
}

std::string joined(Names names)
{
    std::string list;
    for (const char* name : names) list += (list.empty() ? "" : ", ") + std::string(name);
    return list;
}

namespace {

/// The number of insertions, deletions, replacements and swaps of neighbours that turn one word into the
/// other (optimal string alignment, row by row).
std::size_t edit_distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
        before_last = last;
        last = row;
    }
    return last.back();
}

}  // namespace

const char* nearest(std::string_view word, Names names)
{
    constexpr std::size_t longest = 64;  // longer than any name; the distance takes quadratic time
    if (word.size() > longest) return nullptr;
    const char* best = nullptr;
    std::size_t best_distance = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (const char* name : names) {
        const std::size_t distance = edit_distance(word, name);
        if (distance >= best_distance) continue;
        best = name;
        best_distance = distance;
    }
    return best;
}

std::string suggestion(std::string_view word, Names names)
{
    const char* name = nearest(word, names);
    return name ? "; did you mean " + in_quotes(name) + "?" : "";
}

std::string unknown_name(std::string_view word, Names names)
{
    const std::string meant = suggestion(word, names);
    return "is unknown" + (meant.empty() ? "; allowed here: " + joined(names) : meant);
}

std::string expected_choice(std::string_view word, Names names)
{
    return "but must be " + std::string(names.size() > 1 ? "one of " : "") + joined(names) +
           suggestion(word, names);
}

}  // namespace pliant::scene_format
