// The basis of equal bits in the shaders: no floating-point instruction may be contracted.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <vector>

#include "backend/vulkan/shader_code.hpp"
#include "solve/pass.hpp"
#include "test_paths.hpp"

namespace pliant {
namespace {

constexpr std::uint32_t op_decorate = 71, no_contraction = 42;
// OpFNegate is exact; the others round: FAdd, FSub, FMul, FDiv, VectorTimesScalar, Dot and matrix products.
const std::set<std::uint32_t> rounding_operations = {129, 131, 133, 136, 142, 143, 144, 145, 146, 147, 148};
const std::set<std::uint32_t> forbidden_operations = {
    136, 148};  // division and OpDot are not correctly rounded in Vulkan
constexpr std::uint32_t op_extended_instruction = 12;
const std::set<std::uint32_t> integer_extremes = {38, 39, 41, 42};  // UMin, SMin, UMax, SMax

template <class Function>
void for_each_instruction(std::span<const std::uint32_t> code, Function&& f)
{
    for (std::size_t at = 5; at < code.size(); at += code[at] >> 16)
        f(code[at] & 0xffff, code.subspan(at, code[at] >> 16));
}

struct Shader {
    std::string name;
    std::span<const std::uint32_t> code;
    bool of_solver = false;
};

std::vector<Shader> all_shaders()
{
    std::vector<Shader> shaders{{"sheet_steps", vulkan::sheet_steps_shader()}};
    for (std::uint32_t p = 0; p < all_passes().size(); ++p) {
        const auto pass = static_cast<Pass>(p);
        shaders.push_back({all_passes()[p].name, vulkan::compute_shader(pass), is_solver_pass(pass)});
    }
    return shaders;
}

TEST(ComputeShaders, HaveNoInstructionThatMayBeContracted)
{
    for (const Shader& shader : all_shaders()) {
        // Laws are exact by their own text; the solver's code around them is made exact here.
        const auto code = shader.of_solver ? vulkan::with_exact_arithmetic(shader.code)
                                           : std::vector(shader.code.begin(), shader.code.end());
        std::set<std::uint32_t> exact;
        for_each_instruction(code, [&](std::uint32_t op, auto words) {
            if (op == op_decorate && words[2] == no_contraction) exact.insert(words[1]);
        });
        int operations = 0;
        for_each_instruction(code, [&](std::uint32_t op, auto words) {
            if (rounding_operations.count(op) == 0) return;
            ++operations;
            EXPECT_TRUE(exact.count(words[2]) > 0)
                << shader.name << ": operation " << op << " may be contracted";
            EXPECT_TRUE(forbidden_operations.count(op) == 0) << shader.name << ": operation " << op;
        });
        if (!shader.of_solver) {
            EXPECT_GT(operations, 0) << shader.name;
        }
    }
}

TEST(ComputeShaders, UseNoBuiltInWhoseRoundingIsOpen)
{
    for (const Shader& shader : all_shaders())
        for_each_instruction(shader.code, [&](std::uint32_t op, auto words) {
            EXPECT_TRUE(op != op_extended_instruction || integer_extremes.count(words[4]) > 0)
                << shader.name << ": extended instruction " << (words.size() > 4 ? words[4] : 0);
        });
}

TEST(ComputeShaders, OfFastMathUseTheDevicesInverseSquareRootAndMayBeContracted)
{
    constexpr std::uint32_t inverse_sqrt = 32;
    int modules = 0, roots = 0;
    const auto look_at = [&](std::span<const std::uint32_t> code) {
        modules += code.empty() ? 0 : 1;
        for_each_instruction(code, [&](std::uint32_t op, auto words) {
            EXPECT_FALSE(op == op_decorate && words[2] == no_contraction);
            roots += op == op_extended_instruction && words[4] == inverse_sqrt ? 1 : 0;
        });
    };
    look_at(vulkan::fast_sheet_steps_shader());
    for (std::uint32_t p = 0; p < all_passes().size(); ++p) {
        const auto pass = static_cast<Pass>(p);
        look_at(vulkan::fast_compute_shader(pass));
        EXPECT_TRUE(!is_solver_pass(pass) || vulkan::fast_compute_shader(pass).empty());
    }
    EXPECT_EQ(modules, 10);
    EXPECT_GE(roots, modules - 1);  // volume_cubic has none
}

TEST(Laws, AreGlslInDoubleToo)
{
    const std::string root = test::project_folder;
    EXPECT_EQ(std::system(("glslc --target-env=vulkan1.1 -Werror -DREAL64 -I " + root +
                           "/src/laws -o /dev/null " + root + "/tests/laws_real64.comp")
                              .c_str()),
              0);
}

TEST(ComputeShaders, AreStillValidAsTheyAreRun)
{
    const auto folder = std::filesystem::temp_directory_path() / "pliant_shader_test";
    std::filesystem::create_directories(folder);
    for (const Shader& shader : all_shaders()) {
        const auto exact = vulkan::with_exact_arithmetic(shader.code);
        const auto code = vulkan::with_float_controls(exact, {true, true});
        // Two capabilities of two words and two modes of four, and the extension's name.
        EXPECT_EQ(code.size(), exact.size() + 12 + 7);
        const std::string file = (folder / (shader.name + ".spv")).string();
        std::ofstream(file, std::ios::binary)
            .write(reinterpret_cast<const char*>(code.data()), static_cast<std::streamsize>(code.size() * 4));
        EXPECT_EQ(std::system(("spirv-val --target-env vulkan1.1 " + file).c_str()), 0) << shader.name;
    }
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace pliant
