#include "scene_file/document.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <optional>
#include <set>
#include <variant>

#include "scene/field.hpp"

namespace pliant::scene_format {
namespace {

/// A callback of the parser that tracks the current path, and rejects duplicate keys (the parser would keep
/// the last) and excessive nesting.
class KeyWatch {
public:
    explicit KeyWatch(const std::string& source) : source_(source) {}

    bool operator()(int, Json::parse_event_t event, const Json& parsed)
    {
        using Event = Json::parse_event_t;
        switch (event) {
            case Event::object_start: enter(false); break;
            case Event::array_start: enter(true); break;
            case Event::object_end:
            case Event::array_end: levels_.pop_back(), next_element(); break;
            case Event::value: next_element(); break;
            case Event::key: key(parsed.get<std::string>()); break;
        }
        return true;
    }

    std::string path() const
    {
        std::string path;
        for (const Level& level : levels_)
            path = level.is_array ? element_path(path, level.index) : member_path(path, level.key);
        return path;
    }

private:
    struct Level {
        bool is_array = false;
        std::size_t index = 0;
        std::string key;
        std::set<std::string> keys;
    };

    void enter(bool is_array)
    {
        constexpr std::size_t deepest = 32;  // no scene has more than 10 levels
        if (levels_.size() == deepest)
            throw Error(ErrorKind::bad_input,
                        source_ + ": " + path() + " is nested more than 32 levels deep");
        levels_.emplace_back().is_array = is_array;
    }

    void next_element()
    {
        if (!levels_.empty() && levels_.back().is_array) ++levels_.back().index;
    }

    void key(const std::string& name)
    {
        levels_.back().key = name;
        if (!levels_.back().keys.insert(name).second)
            throw Error(ErrorKind::bad_input, source_ + ": " + path() + " is given twice in the same object");
    }

    const std::string& source_;
    std::vector<Level> levels_;
};

/// "line 3, column 5: ..." from a position and the parser's message.
std::string syntax_problem(const std::string& text, const Json::parse_error& error)
{
    const std::string before = text.substr(0, error.byte - std::min<std::size_t>(error.byte, 1));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const auto line_start = before.rfind('\n');
    const auto column = before.size() - (line_start == std::string::npos ? 0 : line_start + 1) + 1;

    // "[json.exception.parse_error.101] parse error at line L, column C: WORDS; last read: 'TOKEN'; expected
    // E"
    std::string words = error.what();
    const auto start = words.find(": ");
    if (start != std::string::npos) words.erase(0, start + 2);
    const auto token = words.find("; last read: '");
    if (token != std::string::npos) {
        const auto token_end = words.find("'; ", token + 14);
        words.erase(token, token_end == std::string::npos ? std::string::npos : token_end + 1 - token);
    }
    return "line " + std::to_string(line) + ", column " + std::to_string(column) + ": " + printable(words);
}

}  // namespace

Json parse_document(const std::string& text, const std::string& source)
{
    constexpr bool with_exceptions = true, with_comments = true;
    KeyWatch watch(source);
    try {
        return Json::parse(text, std::ref(watch), with_exceptions, with_comments);
    } catch (const Json::parse_error& error) {
        throw Error(ErrorKind::bad_input, source + ": " + syntax_problem(text, error));
    } catch (const Json::out_of_range&) {  // for example 1e999
        throw Error(ErrorKind::bad_input, source + ": " + watch.path() + " is a number beyond 1.8e308");
    }
}

std::string wrong_type(const Json& value, const std::string& expected)
{
    std::string got;
    if (value.is_string())
        got = in_quotes(value.get_ref<const std::string&>());
    else if (value.is_number())
        got = number_text(value.get<double>());
    else if (value.is_boolean())
        got = value.get<bool>() ? "true" : "false";
    else if (value.is_array())
        got = "an array of " + std::to_string(value.size());
    else
        got = value.is_null() ? "null" : "an object";
    return "is " + got + ", but must be " + expected;
}

namespace {

/// A step along the path of an override: a key of an object or an index into an array.
using Step = std::variant<std::string, std::size_t>;

/// "cloths[0].sheet.rows" -> cloths, 0, sheet, rows; empty if it is malformed.
std::optional<std::vector<Step>> steps_of(std::string_view path)
{
    std::vector<Step> steps;
    while (true) {
        const std::string_view key = path.substr(0, path.find_first_of(".[]"));
        if (key.empty()) return {};
        steps.emplace_back(std::string(key));
        path.remove_prefix(key.size());
        while (path.starts_with('[')) {
            std::size_t index = 0;
            const auto [end, error] = std::from_chars(path.data() + 1, path.data() + path.size(), index);
            if (error != std::errc{} || end == path.data() + path.size() || *end != ']') return {};
            steps.emplace_back(index);
            path.remove_prefix(static_cast<std::size_t>(end + 1 - path.data()));
        }
        if (path.empty()) return steps;
        if (!path.starts_with('.')) return {};
        path.remove_prefix(1);
    }
}

bool is_utf8(const std::string& text)
{
    try {
        return !Json(text).dump().empty();
    } catch (const Json::type_error&) {
        return false;
    }
}

[[noreturn]] void refuse_override(const std::string& text, const std::string& problem)
{
    throw Error(ErrorKind::bad_usage, "the override " + in_quotes(text) + " " + problem);
}

/// The part of `place` that a step names; null if it is new. An index one past the end appends.
Json& descend(Json& place, const Step& step, const std::string& place_path, const std::string& text)
{
    const std::string path = place_path.empty() ? "the scene" : place_path;
    if (const auto* key = std::get_if<std::string>(&step)) {
        if (place.is_null()) place = Json::object();
        if (!place.is_object())
            refuse_override(text, "leads into " + path + ", which " + wrong_type(place, "an object"));
        return place[*key];
    }
    const std::size_t index = std::get<std::size_t>(step);
    if (place.is_null()) place = Json::array();
    if (!place.is_array())
        refuse_override(text, "leads into " + path + ", which " + wrong_type(place, "an array"));
    if (index > place.size())
        refuse_override(text, "leads to element " + std::to_string(index) + " of " + path + ", which has " +
                                  std::to_string(place.size()));
    if (index == place.size()) place.push_back(nullptr);
    return place[index];
}

}  // namespace

std::string apply_override(Json& document, const std::string& text)
{
    const auto equals = text.find('=');
    const std::string path = text.substr(0, equals);
    const auto steps = steps_of(path);
    if (equals == std::string::npos || !steps || !is_utf8(text))
        refuse_override(text,
                        "is not of the form path=value, as in time.duration=2 or cloths[0].sheet.rows=64");

    Json value = Json::parse(text.substr(equals + 1), nullptr, false);
    if (value.is_discarded()) value = text.substr(equals + 1);

    Json* place = &document;
    Json* parent = nullptr;
    std::string reached, changed;
    for (const Step& step : *steps) {
        parent = place;
        place = &descend(*place, step, reached, text);
        const auto* key = std::get_if<std::string>(&step);
        reached = key ? member_path(reached, *key) : element_path(reached, std::get<std::size_t>(step));
        if (changed.empty() && place->is_null()) changed = reached;
    }
    const auto* last_key = std::get_if<std::string>(&steps->back());
    if (value.is_null() && last_key)
        parent->erase(*last_key);
    else
        *place = std::move(value);
    return changed.empty() ? reached : changed;
}

}  // namespace pliant::scene_format
