#include "files/numbered_name.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "pliant/error.hpp"

namespace pliant {

namespace {

/// Position and length of the "%d" or "%04d" in a pattern; empty unless there is exactly one.
std::optional<std::pair<std::size_t, std::size_t>> placeholder_in(const std::string& pattern)
{
    const std::size_t begin = pattern.find('%');
    if (begin == std::string::npos || pattern.find('%', begin + 1) != std::string::npos) return {};
    std::size_t end = begin + 1;
    const auto at = [&](std::size_t k) { return k < pattern.size() ? pattern[k] : '\0'; };
    if (at(end) == '0' && at(end + 1) >= '1' && at(end + 1) <= '9') end += 2;
    if (at(end) != 'd') return {};
    return std::pair{begin, end + 1};
}

}  // namespace

bool NumberedName::is_valid(const std::string& pattern) { return placeholder_in(pattern).has_value(); }

NumberedName::NumberedName(const std::string& pattern)
{
    const auto placeholder = placeholder_in(pattern);
    if (!placeholder)
        throw Error(ErrorKind::bad_usage,
                    "the name '" + pattern +
                        "' must hold the frame's number exactly once, as %d or %04d, for example "
                        "seq_%04d.ply");
    const auto [begin, end] = *placeholder;
    if (end - begin > 2) digits_ = static_cast<std::size_t>(pattern[begin + 2] - '0');
    before_ = pattern.substr(0, begin);
    after_ = pattern.substr(end);
}

std::filesystem::path NumberedName::at(std::uint64_t number) const
{
    std::string digits = std::to_string(number);
    if (digits.size() < digits_) digits.insert(0, digits_ - digits.size(), '0');
    return before_ + digits + after_;
}

std::string lower_case_ending(const std::filesystem::path& file)
{
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return ending;
}

}  // namespace pliant
