#include "test_paths.hpp"

// In a file of its own, so that no other compilation knows where the project and its build lie.
const char* const pliant::test::project_folder = PLIANT_SOURCE_DIR;
const char* const pliant::test::limits_layer_path = PLIANT_LIMITS_LAYER_PATH;
const char* const pliant::test::bad_meshes_folder = PLIANT_BAD_MESHES;
