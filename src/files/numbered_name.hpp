// File names that contain the number of a frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "pliant/api.hpp"

namespace pliant {

/// A name with one number, such as "seq_%04d.ply", filled in per frame.
class PLIANT_INSIDE NumberedName {
public:
    /// Whether there is exactly one %d or %0Nd, with N from 1 to 9.
    static bool is_valid(const std::string& pattern);
    /// Throws Error(bad_usage) unless there is exactly one %d or %0Nd.
    explicit NumberedName(const std::string& pattern);
    std::filesystem::path at(std::uint64_t number) const;

private:
    std::string before_, after_;
    std::size_t digits_ = 0;  // minimum number of digits, padded with zeros
};

/// The extension in lower case, with its dot: ".png" of "A.PNG".
PLIANT_INSIDE std::string lower_case_ending(const std::filesystem::path& file);

}  // namespace pliant
