#include "record/cache_file.hpp"

#include <bit>
#include <cstdint>
#include <cstdio>
#include <limits>

#include "files/atomic_file.hpp"
#include "files/numbered_name.hpp"

namespace pliant {
namespace {

/// All cloths of a simulation as one mesh.
SurfaceMesh whole_mesh(Simulation& simulation)
{
    SurfaceMesh mesh;
    for (std::size_t c = 0; c < simulation.scene().cloth_count(); ++c) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        const auto positions = simulation.positions(c);
        mesh.vertices.insert(mesh.vertices.end(), positions.begin(), positions.end());
        for (const Triangle& t : simulation.triangles(c))
            mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    return mesh;
}

/// "POINTCACHE2", version 1: a header of 32 bytes, then the positions of every sample; little-endian.
class PointCache final : public CacheFile {
public:
    explicit PointCache(const std::filesystem::path& file)
        : mesh_path_(std::filesystem::path(file).replace_extension(".obj")), file_(file)
    {
        const AtomicFile probe(mesh_path_);  // reports an error before the run instead of during it
        refuse_foreign_mesh();
    }

    void add(Simulation& simulation, std::uint64_t) override
    {
        if (samples_ == 0) {
            if (simulation.node_count() >
                static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max()))
                throw Error(ErrorKind::bad_input,
                            "a .pc2 cache holds at most 2147483647 points; use a sequence of .ply");
            points_ = static_cast<std::int32_t>(simulation.node_count());
            write_header();
            write_mesh(mesh_path_, whole_mesh(simulation));
        }
        for (std::size_t c = 0; c < simulation.scene().cloth_count(); ++c) {
            const auto positions = simulation.positions(c);
            file_.stream().write(reinterpret_cast<const char*>(positions.data()),
                                 static_cast<std::streamsize>(positions.size_bytes()));
        }
        ++samples_;
    }
    void finish() override
    {
        file_.stream().seekp(0);
        write_header();  // now with the number of samples
        file_.commit();
    }

private:
    /// Only a mesh that Pliant wrote may be replaced by the one beside the cache.
    void refuse_foreign_mesh() const
    {
        std::ifstream existing(mesh_path_);
        std::string line;
        if (!existing || (std::getline(existing, line) && line.starts_with("# Pliant"))) return;
        throw Error(ErrorKind::bad_input,
                    "the cache '" + file_.path().string() + "' would write its mesh to '" +
                        mesh_path_.string() +
                        "', which exists and is not Pliant's own; give the cache another name");
    }

    void write_header()
    {
        static_assert(std::endian::native == std::endian::little,
                      "the cache is written as it lies in memory");
        const auto write = [&](const auto& value) {
            file_.stream().write(reinterpret_cast<const char*>(&value), sizeof value);
        };
        constexpr std::int32_t version = 1;
        constexpr float start_frame = 0, samples_per_frame = 1;
        file_.stream().write("POINTCACHE2\0", 12);
        write(version);
        write(points_);
        write(start_frame);
        write(samples_per_frame);
        write(samples_);
    }

    std::filesystem::path mesh_path_;
    AtomicFile file_;
    std::int32_t points_ = 0, samples_ = 0;
};

class MeshSequence final : public CacheFile {
public:
    explicit MeshSequence(const std::string& pattern) : names_(pattern)
    {
        const AtomicFile probe(names_.at(0));
    }
    void add(Simulation& simulation, std::uint64_t frame) override
    {
        write_mesh(names_.at(frame), whole_mesh(simulation));
    }
    void finish() override {}

private:
    NumberedName names_;
};

}  // namespace

std::unique_ptr<CacheFile> make_cache_file(const std::string& name)
{
    const std::string ending = lower_case_ending(name);
    if (ending == ".pc2") return std::make_unique<PointCache>(name);
    if (ending == ".ply" || ending == ".obj") return std::make_unique<MeshSequence>(name);
    throw Error(
        ErrorKind::bad_usage,
        "the cache '" + name + "' has an unknown extension: use NAME.pc2, NAME_%04d.ply or NAME_%04d.obj");
}

}  // namespace pliant
