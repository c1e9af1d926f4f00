// The list of built-in scenes, for `pliant list`.
#include "pliant/scene.hpp"
#include "scene_file/builtin_scenes.hpp"
#include "scene_file/document.hpp"

namespace pliant {

std::vector<SceneListing> list_scenes()
{
    std::vector<SceneListing> listings;
    for (const BuiltinScene& scene : builtin_scenes()) {
        const auto document = scene_format::parse_document(scene.text, scene.file);
        listings.push_back({scene.name, document.value("description", ""), scene.file});
    }
    return listings;
}

}  // namespace pliant
