#pragma once

#include <string>

namespace pliant::tool {

/// The processor's name in the operating system; empty if unknown.
std::string processor_name();

}  // namespace pliant::tool
