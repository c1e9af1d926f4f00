// Reads a scene: finds its text, parses it, applies overrides, fills the fields, validates the result.
#include <algorithm>
#include <fstream>

#include "scene_file/builtin_scenes.hpp"
#include "scene_file/document.hpp"
#include "scene_file/object_reader.hpp"

namespace pliant {
namespace scene_format {
namespace {

struct SceneText {
    std::string text;
    std::string source;            // its name in messages
    std::string name;              // of the scene, unless the file says otherwise
    std::filesystem::path folder;  // base of its relative file names
};

const BuiltinScene* find_builtin(const std::string& name)
{
    const auto scenes = builtin_scenes();
    const auto found =
        std::find_if(scenes.begin(), scenes.end(), [&](const auto& scene) { return name == scene.name; });
    return found == scenes.end() ? nullptr : &*found;
}

[[noreturn]] void refuse_name(const std::string& file_or_name)
{
    std::vector<const char*> names;
    for (const BuiltinScene& scene : builtin_scenes()) names.push_back(scene.name);
    const std::string stem = std::filesystem::path(file_or_name).stem().string();
    throw Error(ErrorKind::bad_input, "no file and no built-in scene is named " + in_quotes(file_or_name) +
                                          suggestion(stem, names) +
                                          " (`pliant list` shows the built-in scenes)");
}

std::string read_text(const std::filesystem::path& file)
{
    constexpr std::size_t longest = std::size_t{64} << 20U;  // bytes; stops at endless devices
    std::ifstream stream(file, std::ios::binary);
    std::string text;
    char block[1U << 16U];
    while (stream && text.size() <= longest) {
        stream.read(block, sizeof block);
        text.append(block, static_cast<std::size_t>(stream.gcount()));
    }
    const std::string source = printable(file.string());
    if (!stream.eof() && text.size() <= longest)
        throw Error(ErrorKind::bad_input, source + " cannot be read");
    if (text.size() > longest)
        throw Error(ErrorKind::bad_input, source + " is longer than the 64 MiB a scene may have");
    return text;
}

/// A built-in name always means the built-in scene; a file with that name can be given as ./name.
SceneText find_scene_text(const std::string& file_or_name)
{
    if (const BuiltinScene* scene = find_builtin(file_or_name))
        return {scene->text, scene->file, scene->name, {}};
    const std::filesystem::path file = file_or_name;
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) refuse_name(file_or_name);
    if (std::filesystem::is_directory(file, ignored))
        throw Error(ErrorKind::bad_input,
                    printable(file_or_name) + " is a directory, but must be a scene file");
    return {read_text(file), printable(file_or_name), file.stem().string(), file.parent_path()};
}

/// An override, and the path below which it changed the scene.
struct AppliedOverride {
    std::string path, text;
    bool concerns(const std::string& field) const
    {
        return field.starts_with(path) &&
               (field.size() == path.size() || field[path.size()] == '.' || field[path.size()] == '[');
    }
};

Scene scene_of(const Json& document, const SceneText& source)
{
    Scene scene;
    scene.name = source.name;
    ObjectReader::read(document, "", source.folder, [&](ObjectReader& at) { fields(at, scene); });
    validate(scene);
    return scene;
}

}  // namespace
}  // namespace scene_format

Scene read_scene(const std::string& file_or_name, const std::vector<std::string>& overrides)
{
    using namespace scene_format;
    const SceneText source = find_scene_text(file_or_name);
    Json document = parse_document(source.text, source.source);
    std::vector<AppliedOverride> applied;
    for (const std::string& text : overrides) applied.push_back({apply_override(document, text), text});
    try {
        return scene_of(document, source);
    } catch (const FieldError& error) {
        const auto culprit = std::find_if(applied.rbegin(), applied.rend(), [&](const auto& candidate) {
            return candidate.concerns(error.path);
        });
        const std::string where =
            culprit == applied.rend() ? source.source : "override " + printable(culprit->text);
        throw Error(error.kind, where + ": " + error.what());
    }
}

}  // namespace pliant
