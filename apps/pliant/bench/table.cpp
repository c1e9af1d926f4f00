#include "bench/table.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <tuple>
#include <vector>

#include "pliant/error.hpp"

namespace pliant::tool {
namespace {

std::string text_of(const char* format, double value)
{
    char text[48];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string text_of(const char* format, const std::optional<double>& value, double scale = 1)
{
    return value ? text_of(format, scale * *value) : "";
}

std::string threads_text(const BenchRow& row)
{
    return row.threads > 0 ? std::to_string(row.threads) : "";  // empty for a device
}

bool same_case(const BenchRow& a, const BenchRow& b)
{
    const auto key = [](const BenchRow& row) {
        return std::tie(row.suite, row.subject, row.method, row.device, row.threads, row.nodes, row.springs,
                        row.stiffness, row.step, row.stretch, row.state_hash);
    };
    return key(a) == key(b);
}

}  // namespace

bool Bar::met_by(double measured) const
{
    switch (kind) {
        case Kind::at_most: return measured <= value;
        case Kind::at_least: return measured >= value;
        case Kind::none: break;
    }
    return true;
}

std::string Bar::text() const
{
    return kind == Kind::none ? "" : (kind == Kind::at_most ? "<= " : ">= ") + text_of("%.4g", value);
}

const char* Bar::verdict_on(double measured) const
{
    return kind == Kind::none ? "" : met_by(measured) ? "met" : "missed";
}

double median_of(std::vector<double> values)
{
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

StepTime step_time_of(std::span<const double> milliseconds)
{
    if (milliseconds.empty()) return {};
    const auto [least, most] = std::minmax_element(milliseconds.begin(), milliseconds.end());
    return {median_of({milliseconds.begin(), milliseconds.end()}), *least, *most, milliseconds.size()};
}

double BenchRow::nanoseconds_per_node() const
{
    return 1e6 * time->median / static_cast<double>(std::max<std::uint64_t>(nodes, 1));
}

double BenchRow::gigabytes_per_second() const { return bytes / nanoseconds_per_node(); }

BenchRow BenchTable::row(Simulation& simulation, const std::string& subject, double stiffness,
                         std::optional<double> stretch) const
{
    const Report& report = simulation.report();
    if (report.device_lost) throw Error(ErrorKind::device_failure, subject + ": " + report.failure);
    BenchRow row;
    row.suite = suite_;
    row.subject = subject;
    row.method = name_of(simulation.scene().method);
    row.backend = name_of(simulation.backend());
    row.device = simulation.device_name();
    row.threads = simulation.thread_count();
    row.nodes = simulation.node_count();
    row.springs = simulation.spring_count();
    row.triangles = simulation.triangle_count();
    row.stiffness = stiffness;
    row.step = simulation.step_length();
    row.real_time_factor = report.simulated_seconds / std::max(report.wall_seconds, 1e-9);
    row.stretch = stretch;
    if (report.solver.used()) {
        row.iterations_mean = report.solver.iterations_mean;
        row.iterations_max = report.solver.iterations_max;
    }
    if (!report.bodies.empty()) row.volume_error = report.volume.error_max;
    row.state_hash = simulation.state_hash();
    return row;
}

void BenchTable::add(BenchRow row)
{
    row.remark.clear();
    rows_.push_back(std::move(row));
}

void BenchTable::add(const BenchRow& row, const std::string& quantity, double value, const std::string& unit,
                     Bar bar)
{
    if (rows_.empty() || !same_case(rows_.back(), row)) add(row);
    rows_.back().measured.push_back({quantity, unit, value, bar, row.remark});
}

namespace {

struct Column {
    const char* title;
    bool words;
    std::function<std::string(const BenchRow&)> text;
};

const std::vector<Column>& columns()
{
    static const std::vector<Column> all = {
        {"case", true, [](const BenchRow& r) { return r.subject; }},
        {"method", true, [](const BenchRow& r) { return r.method; }},
        {"backend", true, [](const BenchRow& r) { return r.backend; }},
        {"threads", false, threads_text},
        {"nodes", false, [](const BenchRow& r) { return std::to_string(r.nodes); }},
        {"springs", false, [](const BenchRow& r) { return std::to_string(r.springs); }},
        {"ms/step", false, [](const BenchRow& r) { return r.time ? text_of("%.4g", r.time->median) : ""; }},
        {"(least, most)", false,
         [](const BenchRow& r) {
             return r.time ? '(' + text_of("%.3g", r.time->least) + ", " + text_of("%.3g", r.time->most) + ')'
                           : "";
         }},
        {"ns/node", false,
         [](const BenchRow& r) { return r.time ? text_of("%.4g", r.nanoseconds_per_node()) : ""; }},
        {"B/node", false, [](const BenchRow& r) { return r.bytes > 0 ? text_of("%.4g", r.bytes) : ""; }},
        {"GB/s", false,
         [](const BenchRow& r) {
             return r.time && r.bytes > 0 ? text_of("%.3g", r.gigabytes_per_second()) : "";
         }},
        {"of copy", false, [](const BenchRow& r) { return text_of("%.2f", r.copy_fraction); }},
        {"x serial", false, [](const BenchRow& r) { return text_of("%.2f", r.ratio_to_serial); }},
        {"x Bullet", false, [](const BenchRow& r) { return text_of("%.1f", r.ratio_to_soft_body); }},
        {"iterations", false, [](const BenchRow& r) { return text_of("%.1f", r.iterations_mean); }},
        {"stiffness N/m", false, [](const BenchRow& r) { return text_of("%g", r.stiffness); }},
        {"step ms", false, [](const BenchRow& r) { return text_of("%.4g", 1000 * r.step); }},
        {"simulated s/s", false, [](const BenchRow& r) { return text_of("%.3g", r.real_time_factor); }},
        {"max stretch %", false, [](const BenchRow& r) { return text_of("%.3g", r.stretch, 100); }},
        {"volume off", false, [](const BenchRow& r) { return text_of("%.2g", r.volume_error); }},
    };
    return all;
}

using Line = std::vector<std::string>;

/// Columns as wide as their contents; `words` are left-aligned, the others right-aligned.
void print_lines(const std::vector<Line>& lines, const std::vector<bool>& words)
{
    std::vector<std::size_t> widths(lines.front().size());
    for (const Line& line : lines)
        for (std::size_t k = 0; k < line.size(); ++k) widths[k] = std::max(widths[k], line[k].size());
    for (const Line& line : lines) {
        std::string text;
        for (std::size_t k = 0; k < line.size(); ++k) {
            const std::string padding(widths[k] - line[k].size(), ' ');
            text += (k > 0 ? "  " : "") + (words[k] ? line[k] + padding : padding + line[k]);
        }
        text.erase(text.find_last_not_of(' ') + 1);
        std::printf("%s\n", text.c_str());
    }
}

}  // namespace

void print_suite(const std::string& suite, std::span<const BenchRow> rows)
{
    std::vector<const BenchRow*> of_suite;
    for (const BenchRow& row : rows)
        if (row.suite == suite) of_suite.push_back(&row);
    std::printf("%s: %zu rows\n", suite.c_str(), of_suite.size());
    if (of_suite.empty()) return;

    std::vector<Line> lines(of_suite.size() + 1);
    std::vector<bool> words;
    for (const Column& column : columns()) {
        Line cells;
        for (const BenchRow* row : of_suite) cells.push_back(column.text(*row));
        if (std::all_of(cells.begin(), cells.end(), [](const std::string& cell) { return cell.empty(); }))
            continue;
        words.push_back(column.words);
        lines[0].push_back(column.title);
        for (std::size_t k = 0; k < cells.size(); ++k) lines[k + 1].push_back(cells[k]);
    }
    print_lines(lines, words);

    lines = {{"case", "nodes", "threads", "measured", "value", "unit", "bar", "", ""}};
    for (const BenchRow* row : of_suite)
        for (const Measured& m : row->measured)
            lines.push_back({row->subject, std::to_string(row->nodes), threads_text(*row), m.quantity,
                             text_of("%.4g", m.value), m.unit, m.bar.text(), m.bar.verdict_on(m.value),
                             m.remark});
    std::printf("\n");
    if (lines.size() > 1) {
        print_lines(lines, {true, false, false, true, false, true, true, true, true});
        std::printf("\n");
    }
    std::fflush(stdout);
}

}  // namespace pliant::tool
