// Tables 1 and 2 of the cloth paper beside ours, from this program's table of passes.
#include <map>

#include "experiment_plan.hpp"
#include "pliant/error.hpp"
#include "solve/pass.hpp"

namespace pliant::tool::reproduce {
namespace {

std::string names_of(std::span<const Resource> resources)
{
    std::string text;
    for (const Resource resource : resources)
        text += (text.empty() ? "" : ", ") + std::string(name_of(resource));
    return text;
}

const PassDescription& pass_named(const std::string& name)
{
    for (const PassDescription& pass : all_passes())
        if (name == pass.name) return pass;
    throw Error(ErrorKind::bad_usage, "papers.json: there is no pass " + name);
}

Json column(const char* title, const char* source)
{
    return {{"name", title}, {"title", title}, {"unit", ""}, {"source", source}};
}

bool is_papers(const PassDescription& pass) { return pass.family == PassFamily::paper; }

/// The paper's kernels and ours; then our passes without a counterpart.
Json kernels()
{
    Json table;
    table["title"] = "Table 1: kernels";
    table["columns"] = {column("their shader", "theirs"),
                        column("their kernel", "theirs"),
                        column("their groups", "theirs"),
                        column("our pass", "ours"),
                        column("one invocation is", "ours"),
                        column("reads", "ours"),
                        column("writes", "ours")};
    table["rows"] = Json::array();
    std::map<std::string, int> told;
    const auto add = [&](const Json& theirs, const std::string& name) {
        const PassDescription& pass = pass_named(name);
        table["rows"].push_back({theirs[0], theirs[1], theirs[2], pass.name, description_of(pass.unit),
                                 names_of(pass.reads), names_of(pass.writes)});
        ++told[name];
    };
    for (const Json& kernel : papers().at("kernels"))
        for (const std::string name : kernel["ours"])
            add({kernel["shader"], kernel["kernel"], kernel["groups"]}, name);
    for (const PassDescription& pass : all_passes())
        if (is_papers(pass) && !told[pass.name]) add({"", "", ""}, pass.name);
    return table;
}

/// The paper's buffers; then the resources of our passes for the same solver.
Json buffers()
{
    Json table;
    table["title"] = "Table 2: buffers";
    table["columns"] = {column("buffer", "theirs and ours"),   column("whose", "theirs and ours"),
                        column("size", "theirs and ours"),     column("type", "theirs and ours"),
                        column("what", "theirs and ours"),     column("passes that read it", "ours"),
                        column("passes that write it", "ours")};
    table["rows"] = Json::array();
    for (const Json& buffer : papers().at("buffers"))
        table["rows"].push_back(
            {buffer["buffer"], "theirs", buffer["size"], buffer["type"], buffer["what"], "", ""});
    std::map<Resource, std::pair<int, int>> uses;
    for (const PassDescription& pass : all_passes()) {
        if (!is_papers(pass)) continue;
        for (const Resource resource : pass.reads) ++uses[resource].first;
        for (const Resource resource : pass.writes) ++uses[resource].second;
    }
    for (const auto& [resource, counts] : uses) {
        const std::string size = resource == Resource::vectors ? std::to_string(row_planes) + " m + " +
                                                                     std::to_string(paper_planes) + " n"
                                 : resource == Resource::blocks     ? "non-zeros"
                                 : resource == Resource::scalars    ? std::to_string(scalar_count)
                                 : resource == Resource::sums       ? "m / " + std::to_string(sum_columns)
                                 : resource == Resource::colliders  ? "colliders"
                                 : resource == Resource::multiplier ? "n"
                                                                    : "3n";
        const char* what = resource == Resource::vectors  ? "rows, multipliers, conjugate gradients"
                           : resource == Resource::blocks ? "the matrix"
                                                          : "";
        table["rows"].push_back({name_of(resource), "ours", size, "float", what, std::to_string(counts.first),
                                 std::to_string(counts.second)});
    }
    return table;
}

}  // namespace

Json pass_tables()
{
    Json document;
    document["machines"] = Json::array();
    document["tables"] = {kernels(), buffers()};
    document["findings"] = Json::array();
    document["notes"] = Json::array();
    document["commands"] = Json::array();
    document["pictures"] = Json::array();
    return document;
}

}  // namespace pliant::tool::reproduce
