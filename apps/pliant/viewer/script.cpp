#include "viewer/script.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <nlohmann/json.hpp>

#include "pliant/error.hpp"

namespace pliant::tool {
namespace {

using Json = nlohmann::json;

/// Reads one event; errors name its place.
class EventReader {
public:
    EventReader(const std::string& file, std::size_t index, const Json& json, std::vector<TimedEvent>& events)
        : place_(file + ": events[" + std::to_string(index) + "]"), json_(json), events_(events)
    {
        if (!json.is_object()) refuse("is not an object");
        const double at = number("at");
        if (!(at >= 0 && at <= 1e6)) refuse(".at must be 0 to 1e6 s");
        frame_ = static_cast<std::uint64_t>(std::llround(at * script_frame_rate));
        for (const auto& [key, value] : json.items())
            if (key != "at") read(key, value);
    }

private:
    using Kind = Event::Kind;

    [[noreturn]] void refuse(const std::string& what) const
    {
        throw Error(ErrorKind::bad_input, place_ + what);
    }
    double number(const char* key) const
    {
        const auto found = json_.find(key);
        if (found == json_.end() || !found->is_number()) refuse(std::string(".") + key + " must be a number");
        return found->get<double>();
    }
    std::string text(const std::string& key, const Json& value) const
    {
        if (!value.is_string()) refuse("." + key + " must be a text");
        return value.get<std::string>();
    }
    std::pair<double, double> pair(const std::string& key, const Json& value) const
    {
        if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number())
            refuse("." + key + " must be two numbers");
        return {value[0].get<double>(), value[1].get<double>()};
    }
    int button(const std::string& key, const Json& value) const
    {
        const std::string name = text(key, value);
        if (name == "left") return GLFW_MOUSE_BUTTON_LEFT;
        if (name == "right") return GLFW_MOUSE_BUTTON_RIGHT;
        if (name == "middle") return GLFW_MOUSE_BUTTON_MIDDLE;
        refuse("." + key + " is '" + name + "', but must be left, right or middle");
    }
    int key_code(const std::string& key, const Json& value) const
    {
        const std::string name = text(key, value);
        static const std::pair<const char*, int> names[] = {
            {"space", GLFW_KEY_SPACE},         {"escape", GLFW_KEY_ESCAPE},
            {"period", GLFW_KEY_PERIOD},       {".", GLFW_KEY_PERIOD},
            {"shift", GLFW_KEY_LEFT_SHIFT},    {"F1", GLFW_KEY_F1},
            {"control", GLFW_KEY_LEFT_CONTROL}};
        for (const auto& [known, code] : names)
            if (name == known) return code;
        if (name.size() == 1 && ((name[0] >= 'A' && name[0] <= 'Z') || (name[0] >= '0' && name[0] <= '9')))
            return name[0];  // GLFW's codes for these keys are ASCII
        if (name.size() == 1 && name[0] >= 'a' && name[0] <= 'z') return name[0] - 'a' + 'A';
        refuse("." + key + " is '" + name +
               "', but must be a letter, a digit, space, period, escape, shift, "
               "control or F1");
    }
    void add(Event event) const { events_.push_back({frame_, std::move(event)}); }

    void read(const std::string& key, const Json& value) const
    {
        if (key == "key") {  // pressed, and released in the next frame
            const int code = key_code(key, value);
            add({.kind = Kind::key, .code = code, .down = true});
            events_.push_back({frame_ + 1, {.kind = Kind::key, .code = code, .down = false}});
        } else if (key == "key_down" || key == "key_up") {
            add({.kind = Kind::key, .code = key_code(key, value), .down = key == "key_down"});
        } else if (key == "press" || key == "release") {
            add({.kind = Kind::button, .code = button(key, value), .down = key == "press"});
        } else if (key == "move") {
            const auto [x, y] = pair(key, value);
            add({.kind = Kind::move, .x = x, .y = y});
        } else if (key == "move_to_node") {
            const auto [cloth, node] = pair(key, value);
            if (!(cloth >= 0 && node >= 0)) refuse(".move_to_node must be a cloth and a node, from 0 on");
            add({.kind = Kind::move_to,
                 .code = static_cast<int>(cloth),
                 .index = static_cast<std::uint32_t>(node)});
        } else if (key == "scroll") {
            add({.kind = Kind::scroll, .y = number("scroll")});
        } else if (key == "resize") {
            const auto [x, y] = pair(key, value);
            if (!(x >= 0 && y >= 0 && x <= 16384 && y <= 16384)) refuse(".resize must be 0 to 16384 pixels");
            add({.kind = Kind::resize, .x = x, .y = y});
        } else if (key == "lose_surface") {
            add({.kind = Kind::lose_surface});
        } else {
            const std::pair<const char*, Kind> texts[] = {{"drop", Kind::drop},
                                                          {"set", Kind::set},
                                                          {"scene", Kind::scene},
                                                          {"method", Kind::method},
                                                          {"screenshot", Kind::screenshot}};
            for (const auto& [name, kind] : texts)
                if (key == name) return add({.kind = kind, .text = text(key, value)});
            refuse(
                " has '" + key +
                "', which is none of at, key, key_down, key_up, press, release, move, move_to_node, scroll, "
                "resize, lose_surface, drop, set, scene, method, screenshot");
        }
    }

    std::string place_;
    const Json& json_;
    std::vector<TimedEvent>& events_;
    std::uint64_t frame_ = 0;
};

}  // namespace

std::vector<TimedEvent> read_script(const std::string& file)
{
    std::ifstream in(file);
    if (!in) throw Error(ErrorKind::bad_input, "the script '" + file + "' cannot be read");
    Json json;
    try {
        json = Json::parse(in, nullptr, true, true);  // with comments, as in scenes
    } catch (const Json::parse_error& error) {
        throw Error(ErrorKind::bad_input, file + " is not JSON: " + error.what());
    }
    if (!json.is_object() || json.size() != 1 || !json.contains("events") || !json["events"].is_array())
        throw Error(ErrorKind::bad_input,
                    file + " must be an object with the list 'events' and nothing else");
    std::vector<TimedEvent> events;
    std::size_t index = 0;
    for (const Json& event : json["events"]) EventReader(file, index++, event, events);
    std::stable_sort(events.begin(), events.end(),
                     [](const TimedEvent& a, const TimedEvent& b) { return a.frame < b.frame; });
    return events;
}

}  // namespace pliant::tool
