#include "comparison_table.hpp"

#include <algorithm>
#include <cstdlib>

namespace pliant::tool::reproduce {
namespace {

/// The papers' numbers with their own columns: series and quantity.
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

/// Whether the serial baseline has this quantity.
bool is_of_serial(const std::string& quantity)
{
    return quantity == "frames_per_second" || quantity == "frames";
}

}  // namespace

Json numbers_of(const Experiment& experiment)
{
    const Json& numbers = papers().at("numbers");
    return numbers.contains(experiment.id) ? numbers[experiment.id] : Json::array();
}

ComparisonTable::ComparisonTable(const Experiment& experiment, std::vector<MachineHere> machines)
    : experiment_(experiment), machines_(std::move(machines)), numbers_(numbers_of(experiment))
{
    for (const Axis& axis : experiment_.axes) add_column(axis.name, axis.name, "", "case");
    for (const std::string& name : experiment_.of_case) {
        const Quantity& quantity = quantity_of(name);
        add_column(name, quantity.title, quantity.unit, "case");
    }
    for (const auto& series : their_series(numbers_)) {
        if (series.second == "ratio") {
            add_column(series.second, series.first, "", "theirs");
            continue;
        }
        const Quantity& quantity = quantity_of(series.second);
        add_column(series.second, series.first + ": " + quantity.title, quantity.unit, "theirs");
    }
    for (const MachineHere& machine : machines_)
        for (const std::string& name : experiment_.quantities) {
            if (machine.machine == Machine::serial && !is_of_serial(name)) continue;
            const Quantity& quantity = quantity_of(name);
            const std::string who = machine.machine == Machine::best ? "ours" : machine.title;
            add_column(name, who + ": " + quantity.title, quantity.unit, who);
        }
    for (const Ratio& ratio : experiment_.ratios) add_column("ratio", ratio.title, "", "ratio");
}

void ComparisonTable::add_column(const std::string& name, const std::string& title, const std::string& unit,
                                 const std::string& source)
{
    columns_.push_back({{"name", name}, {"title", title}, {"unit", unit}, {"source", source}});
}

void ComparisonTable::add(const Case& each, const std::vector<Measurement>& measurements)
{
    Json cells = Json::array();
    for (const std::string& label : each.labels) cells.push_back(label);
    const auto described = std::find_if(measurements.begin(), measurements.end(),
                                        [](const Measurement& m) { return m.measured; });
    for (const std::string& name : experiment_.of_case)
        cells.push_back(described != measurements.end() ? quantity_of(name).text(*described) : "");
    for (const auto& series : their_series(numbers_))
        cells.push_back(their_number(numbers_, series, experiment_.axes, each.keys));
    for (std::size_t k = 0; k < machines_.size(); ++k) {
        const Measurement& m = measurements[k];
        for (const std::string& name : experiment_.quantities)
            if (machines_[k].machine != Machine::serial || is_of_serial(name))
                cells.push_back(m.absent.empty() ? quantity_of(name).text(m) : "");
        if (!m.absent.empty()) notes_.insert(machines_[k].title + ": " + m.absent);
    }
    for (const Ratio& ratio : experiment_.ratios) {
        const Measurement* of = of_machine(measurements, ratio.of);
        const Measurement* over = of_machine(measurements, ratio.over);
        const bool both = of && over && of->absent.empty() && over->absent.empty();
        cells.push_back(both ? number_text(of->frames_per_second / over->frames_per_second) : "");
    }
    keys_.push_back(each.keys);
    rows_.push_back(std::move(cells));
}

void ComparisonTable::add_means()
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
        for (const auto& group : groups) rows_.push_back(mean_of(group, mean_axis, count));
    }
}

/// Null if any case of the group has no number in the column.
Json ComparisonTable::mean_of(const std::vector<std::string>& group, std::size_t mean_axis,
                              std::size_t count) const
{
    Json cells = Json::array();
    for (const std::string& key : group) cells.push_back(key);
    const auto series = their_series(numbers_);
    std::size_t their_column = 0;
    for (std::size_t column = group.size(); column < columns_.size(); ++column) {
        const std::string source = columns_[column]["source"];
        if (source == "theirs") {
            cells.push_back(their_number(numbers_, series[their_column++], experiment_.axes, group));
            continue;
        }
        double sum = 0;
        std::size_t cases = 0, values = 0;
        for (std::size_t r = 0; r < count; ++r) {
            auto other = keys_[r];
            other[mean_axis] = "mean";
            if (other != group) continue;
            ++cases;
            if (const auto value = number_of(rows_[r][column])) {
                sum += *value;
                ++values;
            }
        }
        const bool is_meant = source != "case" && columns_[column]["name"] != "frames" && values == cases;
        cells.push_back(is_meant ? number_text(sum / static_cast<double>(values)) : "");
    }
    return cells;
}

const Measurement* ComparisonTable::of_machine(const std::vector<Measurement>& measurements,
                                               Machine machine) const
{
    for (std::size_t k = 0; k < machines_.size(); ++k)
        if (machines_[k].machine == machine) return &measurements[k];
    return nullptr;
}

Json ComparisonTable::json() const
{
    Json columns = Json::array(), rows = Json::array();
    std::vector<std::size_t> kept;
    for (std::size_t c = 0; c < columns_.size(); ++c)
        if (std::any_of(rows_.begin(), rows_.end(), [c](const Json& row) {
                return !(row[c].is_string() && row[c].get<std::string>().empty());
            }))
            kept.push_back(c);
    for (const std::size_t c : kept) columns.push_back(columns_[c]);
    for (const Json& row : rows_) {
        Json& cells = rows.emplace_back(Json::array());
        for (const std::size_t c : kept) cells.push_back(row[c]);
    }
    return {{"columns", columns}, {"rows", rows}};
}

std::optional<double> number_of(const std::string& cell)
{
    char* end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    if (cell.empty() || *end != '\0') return std::nullopt;
    return value;
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
