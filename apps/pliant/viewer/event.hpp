// What happens to a viewer, whether a window or a script says so.
#pragma once

#include <cstdint>
#include <string>

namespace pliant::tool {

struct Event {
    enum class Kind {
        key,           ///< `code` of GLFW, `down`
        button,        ///< of the mouse: 0 left, 1 right, 2 middle; `down`
        move,          ///< of the mouse, to x, y in pixels
        move_to,       ///< of the mouse, to where node `index` of cloth `code` is seen
        scroll,        ///< `y` notches
        text,          ///< `code`: a character typed
        drop,          ///< `text`: a file
        resize,        ///< to x, y pixels; 0, 0 is minimised
        close,         ///< end
        lose_surface,  ///< as when a compositor restarts: what can be seen of a window is gone
        set,           ///< `text`: path=value of the scene
        scene,         ///< `text`: a scene's name or file
        method,        ///< `text`: a method's name
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
