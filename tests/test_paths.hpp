// Where tests find the files of the project.
#pragma once

namespace pliant::test {

extern const char* const project_folder;

}  // namespace pliant::test
