// What tests of scenes share: files for the length of a test, and sentences that name what they must.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "pliant/scene.hpp"
#include "test_paths.hpp"

namespace pliant::test {

inline const std::filesystem::path root = project_folder;

/// A file for the length of a test.
class TemporaryFile {
public:
    explicit TemporaryFile(const std::string& text, const std::string& ending = ".json")
    {
        static int count = 0;
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        const std::string name =
            std::string("pliant_") + test->name() + "_" + std::to_string(count++) + ending;
        path = std::filesystem::temp_directory_path() / name;
        std::ofstream(path, std::ios::binary) << text;
    }
    ~TemporaryFile() { std::filesystem::remove(path); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    std::filesystem::path path;
};

inline Scene scene_of(const std::string& text) { return read_scene(TemporaryFile(text).path.string()); }

inline void expect_sentence(const std::string& message, const std::vector<std::string>& parts)
{
    for (const std::string& part : parts)
        EXPECT_NE(message.find(part), std::string::npos) << part << "\nin: " << message;
    for (const char c : message)
        EXPECT_GE(static_cast<unsigned char>(c), 0x20) << "control character in: " << message;
}

inline Scene small_scene()
{
    Scene scene;
    scene.add(Cloth::sheet({.rows = 5, .columns = 4}));
    return scene;
}

}  // namespace pliant::test
