// Where tests find the files of the project.
#pragma once

namespace pliant::test {

extern const char* const project_folder;
extern const char* const limits_layer_path;  ///< folders where the Vulkan loader finds layers, with ours
extern const char* const bad_meshes_folder;  ///< written by bad_meshes.py

}  // namespace pliant::test
