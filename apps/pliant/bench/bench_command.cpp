#include "bench/bench_command.hpp"

#include <fstream>
#include <memory>
#include <new>
#include <set>
#include <thread>

#include "bench/files.hpp"
#include "commands.hpp"
#include "pliant/error.hpp"
#include "pliant/version.hpp"
#include "processor.hpp"
#include "progress.hpp"

namespace pliant::tool {
namespace {

struct Suite {
    const char* name;
    std::vector<BenchCase> (*cases)(const BenchOptions&);
    bool has_sizes;
};
constexpr Suite suites[] = {{"mss", mass_spring_cases, true},
                            {"constraint", constraint_cases, true},
                            {"acad", acad_cases, false},
                            {"volume", volume_cases, true},
                            {"stability", stability_cases, false}};

std::unique_ptr<AtomicFile> file_of(const std::string& name)
{
    return name.empty() ? nullptr : std::make_unique<AtomicFile>(name);
}

void check_files(const BenchOptions& options)
{
    std::set<std::string> names;
    for (const std::string& name : {options.json_file, options.csv_file, options.plot_file})
        if (!name.empty() && !names.insert(name).second)
            throw Error(ErrorKind::bad_usage,
                        "two of --json, --csv and --plot name " + name + "; give each its own");
}

/// The device of the steps, and the machine.
std::string machine_name(const BenchOptions& options)
{
    const Simulation probe(hanging_sheet(4, 1e-6), options.simulation);
    const std::string processor = processor_name();
    return probe.device_name() + (processor.empty() ? "" : "; " + processor) + ", " +
           std::to_string(std::thread::hardware_concurrency()) + " cores";
}

/// Runs the cases of a suite. A case that the device cannot run is reported and skipped.
void measure(const char* suite, const std::vector<BenchCase>& cases, BenchTable& table, std::size_t& failures)
{
    table.begin_suite(suite);
    Progress progress(cases.size(), false, "case");
    for (std::size_t k = 0; k < cases.size(); ++k) {
        progress.update(k, cases[k].name);
        std::string failure;
        try {
            cases[k].measure(table);
        } catch (const Error& error) {
            if (error.kind != ErrorKind::device_failure) throw;
            failure = error.what();
        } catch (const std::bad_alloc&) {
            failure = "this machine has too little memory for it";
        }
        if (failure.empty()) continue;
        ++failures;
        progress.clear();
        std::fprintf(stderr, "pliant: not measured: %s: %s\n", cases[k].name.c_str(), failure.c_str());
    }
    progress.update(cases.size(), std::string(suite) + " is done");
    progress.clear();
    print_suite(suite, table.rows());
}

}  // namespace

int bench_command(const BenchOptions& options)
{
    check_files(options);
    for (const Suite& suite : suites)
        if (options.suite == suite.name && !options.sizes.empty() && !suite.has_sizes)
            throw Error(ErrorKind::bad_usage,
                        std::string("--sizes is for mss, constraint and volume: the suite ") + suite.name +
                            " has cases of one size; leave it out");
    // Opened first, so that errors come before the work.
    const auto json = file_of(options.json_file), csv = file_of(options.csv_file),
               plot = file_of(options.plot_file);
    std::vector<std::vector<BenchCase>> cases;  // by suite; errors in the options show here
    for (const Suite& suite : suites) {
        cases.emplace_back();
        if (options.suite != "all" && options.suite != suite.name) continue;
        cases.back() = suite.cases(options);
        std::erase_if(cases.back(), [&](const BenchCase& each) {
            return each.name.find(options.only) == std::string::npos;
        });
    }
    const BenchMachine machine{machine_name(options), options.quick};
    std::printf("pliant %s on %s%s\n\n", PLIANT_VERSION, machine.name.c_str(),
                options.quick ? "; --quick: these figures are not meaningful" : "");
    std::fflush(stdout);

    BenchTable table;
    std::size_t failures = 0;
    for (std::size_t k = 0; k < cases.size(); ++k)
        if (!cases[k].empty()) measure(suites[k].name, cases[k], table, failures);
    if (json) write_json(*json, machine, table.rows());
    if (csv) write_csv(*csv, machine, table.rows());
    if (plot) write_plot(*plot, machine, table.rows());
    return failures == 0 ? 0 : static_cast<int>(ErrorKind::device_failure);
}

}  // namespace pliant::tool
