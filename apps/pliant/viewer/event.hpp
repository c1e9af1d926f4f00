// Events of a viewer, from a window or a script.
#pragma once

#include <cstdint>
#include <string>

namespace pliant::tool {

struct Event {
    enum class Kind {
        key,           ///< GLFW's `code`, `down`
        button,        ///< of the mouse: 0 left, 1 right, 2 middle; `down`
        move,          ///< of the mouse, to x, y in pixels
        move_to,       ///< of the mouse, to the position of node `index` of cloth `code` on screen
        scroll,        ///< `y`: notches
        text,          ///< `code`: a character
        drop,          ///< `text`: the file
        resize,        ///< to x, y pixels; 0, 0: minimised
        close,         ///< end
        lose_surface,  ///< the window's surface is lost, as after a restart of the compositor
        set,           ///< `text`: path=value of the scene
        scene,         ///< `text`: name or file of a scene
        method,        ///< `text`: name of a method
        screenshot,    ///< `text`: the file
    };
    Kind kind = Kind::close;
    int code = 0;
    bool down = false;
    double x = 0, y = 0;
    std::uint32_t index = 0;
    std::string text = {};
};

}  // namespace pliant::tool
