// Positions of every frame for other programs: point caches and sequences of meshes.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "pliant/simulation.hpp"

namespace pliant {

/// A name with one number in it, "seq_%04d.ply", filled in per frame.
class NumberedName {
public:
    /// Throws Error(bad_usage) unless there is exactly one %d or %0Nd.
    explicit NumberedName(const std::string& pattern);
    std::filesystem::path at(std::uint64_t number) const;

private:
    std::string before_, after_;
    int digits_ = 0;
};

/// Writes by the ending of the name:
///   x.pc2          point cache 2, which Blender's Mesh Cache modifier reads, and x.obj, the first frame's mesh, beside it
///   seq_%04d.ply   one mesh a frame
///   seq_%04d.obj   one mesh a frame
/// The state before the first step is frame 0. Several cloths are written as one mesh, one after the other.
class CacheFile {
public:
    virtual ~CacheFile() = default;
    virtual void add(Simulation& simulation, std::uint64_t frame) = 0;
    virtual void finish() = 0;
};

/// Throws Error(bad_usage) for another ending, naming the three forms.
std::unique_ptr<CacheFile> make_cache_file(const std::string& name);

}  // namespace pliant
