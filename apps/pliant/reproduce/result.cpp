#include "result.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <set>

#include "files/atomic_file.hpp"
#include "pliant/version.hpp"
#include "record/run_record.hpp"
#include "render/image_file.hpp"

namespace pliant::tool::reproduce {
namespace {

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

Json numbers_of(const Experiment& experiment)
{
    const Json& numbers = papers().at("numbers");
    return numbers.contains(experiment.id) ? numbers[experiment.id] : Json::array();
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

/// What a cell says as a number; nothing for an empty one and for words.
std::optional<double> number_of(const std::string& cell)
{
    char* end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    if (cell.empty() || *end != '\0') return std::nullopt;
    return value;
}

/// A table that grows by rows of texts, one for each column.
class Table {
public:
    void add_column(const std::string& name, const std::string& title, const std::string& unit,
                    const std::string& source)
    {
        columns_.push_back({{"name", name}, {"title", title}, {"unit", unit}, {"source", source}});
    }
    void add_row(Json cells) { rows_.push_back(std::move(cells)); }
    std::size_t width() const { return columns_.size(); }
    /// Without the columns that nothing stands in.
    Json json() const
    {
        Json columns = Json::array(), rows = Json::array();
        std::vector<std::size_t> kept;
        for (std::size_t c = 0; c < width(); ++c)
            if (std::any_of(rows_.begin(), rows_.end(), [c](const Json& row) { return row[c] != ""; }))
                kept.push_back(c);
        for (const std::size_t c : kept) columns.push_back(columns_[c]);
        for (const Json& row : rows_) {
            Json& cells = rows.emplace_back(Json::array());
            for (const std::size_t c : kept) cells.push_back(row[c]);
        }
        return {{"columns", columns}, {"rows", rows}};
    }
    const Json& rows() const { return rows_; }
    const Json& columns() const { return columns_; }

private:
    Json columns_ = Json::array(), rows_ = Json::array();
};

/// The papers' numbers that stand in columns of their own: series and quantity.
std::vector<std::pair<std::string, std::string>> their_series(const Json& numbers)
{
    std::vector<std::pair<std::string, std::string>> series;
    for (const Json& number : numbers) {
        if (!number.contains("series")) continue;
        const std::pair<std::string, std::string> each = {number["series"], number["quantity"]};
        if (std::find(series.begin(), series.end(), each) == series.end()) series.push_back(each);
    }
    return series;
}

std::string their_number(const Json& numbers, const std::pair<std::string, std::string>& series,
                         const std::vector<Axis>& axes, const std::vector<std::string>& keys)
{
    for (const Json& number : numbers) {
        if (!number.contains("series") || number["series"] != series.first ||
            number["quantity"] != series.second)
            continue;
        bool matches = true;
        for (std::size_t k = 0; k < axes.size(); ++k)
            if (number["case"].contains(axes[k].name)) matches &= number["case"][axes[k].name] == keys[k];
        if (matches) return number_text(number["value"].get<double>());
    }
    return "";
}

/// Columns of an experiment, and what fills them.
class Results {
public:
    Results(const Experiment& experiment, std::vector<MachineHere> machines)
        : experiment_(experiment), machines_(std::move(machines)), numbers_(numbers_of(experiment))
    {
        for (const Axis& axis : experiment_.axes) table_.add_column(axis.name, axis.name, "", "case");
        for (const std::string& name : experiment_.of_case) {
            const Quantity& quantity = quantity_of(name);
            table_.add_column(name, quantity.title, quantity.unit, "case");
        }
        for (const auto& series : their_series(numbers_)) {
            const bool is_ratio = series.second == "ratio";
            const std::string title = is_ratio ? "" : ": " + std::string(quantity_of(series.second).title);
            table_.add_column(series.second, series.first + title,
                              is_ratio ? "" : quantity_of(series.second).unit, "theirs");
        }
        for (const MachineHere& machine : machines_)
            for (const std::string& name : experiment_.quantities)
                if (machine.machine != Machine::serial || name == "frames_per_second" || name == "frames") {
                    const Quantity& quantity = quantity_of(name);
                    const std::string who = machine.machine == Machine::best ? "ours" : machine.title;
                    table_.add_column(name, who + ": " + quantity.title, quantity.unit, who);
                }
        for (const Ratio& ratio : experiment_.ratios) table_.add_column("ratio", ratio.title, "", "ratio");
    }

    void add(const Case& each, const std::vector<Measurement>& measurements)
    {
        Json cells = Json::array();
        for (const std::string& label : each.labels) cells.push_back(label);
        const Measurement* described = nullptr;
        for (const Measurement& m : measurements)
            if (m.measured && !described) described = &m;
        for (const std::string& name : experiment_.of_case)
            cells.push_back(described ? quantity_of(name).text(*described) : "");
        for (const auto& series : their_series(numbers_))
            cells.push_back(their_number(numbers_, series, experiment_.axes, each.keys));
        for (std::size_t k = 0; k < machines_.size(); ++k) {
            const Measurement& m = measurements[k];
            for (const std::string& name : experiment_.quantities) {
                const bool serial = machines_[k].machine == Machine::serial;
                if (serial && name != "frames_per_second" && name != "frames") continue;
                cells.push_back(m.absent.empty() ? quantity_of(name).text(m) : "");
            }
            if (!m.absent.empty()) notes_.insert(machines_[k].title + ": " + m.absent);
        }
        for (const Ratio& ratio : experiment_.ratios) {
            const Measurement* of = of_machine(measurements, ratio.of);
            const Measurement* over = of_machine(measurements, ratio.over);
            const bool both = of && over && of->absent.empty() && over->absent.empty();
            cells.push_back(both ? number_text(of->frames_per_second / over->frames_per_second) : "");
        }
        keys_.push_back(each.keys);
        table_.add_row(std::move(cells));
    }

    /// Rows with means over the axis that asks for them, one for each combination of the others.
    void add_means()
    {
        for (std::size_t mean_axis = 0; mean_axis < experiment_.axes.size(); ++mean_axis) {
            if (!experiment_.axes[mean_axis].mean) continue;
            std::vector<std::vector<std::string>> groups;
            const std::size_t count = keys_.size();
            for (std::size_t r = 0; r < count; ++r) {
                auto group = keys_[r];
                group[mean_axis] = "mean";
                if (std::find(groups.begin(), groups.end(), group) == groups.end()) groups.push_back(group);
            }
            for (const auto& group : groups) table_.add_row(mean_of(group, mean_axis, count));
        }
    }

    Json table() const { return table_.json(); }
    const std::set<std::string>& notes() const { return notes_; }

private:
    const Measurement* of_machine(const std::vector<Measurement>& measurements, Machine machine) const
    {
        for (std::size_t k = 0; k < machines_.size(); ++k)
            if (machines_[k].machine == machine) return &measurements[k];
        return nullptr;
    }

    Json mean_of(const std::vector<std::string>& group, std::size_t mean_axis, std::size_t count) const
    {
        Json cells = Json::array();
        for (const std::string& key : group) cells.push_back(key);
        const auto series = their_series(numbers_);
        std::size_t their_column = 0;
        for (std::size_t column = group.size(); column < table_.width(); ++column) {
            const std::string source = table_.columns()[column]["source"];
            if (source == "theirs") {
                cells.push_back(their_number(numbers_, series[their_column++], experiment_.axes, group));
                continue;
            }
            double sum = 0;
            int values = 0;
            for (std::size_t r = 0; r < count; ++r) {
                auto other = keys_[r];
                other[mean_axis] = "mean";
                const auto value = number_of(table_.rows()[r][column]);
                if (other != group || !value) continue;
                sum += *value;
                ++values;
            }
            cells.push_back(source == "case" || values == 0 ? "" : number_text(sum / values));
        }
        return cells;
    }

    const Experiment& experiment_;
    std::vector<MachineHere> machines_;
    Json numbers_;
    Table table_;
    std::vector<std::vector<std::string>> keys_;
    std::set<std::string> notes_;
};

std::string joined(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
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

/// Writes the pictures of a case and tells of them.
void keep_pictures(const Experiment& experiment, const Case& each, const Measurement& m, std::size_t number,
                   const Circumstances& here, Json& pictures)
{
    for (std::size_t k = 0; k < m.pictures.size(); ++k) {
        const Picture& picture = m.pictures[k];
        const std::string file =
            experiment.id + "_" + std::to_string(number) + "_" + std::to_string(k) + ".png";
        write_png(here.out / "pictures" / file, picture.image);
        std::string caption = joined(each.labels) + ": " + number_text(picture.time) + " s";
        if (picture.diverged) caption += ", before it diverged in frame " + std::to_string(m.bad_frame);
        pictures.push_back({{"file", file}, {"case", joined(each.labels)}, {"caption", caption}});
    }
}

Json measured(const Experiment& experiment, const Circumstances& here)
{
    const auto machines = machines_of(experiment);
    const auto cases = experiment.cases(here.quick, here.meshes);
    Results results(experiment, machines);
    Json commands = Json::array(), pictures = Json::array();
    std::string no_pictures;
    for (std::size_t k = 0; k < cases.size(); ++k) {
        here.progress(k, cases.size(), joined(cases[k].labels));
        const CaseScene made = scene_of(experiment, cases[k], here.meshes);
        std::vector<Measurement> measurements;
        if (experiment.kind == "speed")
            measurements = measure_speed(experiment, made.scene, here.quick, machines, here.interrupted);
        else
            for (const MachineHere& machine : machines)
                measurements.push_back(measure_behaviour(experiment, made.scene, here.quick, machine,
                                                         no_pictures, here.interrupted));
        for (const Measurement& m : measurements) keep_pictures(experiment, cases[k], m, k, here, pictures);
        results.add(cases[k], measurements);
        commands.push_back(made.command);
    }
    results.add_means();

    Json document;
    document["machines"] = Json::array();
    for (const MachineHere& machine : machines)
        document["machines"].push_back({{"title", machine.machine == Machine::best ? "ours" : machine.title},
                                        {"device", machine.device},
                                        {"software", machine.software}});
    document["tables"] = Json::array({results.table()});
    document["findings"] = findings_of(experiment, results.table());
    document["notes"] = Json::array();
    for (const std::string& note : results.notes()) document["notes"].push_back(note);
    if (!no_pictures.empty()) document["notes"].push_back("no pictures: " + no_pictures);
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
    if (document.is_discarded() || !document.is_object() ||
        document.value("key", "") != key_of(experiment, here))
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

std::string csv_of(const Json& table)
{
    const auto field = [](const std::string& text) {
        if (text.find_first_of(",\"\n") == std::string::npos) return text;
        std::string quoted = "\"";
        for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
        return quoted + '"';
    };
    std::string text;
    for (std::size_t c = 0; c < table["columns"].size(); ++c) {
        const Json& column = table["columns"][c];
        const std::string unit = column["unit"];
        text += (c > 0 ? "," : "") +
                field(column["title"].get<std::string>() + (unit.empty() ? "" : " [" + unit + "]"));
    }
    text += '\n';
    for (const Json& row : table["rows"]) {
        for (std::size_t c = 0; c < row.size(); ++c) text += (c > 0 ? "," : "") + field(row[c]);
        text += '\n';
    }
    return text;
}

}  // namespace pliant::tool::reproduce
