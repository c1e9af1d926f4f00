// A scene file as a JSON document, before its fields are interpreted.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace pliant::scene_format {

using Json = nlohmann::json;

/// Parses JSON with comments. Throws Error(bad_input), starting with `source`, for syntax errors (with line
/// and column), duplicate keys and numbers out of range.
Json parse_document(const std::string& text, const std::string& source);

/// Applies an override "path=value" to the document, creating objects as needed; the value null removes the
/// key. Returns the path below which it changed or created something. Throws Error(bad_usage) if it is
/// malformed or its path does not fit the document.
std::string apply_override(Json& document, const std::string& text);

/// `is "high", but must be EXPECTED`
std::string wrong_type(const Json& value, const std::string& expected);

}  // namespace pliant::scene_format
