#pragma once

#include <string>

namespace pliant::tool {

/// The processor as the system names it; empty where it does not.
std::string processor_name();

}  // namespace pliant::tool
