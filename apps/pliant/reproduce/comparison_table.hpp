// The table of an experiment: our numbers beside the papers'.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiment.hpp"
#include "measurement.hpp"

namespace pliant::tool::reproduce {

/// The experiment's numbers in papers.json.
Json numbers_of(const Experiment& experiment);

/// Columns: the axes, quantities independent of the machine, the papers' series, ours by machine, ratios.
/// Rows: the cases.
class ComparisonTable {
public:
    ComparisonTable(const Experiment& experiment, std::vector<MachineHere> machines);

    /// `measurements`: one per machine.
    void add(const Case& each, const std::vector<Measurement>& measurements);
    /// Adds rows with means over the axis with `mean`, one for each combination of the others.
    void add_means();

    /// An object with `columns` (name, title, unit, source) and `rows` (texts), without empty columns.
    Json json() const;
    /// What was omitted, and why.
    const std::set<std::string>& notes() const { return notes_; }

private:
    void add_column(const std::string& name, const std::string& title, const std::string& unit,
                    const std::string& source);
    const Measurement* of_machine(const std::vector<Measurement>& measurements, Machine machine) const;
    Json mean_of(const std::vector<std::string>& group, std::size_t mean_axis, std::size_t count) const;

    const Experiment& experiment_;
    std::vector<MachineHere> machines_;
    Json numbers_;
    Json columns_ = Json::array(), rows_ = Json::array();
    std::vector<std::vector<std::string>> keys_;
    std::set<std::string> notes_;
};

/// The number in a cell; empty for an empty cell or words.
std::optional<double> number_of(const std::string& cell);
/// A document's table (columns, rows) as CSV.
std::string csv_of(const Json& table);

}  // namespace pliant::tool::reproduce
