// Four numbers as shaders read them.
#pragma once

namespace pliant::vulkan {

struct Float4 {
    float x = 0, y = 0, z = 0, w = 0;
};

}  // namespace pliant::vulkan
