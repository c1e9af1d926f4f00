// A scene file as a JSON document, before anything is known about its fields.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace pliant::scene_format {

using Json = nlohmann::json;

/// JSON with comments. Throws Error(bad_input), starting with `source`, for syntax errors (with line and
/// column), keys given twice and numbers beyond all bounds.
Json parse_document(const std::string& text, const std::string& source);

/// Puts an override "path=value" into the document, making objects on the way; the value null takes the key
/// away. Returns the path below which it changed or made something. Throws Error(bad_usage) when it is
/// malformed or leads through something that has no such part.
std::string apply_override(Json& document, const std::string& text);

/// `is "high", but must be EXPECTED`
std::string wrong_type(const Json& value, const std::string& expected);

}  // namespace pliant::scene_format
