#include "bench_command.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <thread>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "files/atomic_file.hpp"
#include "pliant/error.hpp"
#include "pliant/version.hpp"
#include "progress.hpp"

namespace pliant::tool {

bool Bar::met_by(double measured) const
{
    switch (kind) {
        case Kind::at_most: return measured <= value;
        case Kind::at_least: return measured >= value;
        case Kind::none: break;
    }
    return true;
}

BenchRow BenchTable::row(const Simulation& simulation, const std::string& subject, double stiffness,
                         double stretch) const
{
    const Report& report = simulation.report();
    BenchRow row;
    row.suite = suite_;
    row.subject = subject;
    row.backend = name_of(simulation.backend());
    row.threads = simulation.thread_count();
    row.nodes = simulation.node_count();
    row.springs = simulation.spring_count();
    row.stiffness = stiffness;
    row.step = simulation.step_length();
    row.real_time_factor = report.simulated_seconds / std::max(report.wall_seconds, 1e-9);
    row.stretch = stretch;
    if (report.device_lost) throw Error(ErrorKind::device_failure, subject + ": " + report.failure);
    return row;
}

void BenchTable::add(BenchRow row, const std::string& quantity, double value, const std::string& unit,
                     Bar bar)
{
    row.quantity = quantity;
    row.value = value;
    row.unit = unit;
    row.bar = bar;
    rows_.push_back(std::move(row));
}

namespace {

std::string text_of(const char* format, double value)
{
    char text[48];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string bar_text(const Bar& bar)
{
    if (bar.kind == Bar::Kind::none) return "";
    return (bar.kind == Bar::Kind::at_most ? "<= " : ">= ") + text_of("%.4g", bar.value);
}
std::string verdict(const BenchRow& row)
{
    return row.bar.kind == Bar::Kind::none ? "" : row.bar.met_by(row.value) ? "met" : "missed";
}

/// A table whose columns are as wide as what is in them; the first two are words, the others end with
/// numbers.
void print_table(const std::string& suite, std::span<const BenchRow> rows)
{
    std::vector<std::vector<std::string>> lines = {{"case", "measured", "value", "unit", "bar", "",
                                                    "stiffness N/m", "step ms", "simulated s / wall s",
                                                    "max stretch %", "nodes", "springs", ""}};
    for (const BenchRow& row : rows)
        if (row.suite == suite)
            lines.push_back({row.subject, row.quantity, text_of("%.4g", row.value), row.unit,
                             bar_text(row.bar), verdict(row), text_of("%g", row.stiffness),
                             text_of("%.4g", 1000 * row.step), text_of("%.3g", row.real_time_factor),
                             row.stretch ? text_of("%.3g", 100 * *row.stretch) : "-",
                             std::to_string(row.nodes), std::to_string(row.springs), row.remark});
    std::vector<std::size_t> widths(lines.front().size());
    for (const auto& line : lines)
        for (std::size_t k = 0; k < line.size(); ++k) widths[k] = std::max(widths[k], line[k].size());
    std::printf("%s: %zu rows\n", suite.c_str(), lines.size() - 1);
    for (const auto& line : lines) {
        std::string text;
        for (std::size_t k = 0; k < line.size(); ++k) {
            const std::string padding(widths[k] - line[k].size(), ' ');
            const bool words = k < 2 || k == 3 || k == 4 || k == 5 || k + 1 == line.size();
            text += (k > 0 ? "  " : "") + (words ? line[k] + padding : padding + line[k]);
        }
        text.erase(text.find_last_not_of(' ') + 1);
        std::printf("%s\n", text.c_str());
    }
    std::printf("\n");
    std::fflush(stdout);
}

/// Finite numbers as they are; JSON knows no others.
nlohmann::ordered_json json_number(double value)
{
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

void write_json(AtomicFile& file, const std::string& machine, bool quick, std::span<const BenchRow> rows)
{
    nlohmann::ordered_json document;
    document["pliant"] = PLIANT_VERSION;
    document["machine"] = machine;
    document["quick"] = quick;
    auto& list = document["rows"] = nlohmann::ordered_json::array();
    for (const BenchRow& row : rows) {
        nlohmann::ordered_json& entry = list.emplace_back();
        entry["suite"] = row.suite;
        entry["case"] = row.subject;
        entry["measured"] = row.quantity;
        entry["value"] = json_number(row.value);
        entry["unit"] = row.unit;
        entry["bar"] = bar_text(row.bar);
        entry["verdict"] = verdict(row);
        entry["backend"] = row.backend;
        entry["threads"] = row.threads;
        entry["nodes"] = row.nodes;
        entry["springs"] = row.springs;
        entry["stiffness"] = json_number(row.stiffness);
        entry["step_seconds"] = row.step;
        entry["real_time_factor"] = json_number(row.real_time_factor);
        entry["max_stretch"] = row.stretch ? json_number(*row.stretch) : nlohmann::ordered_json(nullptr);
        entry["remark"] = row.remark;
    }
    file.stream() << document.dump(2) << '\n';
    file.commit();
}

std::string quoted(const std::string& text)
{
    return '"' + text + '"';
}  // our own words have no quotes in them

void write_csv(AtomicFile& file, std::span<const BenchRow> rows)
{
    std::ostream& out = file.stream();
    out << "suite,case,measured,value,unit,bar,verdict,backend,threads,nodes,springs,stiffness_N_per_m,step_"
           "s,"
           "real_time_factor,max_stretch,remark\n";
    for (const BenchRow& row : rows)
        out << row.suite << ',' << quoted(row.subject) << ',' << quoted(row.quantity) << ',' << row.value
            << ',' << row.unit << ',' << bar_text(row.bar) << ',' << verdict(row) << ',' << row.backend << ','
            << row.threads << ',' << row.nodes << ',' << row.springs << ',' << row.stiffness << ','
            << row.step << ',' << row.real_time_factor << ','
            << (row.stretch ? text_of("%.9g", *row.stretch) : "") << ',' << quoted(row.remark) << '\n';
    file.commit();
}

struct Suite {
    const char* name;
    std::vector<BenchCase> (*cases)(const BenchOptions&);
};
constexpr Suite suites[] = {
    {"constraint", constraint_cases}, {"acad", acad_cases}, {"stability", stability_cases}};

std::unique_ptr<AtomicFile> file_of(const std::string& name)
{
    return name.empty() ? nullptr : std::make_unique<AtomicFile>(name);
}

}  // namespace

int bench_command(const BenchOptions& options)
{
    if (!options.json_file.empty() && options.json_file == options.csv_file)
        throw Error(ErrorKind::bad_usage, "--json and --csv both name " + options.csv_file);
    const auto json = file_of(options.json_file),
               csv = file_of(options.csv_file);  // refused before the work is done
    const Simulation probe(hanging_sheet(4, 1e-6), options.simulation);
    const std::string machine =
        probe.device_name() + ", " + std::to_string(std::thread::hardware_concurrency()) + " cores";
    std::printf("pliant %s on %s%s\n\n", PLIANT_VERSION, machine.c_str(),
                options.quick ? "; --quick: these figures say nothing" : "");
    std::fflush(stdout);

    BenchTable table;
    for (const Suite& suite : suites) {
        if (options.suite != "all" && options.suite != suite.name) continue;
        table.begin_suite(suite.name);
        std::vector<BenchCase> cases = suite.cases(options);
        std::erase_if(
            cases, [&](const BenchCase& each) { return each.name.find(options.only) == std::string::npos; });
        if (cases.empty()) continue;
        Progress progress(cases.size(), false, "case");
        for (std::size_t k = 0; k < cases.size(); ++k) {
            progress.update(k, cases[k].name);
            cases[k].measure(table);
        }
        progress.update(cases.size(), std::string(suite.name) + " is done");
        progress.clear();
        print_table(suite.name, table.rows());
    }
    if (json) write_json(*json, machine, options.quick, table.rows());
    if (csv) write_csv(*csv, table.rows());
    return 0;
}

}  // namespace pliant::tool
