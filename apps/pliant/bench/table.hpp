// What `pliant bench` reports: rows of a table. A row is a case on a backend: what was stepped, how long a
// step took, what came of it; and other numbers that the case measured, each beside the bar that it is held
// against.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pliant/simulation.hpp"

namespace pliant::tool {

/// What is asked of a number.
struct Bar {
    enum class Kind { none, at_most, at_least };
    Kind kind = Kind::none;
    double value = 0;

    bool met_by(double measured) const;
    std::string text() const;                       ///< as ">= 20"; empty without a bar
    const char* verdict_on(double measured) const;  ///< "met", "missed", or empty without a bar
};
constexpr Bar at_most(double value) { return {Bar::Kind::at_most, value}; }
constexpr Bar at_least(double value) { return {Bar::Kind::at_least, value}; }

/// A number beside those that every row has.
struct Measured {
    std::string quantity, unit;
    double value = 0;
    Bar bar;
    std::string remark;
};

/// Of the steps of a case, ms.
struct StepTime {
    double median = 0, least = 0, most = 0;
    std::size_t repeats = 0;
};
StepTime step_time_of(std::span<const double> milliseconds);
double median_of(std::vector<double> values);

struct BenchRow {
    // What was stepped, and by what.
    std::string suite, subject, method, backend, device;
    unsigned threads = 0;
    std::uint64_t nodes = 0, springs = 0, triangles = 0;
    double stiffness = 0;     ///< N/m, the largest
    double step = 0;          ///< s
    std::string series = {};  ///< that it is a point of in the plot; empty: its subject
    bool in_plot = true;      ///< its time is one of several sizes
    // How fast.
    std::optional<StepTime> time;
    double bytes =
        0;  ///< per node and step, that have to move when each value is fetched once; 0: not counted
    std::optional<double> copy_fraction;       ///< of the bandwidth of copying on this device, in this run
    std::optional<double> ratio_to_serial;     ///< its time over this one
    std::optional<double> ratio_to_soft_body;  ///< of Bullet, the same
    double real_time_factor = 0;               ///< simulated seconds per wall second
    // What came of it.
    std::optional<double> iterations_mean;  ///< linear iterations per step
    std::optional<std::uint32_t> iterations_max;
    std::optional<double> stretch;       ///< largest ever, (l - l0) / l0
    std::optional<double> volume_error;  ///< largest ever, abs(V / V_target - 1)
    std::optional<std::uint64_t> state_hash;
    // And else.
    std::vector<Measured> measured = {};
    std::string remark = {};  ///< on the next number that is added

    double nanoseconds_per_node() const;  ///< and step; needs `time`
    double gigabytes_per_second() const;  ///< needs `time` and `bytes`
};

/// What cases put their rows into.
class BenchTable {
public:
    /// A row as the simulation that was measured tells it; `stiffness` in N/m. Throws Error(device_failure)
    /// when the device was lost.
    BenchRow row(Simulation& simulation, const std::string& subject, double stiffness,
                 std::optional<double> stretch) const;
    /// A row by itself.
    void add(BenchRow row);
    /// A number of a row, which is added first unless it is the last one already.
    void add(const BenchRow& row, const std::string& quantity, double value, const std::string& unit,
             Bar bar = {});

    void begin_suite(const std::string& suite) { suite_ = suite; }
    const std::string& suite() const { return suite_; }
    std::span<const BenchRow> rows() const { return rows_; }

private:
    std::string suite_;
    std::vector<BenchRow> rows_;
};

/// Prints the rows of a suite; columns that no row fills are left out.
void print_suite(const std::string& suite, std::span<const BenchRow> rows);

}  // namespace pliant::tool
