// The table of `pliant bench`. A row is a case on a backend: its scene, the time of a step, and the results;
// and further measured numbers, each with its bar.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pliant/simulation.hpp"

namespace pliant::tool {

/// A bound on a measured number.
struct Bar {
    enum class Kind { none, at_most, at_least };
    Kind kind = Kind::none;
    double value = 0;

    bool met_by(double measured) const;
    std::string text() const;                       ///< for example ">= 20"; empty without a bar
    const char* verdict_on(double measured) const;  ///< "met", "missed", or empty without a bar
};
constexpr Bar at_most(double value) { return {Bar::Kind::at_most, value}; }
constexpr Bar at_least(double value) { return {Bar::Kind::at_least, value}; }

/// A number beyond those that every row has.
struct Measured {
    std::string quantity, unit;
    double value = 0;
    Bar bar;
    std::string remark;
};

/// Time of a case's steps, ms.
struct StepTime {
    double median = 0, least = 0, most = 0;
    std::size_t repeats = 0;
};
StepTime step_time_of(std::span<const double> milliseconds);
double median_of(std::vector<double> values);

struct BenchRow {
    // What was stepped, and on what.
    std::string suite, subject, method, backend, device;
    unsigned threads = 0;
    std::uint64_t nodes = 0, springs = 0, triangles = 0;
    double stiffness = 0;     ///< N/m, the largest
    double step = 0;          ///< s
    std::string series = {};  ///< its series in the plot; empty: its subject
    bool in_plot = true;      ///< its time is plotted as one of several sizes
    // Speed.
    std::optional<StepTime> time;
    double bytes = 0;  ///< per node and step, if each value is read and written once; 0: not counted
    std::optional<double> copy_fraction;       ///< fraction of the copy bandwidth on this device, in this run
    std::optional<double> ratio_to_serial;     ///< serial's time over this one
    std::optional<double> ratio_to_soft_body;  ///< Bullet's time over this one
    double real_time_factor = 0;               ///< simulated seconds per wall second
    // Results.
    std::optional<double> iterations_mean;  ///< linear iterations per step
    std::optional<std::uint32_t> iterations_max;
    std::optional<double> stretch;       ///< maximum over the run, (l - l0) / l0
    std::optional<double> volume_error;  ///< maximum over the run, abs(V / V_target - 1)
    std::optional<std::uint64_t> state_hash;
    // Further numbers.
    std::vector<Measured> measured = {};
    std::string remark = {};  ///< remark for the next number that is added

    double nanoseconds_per_node() const;  ///< per step; needs `time`
    double gigabytes_per_second() const;  ///< needs `time` and `bytes`
};

/// The table to which cases add their rows.
class BenchTable {
public:
    /// A row filled from a simulation; `stiffness` in N/m. Throws Error(device_failure) if the device was
    /// lost.
    BenchRow row(Simulation& simulation, const std::string& subject, double stiffness,
                 std::optional<double> stretch) const;
    /// Adds a row.
    void add(BenchRow row);
    /// Adds a number to a row; adds the row first unless it is already the last one.
    void add(const BenchRow& row, const std::string& quantity, double value, const std::string& unit,
             Bar bar = {});

    void begin_suite(const std::string& suite) { suite_ = suite; }
    const std::string& suite() const { return suite_; }
    std::span<const BenchRow> rows() const { return rows_; }

private:
    std::string suite_;
    std::vector<BenchRow> rows_;
};

/// Prints the rows of a suite without empty columns.
void print_suite(const std::string& suite, std::span<const BenchRow> rows);

}  // namespace pliant::tool
