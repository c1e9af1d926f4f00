# Writes builtin_scenes.cpp: the texts of scene files as C++ literals.
#   cmake -DOUTPUT=builtin_scenes.cpp "-DINPUTS=a.json;b.json" -P embed_scenes.cmake
# A scene is named after its file. Schemas (*.schema.json) among the inputs are skipped.
cmake_minimum_required(VERSION 3.25)

list(FILTER INPUTS EXCLUDE REGEX "\\.schema\\.json$")
list(SORT INPUTS)

set(entries "")
foreach(input IN LISTS INPUTS)
    get_filename_component(name "${input}" NAME_WE)
    file(READ "${input}" text)
    string(APPEND entries "    {\"${name}\", R\"scene(${text})scene\", \"scenes/${name}.json\"},\n")
endforeach()

file(WRITE "${OUTPUT}" "// Generated from scenes/*.json by cmake/embed_scenes.cmake.
#include \"scene_file/builtin_scenes.hpp\"

namespace pliant {
namespace {

constexpr BuiltinScene scenes[] = {
${entries}};

}  // namespace

std::span<const BuiltinScene> builtin_scenes() { return scenes; }

}  // namespace pliant
")
