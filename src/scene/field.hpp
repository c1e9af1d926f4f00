// The range of a scene's field, and the form of its errors: "PATH is VALUE UNIT, but must be ...".
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "pliant/api.hpp"
#include "pliant/error.hpp"

namespace pliant::scene_format {

using Names = std::span<const char* const>;

/// An error in one field. The message starts with the path, as in `cloths[0].sheet.rows is 1 nodes, but ...`.
class PLIANT_INSIDE FieldError : public Error {
public:
    FieldError(std::string field_path, const std::string& problem)
        : Error(ErrorKind::bad_input, (field_path.empty() ? "the scene" : field_path) + " " + problem),
          path(std::move(field_path))
    {
    }
    std::string path;
};

PLIANT_INSIDE std::string member_path(const std::string& path, std::string_view key);
PLIANT_INSIDE std::string element_path(const std::string& path, std::size_t index);

/// The valid numbers of a field.
struct Range {
    double min, max;
    bool min_excluded = false;
};
constexpr Range above(double min, double max) { return {min, max, true}; }

enum class NumberKind { real, whole };

/// "a number between 0 and 1e9 N/m"
PLIANT_INSIDE std::string expected_number(const Range& range, const char* unit, NumberKind kind);
/// Throws FieldError if the value is not in the range; NaN is in none.
PLIANT_INSIDE void require_number(const std::string& path, double value, const Range& range, const char* unit,
                                  NumberKind kind);

/// The shortest text that reads back as the same number: 0.3, 100000, 1e6.
PLIANT_INSIDE std::string number_text(double value);
/// "5 N/m", and "5" without a unit.
PLIANT_INSIDE std::string with_unit(const std::string& value, const char* unit);
/// In double quotes, on one line, and shortened for a message.
PLIANT_INSIDE std::string in_quotes(std::string_view text);
/// Like `in_quotes`, without the quotes.
PLIANT_INSIDE std::string printable(std::string_view text);
/// "a, b, c"
PLIANT_INSIDE std::string joined(Names names);

/// The name most similar to `word`, or null if none is similar enough.
const char* nearest(std::string_view word, Names names);
/// `; did you mean "stiffness"?`, or empty.
PLIANT_INSIDE std::string suggestion(std::string_view word, Names names);
/// `is unknown` with a suggestion, or with the list of valid names.
PLIANT_INSIDE std::string unknown_name(std::string_view word, Names names);
/// `but must be one of a, b, c` with a suggestion.
PLIANT_INSIDE std::string expected_choice(std::string_view word, Names names);

}  // namespace pliant::scene_format
