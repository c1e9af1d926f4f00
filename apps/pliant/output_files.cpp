// Checks of a run's files before it starts.
#include <filesystem>
#include <map>

#include "commands.hpp"
#include "files/atomic_file.hpp"
#include "files/numbered_name.hpp"

namespace pliant::tool {
namespace {

struct NamedFile {
    std::string role, name;
};

std::vector<NamedFile> files_of(const RunOptions& options, const Scene& scene)
{
    std::vector<NamedFile> files;
    if (std::filesystem::exists(options.scene)) files.push_back({"the scene", options.scene});
    for (std::size_t c = 0; c < scene.cloth_count(); ++c)
        if (const auto* mesh = std::get_if<SurfaceMesh>(&scene.cloth(c).shape))
            files.push_back({"a mesh of the scene", mesh->file.string()});
    files.push_back({"--stats", options.statistics_file});
    files.push_back({"--summary", options.summary_file});
    files.push_back({"--cache", options.cache_file});
    if (lower_case_ending(options.cache_file) == ".pc2")
        files.push_back({"the mesh of --cache",
                         std::filesystem::path(options.cache_file).replace_extension(".obj").string()});
    files.push_back({"--stills", options.stills});
    for (const std::string& file : options.picture_files) files.push_back({"--render", file});
    std::erase_if(files, [](const NamedFile& file) { return file.name.empty(); });
    return files;
}

}  // namespace

void check_outputs(const RunOptions& options, const Scene& scene)
{
    std::map<std::filesystem::path, std::string> roles;
    for (const NamedFile& file : files_of(options, scene)) {
        const auto path = std::filesystem::weakly_canonical(std::filesystem::absolute(file.name));
        const auto [other, is_new] = roles.emplace(path, file.role);
        const bool both_read = file.role == other->second && file.role == "a mesh of the scene";
        if (!is_new && !both_read)
            throw Error(ErrorKind::bad_usage, other->second + " and " + file.role + " both name '" +
                                                  file.name + "'; every output needs a name of its own");
    }
    const bool numbered_png =
        NumberedName::is_valid(options.stills) && lower_case_ending(options.stills) == ".png";
    if (!options.stills.empty() && !numbered_png)
        throw Error(ErrorKind::bad_usage,
                    "--stills '" + options.stills + "' must be of the form still_%04d.png");
    if (!options.summary_file.empty()) const AtomicFile probe(options.summary_file);
}

}  // namespace pliant::tool
