// Files with the positions of every frame for other programs: point caches and sequences of meshes.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "pliant/simulation.hpp"

namespace pliant {

/// Writes by the file's extension:
/// - x.pc2: point cache 2, which Blender's Mesh Cache modifier reads, and beside it x.obj, the first mesh
/// - seq_%04d.ply and seq_%04d.obj: one mesh per frame
///
/// The state before the first step is frame 0. Several cloths are written as one mesh, one after the other.
class CacheFile {
public:
    virtual ~CacheFile() = default;
    virtual void add(Simulation& simulation, std::uint64_t frame) = 0;
    virtual void finish() = 0;
};

/// Throws Error(bad_usage) for another extension; the message names the three forms.
std::unique_ptr<CacheFile> make_cache_file(const std::string& name);

}  // namespace pliant
