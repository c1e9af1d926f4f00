#include "reproduce_command.hpp"

#include <chrono>
#include <cstdio>
#include <system_error>

#include "../interruption.hpp"
#include "../progress.hpp"
#include "../stopwatch.hpp"
#include "experiment_plan.hpp"
#include "files/atomic_file.hpp"
#include "pliant/error.hpp"
#include "render/child_process.hpp"
#include "report.hpp"

namespace pliant::tool {
namespace {

using namespace reproduce;

bool asked_for(const Experiment& experiment, const ReproduceOptions& options)
{
    if (options.papers != "all" && options.papers != experiment.paper) return false;
    if (options.only.empty()) return true;
    for (const std::string& part : options.only)
        if (experiment.id.find(part) != std::string::npos) return true;
    return false;
}

std::vector<const Experiment*> chosen(const ReproduceOptions& options)
{
    std::vector<const Experiment*> list;
    for (const Experiment& experiment : experiments())
        if (asked_for(experiment, options)) list.push_back(&experiment);
    if (list.empty()) {
        std::string ids;
        for (const Experiment& experiment : experiments()) ids += " " + experiment.id;
        throw Error(ErrorKind::bad_usage, "--only " + options.only.front() + " names no experiment of '" +
                                              options.papers + "'; there are" + ids);
    }
    return list;
}

/// Creates the folders of a report, or throws with the reason.
void make_folders(const std::filesystem::path& out)
{
    for (const char* name : {"data", "figures", "pictures"}) {
        std::error_code error;
        std::filesystem::create_directories(out / name, error);
        if (error || !std::filesystem::is_directory(out / name))
            throw Error(ErrorKind::bad_input, "--out '" + out.string() + "': the folder '" +
                                                  (out / name).string() + "' cannot be made (" +
                                                  (error ? error.message() : "it is a file") +
                                                  "); name another folder");
    }
    const AtomicFile probe(out / "report.html");  // fails before the work, not after
}

bool has_matplotlib(const std::string& python)
{
    try {
        return ChildProcess({python, "-c", "import matplotlib"}).finish();
    } catch (const std::system_error&) {
        return false;
    }
}

/// Draws figures/ID.svg for every document; returns a sentence if it could not, else empty.
std::string draw_figures(const std::filesystem::path& out, const std::vector<Json>& documents)
{
    for (const std::string python : {"python3", "/usr/bin/python3"}) {
        if (!has_matplotlib(python)) continue;
        std::vector<std::string> arguments = {python, "-", out.string()};
        for (const Json& document : documents) arguments.push_back(document["id"]);
        ChildProcess plots(arguments);
        const std::string script = plots_script();
        plots.write(script.data(), script.size());
        return plots.finish() ? "" : "the figures could not be drawn: " + plots.complaint();
    }
    return "there are no figures, since python3 with matplotlib is not here; install python3-matplotlib and "
           "run the "
           "same command again, which measures nothing twice";
}

/// Runs the chosen experiments that are not yet complete.
class Runs {
public:
    Runs(std::vector<const Experiment*> list, Circumstances here)
        : list_(std::move(list)), here_(std::move(here))
    {
    }

    /// False if it was interrupted.
    bool all()
    {
        for (std::size_t k = 0; k < list_.size(); ++k) {
            const std::string name =
                "[" + std::to_string(k + 1) + "/" + std::to_string(list_.size()) + "] " + list_[k]->id;
            const ExperimentPlan plan(*list_[k], here_);
            if (plan.finished()) {
                ++repeated_;
                std::printf("%s: done before\n", name.c_str());
            } else if (!one(plan, name)) {
                return false;
            }
            ++done_;
        }
        return true;
    }

    std::size_t done() const { return done_; }
    std::size_t repeated() const { return repeated_; }

private:
    bool one(const ExperimentPlan& plan, const std::string& name)
    {
        const auto start = std::chrono::steady_clock::now();
        std::unique_ptr<Progress> progress;
        try {
            if (here_.interrupted()) return false;
            plan.run([&](std::size_t done, std::size_t cases, const std::string& note) {
                if (!progress) progress = std::make_unique<Progress>(cases, false, "case");
                progress->update(done, name + ": " + note);
            });
        } catch (const Interruption&) {
            return false;
        }
        progress.reset();
        std::printf("%s: %.1f s\n", name.c_str(), seconds_since(start));
        std::fflush(stdout);
        return true;
    }

    std::vector<const Experiment*> list_;
    Circumstances here_;
    std::size_t done_ = 0, repeated_ = 0;
};

/// The report of all completed experiments in the folder, from this run or earlier ones. Prints what is
/// missing.
void report(const Circumstances& here)
{
    std::vector<Json> documents;
    for (const Experiment& experiment : experiments())
        if (auto document = ExperimentPlan(experiment, here).finished())
            documents.push_back(std::move(*document));
    std::vector<std::string> notes;
    if (here.quick)
        notes.emplace_back(
            "A quick run: small sizes and few frames, to see that everything works; its speeds are no "
            "measurement.");
    const std::string no_figures = draw_figures(here.out, documents);
    if (!no_figures.empty()) {
        notes.push_back(no_figures);
        std::fprintf(stderr, "warning: %s\n", no_figures.c_str());
    }
    write_report(here.out, documents, notes);
}

}  // namespace

int reproduce_command(const ReproduceOptions& options)
{
    const auto list = chosen(options);
    if (options.list) {
        for (const Experiment* experiment : list)
            std::printf("%-14s %s, %s: %s\n", experiment->id.c_str(), experiment->paper.c_str(),
                        experiment->item.c_str(), experiment->title.c_str());
        return 0;
    }
    Circumstances here;
    here.quick = options.quick;
    here.out = options.out;
    here.meshes = options.meshes;
    here.interrupted = [] { return InterruptGuard::signal_number() != 0; };
    if (!options.meshes.empty() && !std::filesystem::is_directory(here.meshes))
        throw Error(ErrorKind::bad_input, "--meshes '" + options.meshes + "' is no folder");
    make_folders(here.out);

    const InterruptGuard guard;
    const auto start = std::chrono::steady_clock::now();
    Runs runs(list, here);
    const bool all = runs.all();
    report(here);
    std::printf("%zu of %zu experiments, %zu of them done before, %.0f s: %s\n", runs.done(), list.size(),
                runs.repeated(), seconds_since(start), (here.out / "report.html").string().c_str());
    if (all) return 0;
    std::fprintf(stderr, "interrupted; the same command goes on with the experiment that was cut off\n");
    return 128 + InterruptGuard::signal_number();
}

}  // namespace pliant::tool
