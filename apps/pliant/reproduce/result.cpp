#include "result.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>

#include "comparison_table.hpp"
#include "files/atomic_file.hpp"
#include "other_load.hpp"
#include "pliant/render.hpp"
#include "pliant/version.hpp"
#include "record/run_record.hpp"

namespace pliant::tool::reproduce {
namespace {

constexpr double quiet = 0.05;  // share of processor time that others may take without a remark

/// FNV-1a, 64 bit.
std::uint64_t hash_of(const std::string& text)
{
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return hash;
}

std::vector<MachineHere> machines_of(const Experiment& experiment)
{
    std::vector<MachineHere> machines;
    for (const Machine machine : experiment.machines)
        if (const auto here = machine_here(machine)) machines.push_back(*here);
    return machines;
}

std::string today()
{
    const std::time_t now = std::time(nullptr);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now));
    return text;
}

std::filesystem::path document_file(const Experiment& experiment, const Circumstances& here)
{
    return here.out / "data" / (experiment.id + ".json");
}

/// The name of a case outside its table.
std::string name_of_case(const Experiment& experiment, const Case& each)
{
    std::string text;
    for (std::size_t k = 0; k < each.labels.size(); ++k) {
        const bool is_number = number_of(each.labels[k]).has_value();
        text += (k > 0 ? ", " : "") + (is_number ? experiment.axes[k].name + " = " : "") + each.labels[k];
    }
    return text;
}

/// Sentences computed from the table.
Json findings_of(const Experiment& experiment, const Json& table)
{
    Json findings = Json::array();
    if (!experiment.data.contains("findings")) return findings;
    for (const Json& finding : experiment.data["findings"]) {
        const Json& columns = table["columns"];
        std::size_t measure = 0;
        for (std::size_t c = 0; c < columns.size(); ++c)
            if (columns[c]["name"] == finding["measure"]) measure = c;
        for (std::size_t c = 0; c < columns.size(); ++c) {
            if (columns[c]["name"] != finding["quantity"] || columns[c]["source"] == "theirs") continue;
            double largest = 0;
            for (const Json& row : table["rows"]) {
                const auto value = number_of(row[c]), size = number_of(row[measure]);
                if (!value || !size || *value < finding["at_least"].get<double>()) continue;
                largest = std::max(largest, *size);
            }
            findings.push_back(columns[c]["source"].get<std::string>() + ": " +
                               finding["text"].get<std::string>() + ": " +
                               (largest > 0 ? number_text(largest) : "none"));
        }
    }
    return findings;
}

/// Writes the pictures of a case and adds them to the document.
void keep_pictures(const Experiment& experiment, const Case& each, const Measurement& m, std::size_t number,
                   const Circumstances& here, Json& pictures)
{
    for (std::size_t k = 0; k < m.pictures.size(); ++k) {
        const Picture& picture = m.pictures[k];
        const std::string file =
            experiment.id + "_" + std::to_string(number) + "_" + std::to_string(k) + ".png";
        write_png(here.out / "pictures" / file, picture.image);
        std::string caption = name_of_case(experiment, each) + ": " + number_text(picture.time) + " s";
        if (picture.is_last)
            caption += m.finite ? std::string(", later too fast to be drawn")
                                : ", before it diverged in frame " + std::to_string(m.bad_frame);
        pictures.push_back({{"file", file}, {"case", name_of_case(experiment, each)}, {"caption", caption}});
    }
}

Json measured(const Experiment& experiment, const Circumstances& here)
{
    const auto machines = machines_of(experiment);
    const auto cases = experiment.cases(here.quick, here.meshes);
    ComparisonTable results(experiment, machines);
    Json commands = Json::array(), pictures = Json::array();
    std::string no_pictures;
    const OtherLoad others;
    for (std::size_t k = 0; k < cases.size(); ++k) {
        here.progress(k, cases.size(), name_of_case(experiment, cases[k]));
        const CaseScene made = scene_of(experiment, cases[k], here.quick, here.meshes);
        std::vector<Measurement> measurements;
        if (experiment.kind == "speed")
            measurements = measure_speed(experiment, made.scene, here.quick, machines, here.interrupted);
        else if (experiment.kind == "stability")
            measurements = measure_stability(experiment, made.scene, here.quick, machines, here.interrupted);
        else
            for (const MachineHere& machine : machines)
                measurements.push_back(measure_behaviour(experiment, made.scene, here.quick, machine,
                                                         no_pictures, here.interrupted));
        for (const Measurement& m : measurements) keep_pictures(experiment, cases[k], m, k, here, pictures);
        results.add(cases[k], measurements);
        const double step = measurements.front().step;
        commands.push_back(made.command + (experiment.kind == "stability" && step > 0
                                               ? " --set time.dt=" + number_text(step)
                                               : ""));
    }
    results.add_means();

    Json document;
    document["machines"] = Json::array();
    for (const MachineHere& machine : machines)
        document["machines"].push_back({{"title", machine.machine == Machine::best ? "ours" : machine.title},
                                        {"device", machine.device},
                                        {"software", machine.software}});
    document["tables"] = Json::array({results.json()});
    document["findings"] = findings_of(experiment, results.json());
    document["notes"] = Json::array();
    for (const std::string& note : results.notes()) document["notes"].push_back(note);
    if (!no_pictures.empty()) document["notes"].push_back("no pictures: " + no_pictures);
    const bool tells_speed = std::any_of(
        experiment.quantities.begin(), experiment.quantities.end(), [](const std::string& quantity) {
            return quantity == "frames_per_second" || quantity == "step_cost_us";
        });
    if (const auto share = others.share()) {
        document["others_share"] = *share;
        if (tells_speed && *share > quiet)
            document["notes"].push_back(
                "measured on a busy machine: other programs took " +
                std::to_string(std::lround(100 * *share)) +
                " % of its processors' time, so that speeds are too low and ratios uncertain");
    }
    document["commands"] = commands;
    document["pictures"] = pictures;
    return document;
}

}  // namespace

std::string key_of(const Experiment& experiment, const Circumstances& here)
{
    Json settings;
    settings["version"] = PLIANT_VERSION;
    settings["experiment"] = experiment.data;
    settings["set"] = experiment.set;
    settings["numbers"] = numbers_of(experiment);
    settings["quick"] = here.quick;
    settings["machines"] = Json::array();
    for (const MachineHere& machine : machines_of(experiment))
        settings["machines"].push_back(machine.title + ", " + machine.device);
    settings["meshes"] = Json::array();
    if (experiment.kind == "passes")
        settings["tables"] = pass_tables();
    else
        for (const Case& each : experiment.cases(here.quick, here.meshes))
            if (!each.mesh.empty())
                settings["meshes"].push_back(
                    {each.mesh, std::filesystem::file_size(here.meshes / each.mesh)});
    return hash_text(hash_of(settings.dump()));
}

std::optional<Json> finished(const Experiment& experiment, const Circumstances& here)
{
    std::ifstream file(document_file(experiment, here));
    if (!file) return std::nullopt;
    const Json document = Json::parse(file, nullptr, false);
    if (!document.is_object() || !document.contains("key") || document["key"] != key_of(experiment, here))
        return std::nullopt;
    for (const Json& picture : document["pictures"])
        if (!std::filesystem::exists(here.out / "pictures" / picture["file"].get<std::string>()))
            return std::nullopt;
    return document;
}

Json run_experiment(const Experiment& experiment, const Circumstances& here)
{
    const auto start = std::chrono::steady_clock::now();
    Json document;
    document["id"] = experiment.id;
    document["key"] = key_of(experiment, here);
    document["quick"] = here.quick;
    document["date"] = today();
    document["version"] = PLIANT_VERSION;
    for (const char* word : {"paper", "item", "title", "kind", "setting", "differs"})
        document[word] = experiment.data.at(word);
    document["theirs"] = numbers_of(experiment);
    document["hardware"] = papers().at("papers").at(experiment.paper).at("hardware");
    document.update(experiment.kind == "passes" ? pass_tables() : measured(experiment, here));
    if (experiment.data.contains("plot")) document["plot"] = experiment.data["plot"];
    document["seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::size_t number = 0;
    for (const Json& table : document["tables"]) {
        const std::string suffix = number++ == 0 ? "" : "_" + std::to_string(number);
        write_text(here.out / "data" / (experiment.id + suffix + ".csv"), csv_of(table));
    }
    write_text(document_file(experiment, here), document.dump(1) + "\n");
    return document;
}

void write_text(const std::filesystem::path& file, const std::string& text)
{
    AtomicFile target(file);
    target.stream() << text;
    target.commit();
}

}  // namespace pliant::tool::reproduce
