// Four numbers as shaders read them.
#pragma once

#include <cstddef>

namespace pliant::vulkan {

struct Float4 {
    float x = 0, y = 0, z = 0, w = 0;
    float& operator[](std::size_t k) { return k == 0 ? x : k == 1 ? y : k == 2 ? z : w; }
};

}  // namespace pliant::vulkan
