#include "experiment.hpp"

#include <algorithm>

#include "embedded_texts.hpp"
#include "pliant/error.hpp"

namespace pliant::tool::reproduce {
namespace {

Json parsed(const char* text)
{
    return Json::parse(text, nullptr, true, true);  // with comments
}

Machine machine_of(const std::string& name)
{
    for (const Machine machine : {Machine::serial, Machine::cpu, Machine::vulkan, Machine::best})
        if (name == name_of(machine)) return machine;
    throw Error(ErrorKind::bad_usage, "experiments.json: unknown machine " + name);
}

TwoNumbers two_numbers(const Json& data, const char* key, TwoNumbers otherwise)
{
    if (!data.contains(key)) return otherwise;
    return {data[key].at("full").get<double>(), data[key].at("quick").get<double>()};
}

/// Replaces names of sets by the sets.
std::vector<std::string> overrides_of(const Json& list, const Json& sets)
{
    std::vector<std::string> overrides;
    for (const std::string each : list) {
        if (each.front() != '@')
            overrides.push_back(each);
        else
            for (const std::string& part : overrides_of(sets.at(each.substr(1)), sets))
                overrides.push_back(part);
    }
    return overrides;
}

AxisValue axis_value(const Json& data, const Json& sets)
{
    AxisValue value;
    value.label = data.at("label");
    value.key = data.value("key", value.label);
    value.set = overrides_of(data.at("set"), sets);
    value.quick = data.value("quick", true);
    value.mesh = data.value("mesh", "");
    if (data.contains("fit_height")) value.mesh_height = data["fit_height"].get<double>();
    if (data.contains("only"))
        value.only = data["only"].get<std::map<std::string, std::vector<std::string>>>();
    if (data.contains("instead")) {
        value.instead = std::make_shared<AxisValue>(axis_value(data["instead"], sets));
        value.instead->key = value.key;
    }
    return value;
}

Axis axis_of(const Json& data, const Json& sets)
{
    Axis axis;
    axis.name = data.at("name");
    axis.mean = data.value("mean", false);
    if (data.contains("values"))
        for (const Json& value : data["values"]) axis.values.push_back(axis_value(value, sets));
    else
        for (const Json& number : data.at("numbers")) {
            AxisValue value;
            value.label = value.key = number.dump();
            for (std::string each : data.at("set")) {
                const auto at = each.find("{}");
                each.replace(at, 2, value.label);
                value.set.push_back(each);
            }
            const Json& quick = data.contains("quick") ? data["quick"] : data["numbers"];
            value.quick = std::find(quick.begin(), quick.end(), number) != quick.end();
            axis.values.push_back(value);
        }
    return axis;
}

ExperimentKind kind_of(const std::string& name)
{
    if (name == "speed") return ExperimentKind::speed;
    if (name == "behaviour") return ExperimentKind::behaviour;
    if (name == "stability") return ExperimentKind::stability;
    if (name == "passes") return ExperimentKind::passes;
    throw Error(ErrorKind::bad_usage, "experiments.json: unknown kind '" + name + "'");
}

Experiment experiment_of(const Json& data, const Json& sets)
{
    Experiment e;
    e.data = data;
    e.id = data.at("id");
    e.paper = data.at("paper");
    e.item = data.at("item");
    e.title = data.at("title");
    e.kind = kind_of(data.at("kind"));
    e.setting = data.at("setting");
    e.differs = data.at("differs");
    if (e.kind == ExperimentKind::passes) return e;
    e.scene = data.at("scene");
    if (data.contains("set")) e.set = overrides_of(data["set"], sets);
    for (const Json& axis : data.at("axes")) e.axes.push_back(axis_of(axis, sets));
    for (const std::string name : data.at("machines")) e.machines.push_back(machine_of(name));
    e.frames = two_numbers(data, "frames", {});
    constexpr double as_long_as_it_takes = 1e9;  // s
    e.seconds = two_numbers(data, "seconds", {as_long_as_it_takes, as_long_as_it_takes});
    e.software_nodes = two_numbers(data, "software_nodes", {1.1e6, 7e4});
    e.batch = data.value("batch", std::uint64_t{0});
    if (data.contains("rest_above")) e.rest_above = data["rest_above"].get<double>();
    if (data.contains("stability")) {
        const Json& rule = data["stability"];
        e.stability.duration = two_numbers(rule, "duration", {});
        e.stability.within = two_numbers(rule, "within", {});
        e.stability.stretch_at_most = rule.at("stretch_at_most");
        e.stability.timed_at_most = rule.at("timed_at_most");
    }
    if (data.contains("pictures")) {
        e.picture_times[0] = data["pictures"].at("full").get<std::vector<double>>();
        e.picture_times[1] = data["pictures"].at("quick").get<std::vector<double>>();
    }
    e.of_case = data.at("of_case").get<std::vector<std::string>>();
    e.quantities = data.at("quantities").get<std::vector<std::string>>();
    if (data.contains("ratios"))
        for (const Json& ratio : data["ratios"])
            e.ratios.push_back({ratio.at("title"), machine_of(ratio.at("of")), machine_of(ratio.at("over")),
                                ratio.at("quantity")});
    return e;
}

}  // namespace

const char* name_of(Machine machine)
{
    switch (machine) {
        case Machine::serial: return "serial";
        case Machine::cpu: return "cpu";
        case Machine::vulkan: return "vulkan";
        case Machine::best: break;
    }
    return "best";
}

const std::vector<Experiment>& experiments()
{
    static const std::vector<Experiment> all = [] {
        const Json data = parsed(text_experiments);
        std::vector<Experiment> list;
        for (const Json& each : data.at("experiments")) list.push_back(experiment_of(each, data.at("sets")));
        return list;
    }();
    return all;
}

const Json& papers()
{
    static const Json data = parsed(text_papers);
    return data;
}

const char* plots_script() { return text_plots; }

std::vector<Case> Experiment::cases(bool quick, const std::filesystem::path& meshes) const
{
    std::vector<Case> all = {{{}, {}, set, {}, {}}};
    for (const Axis& axis : axes) {
        std::vector<Case> longer;
        for (const Case& before : all)
            for (const AxisValue& given : axis.values) {
                if (quick && !given.quick) continue;
                const bool goes_together =
                    std::all_of(given.only.begin(), given.only.end(), [&](const auto& rule) {
                        for (std::size_t k = 0; k < before.keys.size(); ++k)
                            if (axes[k].name == rule.first)
                                return std::find(rule.second.begin(), rule.second.end(), before.keys[k]) !=
                                       rule.second.end();
                        return true;
                    });
                if (!goes_together) continue;
                const bool has_mesh =
                    given.mesh.empty() || (!meshes.empty() && std::filesystem::exists(meshes / given.mesh));
                const AxisValue& value = has_mesh || !given.instead ? given : *given.instead;
                Case each = before;
                each.labels.push_back(value.label);
                each.keys.push_back(value.key);
                each.set.insert(each.set.end(), value.set.begin(), value.set.end());
                if (!value.mesh.empty()) {
                    each.mesh = value.mesh;
                    each.mesh_height = value.mesh_height;
                }
                longer.push_back(each);
            }
        all = std::move(longer);
    }
    return all;
}

}  // namespace pliant::tool::reproduce
