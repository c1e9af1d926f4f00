// What the tests of meshes share: a folder for their files, and meshes.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <utility>

#include "pliant/error.hpp"
#include "pliant/mesh.hpp"

namespace pliant::test {

inline std::string failure_of(const std::function<void()>& action)
{
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind, ErrorKind::bad_input);
        return error.what();
    }
    return "no failure";
}

/// A folder of its own for each test, removed afterwards.
class MeshTest : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::path(testing::TempDir()) /
                 ("pliant_mesh_test_" + std::to_string(std::random_device{}()));
        std::filesystem::create_directory(folder);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::filesystem::path file_with(const std::string& name, const std::string& contents) const
    {
        std::ofstream(folder / name, std::ios::binary) << contents;
        return folder / name;
    }
    SurfaceMesh mesh_from(const std::string& name, const std::string& contents) const
    {
        return read_mesh(file_with(name, contents));
    }
    /// The message without the name of the file.
    std::string read_failure(const std::string& name, const std::string& contents) const
    {
        const std::filesystem::path file = file_with(name, contents);
        std::string message = failure_of([&] { read_mesh(file); });
        if (const auto at = message.find(file.string()); at != std::string::npos)
            message.replace(at, file.string().size(), name);
        return message;
    }
    std::size_t file_count() const
    {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder),
                                                      std::filesystem::directory_iterator()));
    }

    std::filesystem::path folder;
};

inline SurfaceMesh tetrahedron()
{
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// Each triangle with three vertices of its own, as STL has them, moved by up to `jitter` (m).
inline SurfaceMesh soup_of(const SurfaceMesh& mesh, float jitter = 0)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> offset(-jitter, jitter);
    SurfaceMesh soup;
    for (const Triangle& t : mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(soup.vertices.size());
        for (const std::uint32_t vertex : t) {
            const Vec3 v = mesh.vertices[vertex];
            soup.vertices.push_back({v.x + offset(random), v.y + offset(random), v.z + offset(random)});
        }
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    return soup;
}

/// Inside out.
inline void turn_round(SurfaceMesh& mesh)
{
    for (Triangle& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
}

}  // namespace pliant::test
