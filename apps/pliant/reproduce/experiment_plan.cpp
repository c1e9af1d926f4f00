#include "experiment_plan.hpp"

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

bool tells_speed(const Experiment& experiment)
{
    return std::any_of(experiment.quantities.begin(), experiment.quantities.end(),
                       [](const std::string& quantity) {
                           return quantity == "frames_per_second" || quantity == "step_cost_us";
                       });
}

}  // namespace

ExperimentPlan::ExperimentPlan(const Experiment& experiment, Circumstances here)
    : experiment_(experiment), here_(std::move(here))
{
    if (experiment.kind != ExperimentKind::passes) {
        machines_ = machines_of(experiment);
        cases_ = experiment.cases(here_.quick, here_.meshes);
    }
    switch (experiment.kind) {
        case ExperimentKind::passes: break;
        case ExperimentKind::speed:
            measure_ = [this](const Scene& scene, std::string&) {
                return measure_speed(experiment_, scene, here_.quick, machines_, here_.interrupted);
            };
            break;
        case ExperimentKind::stability:
            finds_step_ = true;
            measure_ = [this](const Scene& scene, std::string&) {
                return measure_stability(experiment_, scene, here_.quick, machines_, here_.interrupted);
            };
            break;
        case ExperimentKind::behaviour:
            measure_ = [this](const Scene& scene, std::string& no_pictures) {
                Measurements all;
                for (const MachineHere& machine : machines_)
                    all.push_back(measure_behaviour(experiment_, scene, here_.quick, machine, no_pictures,
                                                    here_.interrupted));
                return all;
            };
            break;
    }
    key_ = key();
}

std::string ExperimentPlan::key() const
{
    Json settings;
    settings["version"] = PLIANT_VERSION;
    settings["experiment"] = experiment_.data;
    settings["set"] = experiment_.set;
    settings["numbers"] = numbers_of(experiment_);
    settings["quick"] = here_.quick;
    settings["machines"] = Json::array();
    for (const MachineHere& machine : machines_)
        settings["machines"].push_back(machine.title + ", " + machine.device);
    settings["meshes"] = Json::array();
    for (const Case& each : cases_)
        if (!each.mesh.empty())
            settings["meshes"].push_back({each.mesh, std::filesystem::file_size(here_.meshes / each.mesh)});
    if (!measure_) settings["tables"] = pass_tables();
    return hash_text(hash_of(settings.dump()));
}

std::filesystem::path ExperimentPlan::document_file() const
{
    return here_.out / "data" / (experiment_.id + ".json");
}

std::optional<Json> ExperimentPlan::finished() const
{
    std::ifstream file(document_file());
    if (!file) return std::nullopt;
    const Json document = Json::parse(file, nullptr, false);
    if (!document.is_object() || !document.contains("key") || document["key"] != key_) return std::nullopt;
    for (const Json& picture : document["pictures"])
        if (!std::filesystem::exists(here_.out / "pictures" / picture["file"].get<std::string>()))
            return std::nullopt;
    return document;
}

void ExperimentPlan::run(const CaseProgress& progress) const
{
    const auto start = std::chrono::steady_clock::now();
    Json document;
    document["id"] = experiment_.id;
    document["key"] = key_;
    document["quick"] = here_.quick;
    document["date"] = today();
    document["version"] = PLIANT_VERSION;
    for (const char* word : {"paper", "item", "title", "kind", "setting", "differs"})
        document[word] = experiment_.data.at(word);
    document["theirs"] = numbers_of(experiment_);
    document["hardware"] = papers().at("papers").at(experiment_.paper).at("hardware");
    document.update(measure_ ? measured(progress) : pass_tables());
    if (experiment_.data.contains("plot")) document["plot"] = experiment_.data["plot"];
    document["seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::size_t number = 0;
    for (const Json& table : document["tables"]) {
        const std::string suffix = number++ == 0 ? "" : "_" + std::to_string(number);
        write_text_file(here_.out / "data" / (experiment_.id + suffix + ".csv"), csv_of(table));
    }
    write_text_file(document_file(), document.dump(1) + "\n");
}

Json ExperimentPlan::measured(const CaseProgress& progress) const
{
    ComparisonTable results(experiment_, machines_);
    Json commands = Json::array(), pictures = Json::array();
    std::string no_pictures;
    const OtherLoad others;
    for (std::size_t k = 0; k < cases_.size(); ++k) {
        progress(k, cases_.size(), name_of_case(experiment_, cases_[k]));
        const CaseScene made = scene_of(experiment_, cases_[k], here_.quick, here_.meshes);
        const Measurements measurements = measure_(made.scene, no_pictures);
        for (const Measurement& m : measurements) keep_pictures(cases_[k], m, k, pictures);
        results.add(cases_[k], measurements);
        commands.push_back(command_of(made, measurements));
    }
    results.add_means();

    Json document;
    document["machines"] = Json::array();
    for (const MachineHere& machine : machines_)
        document["machines"].push_back({{"title", machine.machine == Machine::best ? "ours" : machine.title},
                                        {"device", machine.device},
                                        {"software", machine.software}});
    document["tables"] = Json::array({results.json()});
    document["findings"] = findings_of(experiment_, results.json());
    document["notes"] = Json::array();
    for (const std::string& note : results.notes()) document["notes"].push_back(note);
    if (!no_pictures.empty()) document["notes"].push_back("no pictures: " + no_pictures);
    if (const auto share = others.share()) {
        document["others_share"] = *share;
        if (tells_speed(experiment_) && *share > quiet)
            document["notes"].push_back(
                "measured on a busy machine: other programs took " +
                std::to_string(std::lround(100 * *share)) +
                " % of its processors' time, so that speeds are too low and ratios uncertain");
    }
    document["commands"] = commands;
    document["pictures"] = pictures;
    return document;
}

/// Writes the pictures of a case and adds them to the document.
void ExperimentPlan::keep_pictures(const Case& each, const Measurement& m, std::size_t number,
                                   Json& pictures) const
{
    for (std::size_t k = 0; k < m.pictures.size(); ++k) {
        const Picture& picture = m.pictures[k];
        const std::string file =
            experiment_.id + "_" + std::to_string(number) + "_" + std::to_string(k) + ".png";
        write_png(here_.out / "pictures" / file, picture.image);
        std::string caption = name_of_case(experiment_, each) + ": " + number_text(picture.time) + " s";
        if (picture.is_last)
            caption += m.finite ? std::string(", later too fast to be drawn")
                                : ", before it diverged in frame " + std::to_string(m.bad_frame);
        pictures.push_back({{"file", file}, {"case", name_of_case(experiment_, each)}, {"caption", caption}});
    }
}

std::string ExperimentPlan::command_of(const CaseScene& made, const Measurements& measurements) const
{
    const double step = measurements.front().step;
    return made.command + (finds_step_ && step > 0 ? " --set time.dt=" + number_text(step) : "");
}

}  // namespace pliant::tool::reproduce
