// The one exception type of Pliant.
#pragma once

#include <stdexcept>
#include <string>

#include "pliant/api.hpp"

namespace pliant {

/// The kind of an error; its value is the exit code of the command line tool.
enum class ErrorKind {
    bad_input = 1,       ///< a scene, mesh or parameter that cannot be used
    bad_usage = 2,       ///< a call or command line that makes no sense
    diverged = 3,        ///< the simulation produced a non-finite node
    device_failure = 4,  ///< no usable device, or the device was lost
};

/// Thrown while loading, validating and creating devices; never by `Simulation::advance`.
/// The message is one sentence: what is wrong, where, which value, and what to do.
class PLIANT_API Error : public std::runtime_error {
public:
    Error(ErrorKind error_kind, const std::string& message) : std::runtime_error(message), kind(error_kind) {}
    ErrorKind kind;
};

}  // namespace pliant
