#include "bench/files.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <nlohmann/json.hpp>

#include "pliant/version.hpp"

namespace pliant::tool {
namespace {

using Json = nlohmann::ordered_json;

/// Seven digits, more than can be measured; null unless finite, since JSON has only finite numbers.
Json number(double value)
{
    if (!std::isfinite(value)) return nullptr;
    char text[32];
    std::snprintf(text, sizeof text, "%.7g", value);
    return std::strtod(text, nullptr);
}

std::string hash_text(std::uint64_t hash)
{
    char text[24];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

Json fields_of(const BenchMachine& machine)
{
    Json f;
    f["pliant"] = PLIANT_VERSION;
    f["machine"] = machine.name;
    f["quick"] = machine.quick;
    return f;
}

/// The fields of a row in the order of both files; null for fields that do not apply.
Json fields_of(const BenchRow& row)
{
    const auto optional = [](const std::optional<double>& value) {
        return value ? number(*value) : Json(nullptr);
    };
    Json f;
    f["suite"] = row.suite;
    f["case"] = row.subject;
    f["method"] = row.method;
    f["backend"] = row.backend;
    f["device"] = row.device;
    f["threads"] = row.threads;
    f["nodes"] = row.nodes;
    f["springs"] = row.springs;
    f["triangles"] = row.triangles;
    f["ms_per_step_median"] = row.time ? number(row.time->median) : Json(nullptr);
    f["ms_per_step_min"] = row.time ? number(row.time->least) : Json(nullptr);
    f["ms_per_step_max"] = row.time ? number(row.time->most) : Json(nullptr);
    f["repeats"] = row.time ? Json(row.time->repeats) : Json(nullptr);
    f["ns_per_node_step"] = row.time ? number(row.nanoseconds_per_node()) : Json(nullptr);
    f["bytes_per_node_step"] = row.bytes > 0 ? number(row.bytes) : Json(nullptr);
    f["gigabytes_per_second"] =
        row.time && row.bytes > 0 ? number(row.gigabytes_per_second()) : Json(nullptr);
    f["copy_bandwidth_fraction"] = optional(row.copy_fraction);
    f["ratio_to_serial"] = optional(row.ratio_to_serial);
    f["ratio_to_soft_body"] = optional(row.ratio_to_soft_body);
    f["iterations_mean"] = optional(row.iterations_mean);
    f["iterations_max"] = row.iterations_max ? Json(*row.iterations_max) : Json(nullptr);
    f["max_stretch_peak"] = optional(row.stretch);
    f["volume_error_max"] = optional(row.volume_error);
    f["state_hash"] = row.state_hash ? Json(hash_text(*row.state_hash)) : Json(nullptr);
    f["stiffness_n_per_m"] = number(row.stiffness);
    f["step_seconds"] = number(row.step);
    f["simulated_seconds_per_second"] = number(row.real_time_factor);
    return f;
}

Json fields_of(const Measured& m)
{
    Json f;
    f["measured"] = m.quantity;
    f["value"] = number(m.value);
    f["unit"] = m.unit;
    f["bar"] = m.bar.text();
    f["verdict"] = m.bar.verdict_on(m.value);
    f["remark"] = m.remark;
    return f;
}

void write_line(std::ostream& out, std::size_t row_index, std::span<const Json> parts)
{
    out << row_index;
    for (const Json& fields : parts)
        for (const Json& value : fields) {
            out << ',';
            if (value.is_null()) continue;
            if (!value.is_string()) {
                out << value.dump();
                continue;
            }
            const std::string text = value.get<std::string>();
            if (text.find_first_of(",\"\n") == std::string::npos) {
                out << text;
                continue;
            }
            out << '"';
            for (const char c : text) out << (c == '"' ? "\"\"" : std::string(1, c));
            out << '"';
        }
    out << '\n';
}

}  // namespace

void write_json(AtomicFile& file, const BenchMachine& machine, std::span<const BenchRow> rows)
{
    Json document = fields_of(machine);
    auto& list = document["rows"] = Json::array();
    for (const BenchRow& row : rows) {
        Json& entry = list.emplace_back(Json::object());
        const Json fields = fields_of(row);
        for (const auto& [key, value] : fields.items())
            if (!value.is_null()) entry[key] = value;
        if (row.measured.empty()) continue;
        Json& numbers = entry["measured"] = Json::array();
        for (const Measured& m : row.measured) numbers.push_back(fields_of(m));
    }
    file.stream() << document.dump(2) << '\n';
    file.commit();
}

void write_csv(AtomicFile& file, const BenchMachine& machine, std::span<const BenchRow> rows)
{
    std::ostream& out = file.stream();
    out << "row";
    for (const Json& fields : {fields_of(BenchRow{}), fields_of(Measured{}), fields_of(machine)})
        for (const auto& [key, value] : fields.items()) out << ',' << key;
    out << '\n';
    Json nothing = fields_of(Measured{});
    for (Json& value : nothing) value = nullptr;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        std::array parts = {fields_of(rows[k]), nothing, fields_of(machine)};
        if (rows[k].measured.empty()) write_line(out, k, parts);
        for (const Measured& m : rows[k].measured) {
            parts[1] = fields_of(m);
            write_line(out, k, parts);
        }
    }
    file.commit();
}

}  // namespace pliant::tool
