#include "test_paths.hpp"

// In a file of its own, so that no other compilation knows where the project lies.
const char* const pliant::test::project_folder = PLIANT_SOURCE_DIR;
