#include "viewer/panel.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pliant::tool {
namespace {

const ImVec4 warning_colour{0.95f, 0.42f, 0.10f, 1.0f};

/// Sliders for a scene's numbers, as doubles with units; sets `changed` if one was moved.
class Sliders {
public:
    bool changed = false;

    void number(const char* name, double& value, double least, double most, const char* format,
                bool by_decades = false)
    {
        const int flags = by_decades ? ImGuiSliderFlags_Logarithmic : 0;
        ImGui::SetNextItemWidth(150);
        changed |= ImGui::SliderScalar(name, ImGuiDataType_Double, &value, &least, &most, format,
                                       flags | ImGuiSliderFlags_AlwaysClamp);
    }
    void whole(const char* name, std::uint32_t& value, std::uint32_t least, std::uint32_t most,
               const char* format)
    {
        ImGui::SetNextItemWidth(150);
        changed |= ImGui::SliderScalar(name, ImGuiDataType_U32, &value, &least, &most, format,
                                       ImGuiSliderFlags_AlwaysClamp);
    }
    void vector(const char* name, Vec3d& value, double least, double most, const char* format)
    {
        double numbers[3] = {value.x, value.y, value.z};
        ImGui::SetNextItemWidth(210);
        if (!ImGui::SliderScalarN(name, ImGuiDataType_Double, numbers, 3, &least, &most, format)) return;
        value = {numbers[0], numbers[1], numbers[2]};
        changed = true;
    }
    void flag(const char* name, bool& value) { changed |= ImGui::Checkbox(name, &value); }
};

void spring_sliders(Sliders& sliders, const char* name, SpringParameters& springs, Method method)
{
    ImGui::PushID(name);
    ImGui::TextUnformatted(name);
    sliders.number("stiffness", springs.stiffness, 0, 1e6, "%.4g N/m", true);
    sliders.number("damping", springs.damping, 0, 1e3, "%.3g N s/m", true);
    if (method == Method::constraint) {
        sliders.number("limit", springs.limit, 0, 1, "%.3f of length");
        sliders.number("compliance", springs.compliance, 1e-9, 1, "%.2e m/N", true);
    }
    ImGui::PopID();
}

void cloth_sliders(Sliders& sliders, Cloth& cloth, Method method)
{
    spring_sliders(sliders, cloth.is_body() ? "springs" : "structural", cloth.springs.structural, method);
    if (!cloth.is_body()) {
        if (std::holds_alternative<SheetOptions>(cloth.shape))
            spring_sliders(sliders, "shear", cloth.springs.shear, method);
        spring_sliders(sliders, "bend", cloth.springs.bend, method);
    }
    sliders.number("air damping", cloth.damping, 0, 20, "%.3g 1/s", true);
    sliders.number("thickness", cloth.thickness, 0, 0.05, "%.4f m");
    if (!cloth.is_body()) return;
    VolumeOptions& volume = cloth.body->volume;
    double target = volume.target.empty() ? 1 : volume.target.back().value;
    double pressure = volume.pressure.empty() ? 0 : volume.pressure.back().value;
    sliders.flag("keeps its volume", volume.constraint);
    Sliders moved;
    moved.number("target volume", target, 0.1, 4, "%.3f V0");
    if (moved.changed) volume.target = {{0, target}};
    sliders.changed |= moved.changed;
    moved.changed = false;
    moved.number("pressure", pressure, -5000, 5000, "%.0f Pa");
    if (moved.changed) volume.pressure = {{0, pressure}};
    sliders.changed |= moved.changed;
    sliders.number("tolerance", volume.tolerance, 1e-7, 1, "%.1e", true);
}

void solver_sliders(Sliders& sliders, Scene& scene)
{
    int solver = static_cast<int>(scene.solver);
    ImGui::SetNextItemWidth(150);
    if (ImGui::Combo("solver", &solver, "newton_multigrid\0paper\0")) {
        scene.solver = static_cast<Solver>(solver);
        sliders.changed = true;
    }
    if (scene.method == Method::acad) {
        sliders.number("threshold", scene.acad.activate_at, 1e-3, 1, "%.3f of length");
        if (scene.acad.deactivate_at)
            scene.acad.deactivate_at = std::min(*scene.acad.deactivate_at, scene.acad.activate_at);
        sliders.number("compliance", scene.acad.compliance, 1e-9, 1, "%.2e m/N", true);
    }
    if (scene.solver == Solver::paper) {
        sliders.number("tolerance", scene.paper.tolerance, 1e-8, 1, "%.1e", true);
        sliders.whole("iterations", scene.paper.max_iterations, 1, 1000, "%u");
    } else {
        sliders.number("tolerance", scene.newton_multigrid.newton_tolerance, 0, 1, "%.3g", true);
        sliders.whole("Newton", scene.newton_multigrid.newton_iterations, 1, 30, "%u iterations");
        sliders.whole("V-cycles", scene.newton_multigrid.linear_iterations, 1, 60, "%u");
    }
}

double& friction_of(Collider& collider)
{
    return std::visit([](auto& shape) -> double& { return shape.friction; }, collider);
}

}  // namespace

Panel::Panel() : scenes_(list_scenes()) {}

void Panel::draw(Session& session, View& view)
{
    if (view.help) draw_help(view);
    if (!view.panel) return;
    ImGui::SetNextWindowPos({8, 8}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize({336, 0}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSizeConstraints({200, 60},
                                        {600, std::max(100.0f, ImGui::GetIO().DisplaySize.y - 16)});
    if (ImGui::Begin("pliant", nullptr, ImGuiWindowFlags_NoFocusOnAppearing)) {
        draw_state(session, view);
        draw_scene(session, view);
        if (ImGui::CollapsingHeader("Parameters")) draw_parameters(session);
        if (ImGui::CollapsingHeader("Plots")) draw_plots(session);
        if (ImGui::CollapsingHeader("Passes")) draw_passes(session);
        if (ImGui::CollapsingHeader("Overlays")) draw_overlays(view);
    }
    ImGui::End();
}

void Panel::draw_state(Session& session, View& view)
{
    const Simulation& simulation = session.simulation();
    const Report& report = session.report();
    ImGui::Text("%s  %.2f s  %s", simulation.scene().name.c_str(), session.time(),
                session.paused ? "paused" : "");
    ImGui::Text("%llu nodes, %s", static_cast<unsigned long long>(simulation.node_count()),
                name_of(simulation.backend()));
    ImGui::Text("%.2f x real time, %u steps of %.3g ms", session.real_time_factor(),
                simulation.steps_per_frame(), 1000 * simulation.step_length());
    if (session.is_behind()) ImGui::TextColored(warning_colour, "slower than real time");
    const FrameCost cost = view.cost.median();
    ImGui::Text("frame %.1f ms: steps %.2f, driver %.2f,", cost.whole, cost.simulation, cost.driver);
    ImGui::Text("viewer %.2f ms", cost.own);
    if (view.recording) ImGui::TextColored(warning_colour, "recording");
    ImGui::PushTextWrapPos(320);
    const auto offer_reset = [&](const char* name) {
        if (ImGui::SmallButton(name)) view.wants_reset = true;
    };
    const Method method = simulation.scene().method;
    if (simulation.step_length() > simulation.stable_step() && method != Method::constraint) {
        // For ACAD the solver keeps it stable nevertheless.
        ImGui::TextColored(warning_colour, "the step of %.3g ms exceeds the largest safe one of %.3g ms%s",
                           1000 * simulation.step_length(), 1000 * simulation.stable_step(),
                           method == Method::acad ? ": springs are taken softer" : "");
        offer_reset("Reset##unstable");
    }
    if (!report.finite) {
        ImGui::TextColored(warning_colour, "diverged in frame %llu: node %llu is no longer finite",
                           static_cast<unsigned long long>(report.bad_frame),
                           static_cast<unsigned long long>(report.bad_node));
        offer_reset("Reset##diverged");
    }
    if (!report.solver.last_is_solved())
        ImGui::TextColored(warning_colour, "the last step is not solved: residual %.2g",
                           report.solver.residual_last);
    if (report.device_lost) ImGui::TextColored(warning_colour, "stopped: %s", report.failure.c_str());
    if (!session.notice.empty()) ImGui::TextColored(warning_colour, "%s", session.notice.c_str());
    ImGui::PopTextWrapPos();
    if (ImGui::Button(session.paused ? "Run" : "Pause")) session.paused = !session.paused;
    ImGui::SameLine();
    if (ImGui::Button("Step")) session.step_once();
    ImGui::SameLine();
    if (ImGui::Button("Reset")) view.wants_reset = true;
    ImGui::SameLine();
    if (ImGui::Button("Help")) view.help = !view.help;
}

void Panel::draw_scene(Session& session, View& view)
{
    ImGui::SetNextItemWidth(200);
    if (ImGui::BeginCombo("scene", session.scene().name.c_str())) {
        for (const SceneListing& scene : scenes_)
            if (ImGui::Selectable(scene.name.c_str(), scene.name == session.opened()))
                view.wants_scene = scene.name;
        ImGui::EndCombo();
    }
    int method = static_cast<int>(session.scene().method);
    ImGui::SetNextItemWidth(200);
    if (ImGui::Combo("method", &method, "mass_spring\0constraint\0acad\0volume\0"))
        session.set_method(static_cast<Method>(method));
}

void Panel::draw_parameters(Session& session)
{
    Scene& scene = session.scene();
    Sliders sliders;
    for (std::size_t c = 0; c < scene.cloth_count(); ++c) {
        Cloth& cloth = *scene.cloth_handle(c);
        ImGui::PushID(static_cast<int>(c));
        if (ImGui::TreeNodeEx("cloth", c == 0 ? ImGuiTreeNodeFlags_DefaultOpen : 0, "%s",
                              cloth.name.c_str())) {
            cloth_sliders(sliders, cloth, scene.method);
            ImGui::TreePop();
        }
        ImGui::PopID();
    }
    if ((scene.method == Method::constraint || scene.method == Method::acad) && ImGui::TreeNode("solver")) {
        solver_sliders(sliders, scene);
        ImGui::TreePop();
    }
    if (ImGui::TreeNode("world")) {
        sliders.vector("gravity m/s2", scene.gravity, -20, 20, "%.2f");
        sliders.vector("wind m/s", scene.air.velocity, -20, 20, "%.1f");
        sliders.number("air density", scene.air.density, 0, 5, "%.2f kg/m3");
        for (std::size_t k = 0; k < scene.colliders.size(); ++k) {
            ImGui::PushID(static_cast<int>(k));
            sliders.number("friction", friction_of(scene.colliders[k]), 0, 2, "%.2f");
            ImGui::PopID();
        }
        ImGui::TreePop();
    }
    if (ImGui::TreeNode("time")) {
        sliders.whole("substeps", scene.time.substeps, 0, 400, "%u (0: as many as it takes)");
        double frame = 1000 / scene.time.frame_rate;
        Sliders moved;
        moved.number("dt of a frame", frame, 1, 50, "%.2f ms");
        if (moved.changed) scene.time.frame_rate = 1000 / frame;
        sliders.changed |= moved.changed;
        Sliders own;  // not part of the scene
        own.number("speed", session.speed, 0.05, 4, "%.2f x", true);
        own.whole("frames at once", session.most_steps, 1, 16, "%u at most");
        own.number("hand", session.hand_stiffness, 1, 1e5, "%.4g N/m", true);
        own.number("hand's damping", session.hand_damping, 0, 1e3, "%.3g N s/m", true);
        ImGui::TreePop();
    }
    if (sliders.changed) session.scene_changed();
}

void Panel::draw_plots(const Session& session)
{
    const auto plot = [&](const char* name, const History& history, const char* format) {
        const std::size_t first = (history.next + History::length - history.count) % History::length;
        for (std::size_t k = 0; k < history.count; ++k)
            unrolled_[k] = history.values[(first + k) % History::length];
        char last[48];
        std::snprintf(last, sizeof last, format, static_cast<double>(history.last()));
        const auto [low, high] =
            std::minmax_element(unrolled_.begin(), unrolled_.begin() + static_cast<long>(history.count));
        const bool any = history.count > 0 && std::isfinite(*low) && std::isfinite(*high);
        ImGui::PlotLines(name, unrolled_.data(), any ? static_cast<int>(history.count) : 0, 0, last,
                         any ? *low : 0, any ? *high : 1, {210, 38});
    };
    const Histories& h = session.histories();
    plot("max stretch", h.max_stretch, "%.3g %%");
    plot("mean stretch", h.mean_stretch, "%.3g %%");
    if (session.simulation().body_count() > 0) plot("volume", h.volume, "%.6f V0");
    plot("energy", h.energy, "%.4g J");
    if (session.report().solver.used()) {
        plot("active", h.active, "%.0f constraints");
        plot("iterations", h.iterations, "%.0f");
        plot("residual", h.residual, "%.2e");
    }
    plot("frame", h.frame_time, "%.2f ms");
}

void Panel::draw_passes(const Session& session)
{
    double most = 1e-9;
    for (const PassCost& pass : session.pass_costs()) most = std::max(most, pass.milliseconds);
    for (const PassCost& pass : session.pass_costs()) {
        char text[96];
        std::snprintf(text, sizeof text, "%s  %.3f ms", pass.name.c_str(), pass.milliseconds);
        ImGui::ProgressBar(static_cast<float>(pass.milliseconds / most), {300, 0}, text);
    }
    if (session.pass_costs().empty()) ImGui::TextUnformatted("known after 20 frames");
}

void Panel::draw_overlays(View& view)
{
    for (std::size_t k = 0; k < overlay_count; ++k) {
        const auto overlay = static_cast<Overlay>(k);
        bool on = view.overlays.has(overlay);
        char text[48];
        std::snprintf(text, sizeof text, "%zu  %s", k + 1, overlay_names[k]);
        if (ImGui::Checkbox(text, &on)) view.overlays.set(overlay, on);
    }
}

void Panel::draw_help(View& view)
{
    const float width = ImGui::GetIO().DisplaySize.x;
    ImGui::SetNextWindowPos({std::max(8.0f, width - 412), 8}, ImGuiCond_Appearing);
    ImGui::SetNextWindowSize({404, 0}, ImGuiCond_Appearing);
    if (ImGui::Begin("Help", &view.help, ImGuiWindowFlags_NoFocusOnAppearing)) {
        constexpr const char* lines[][2] = {{"Space", "pause and go on"},
                                            {".", "one frame"},
                                            {"R", "reset"},
                                            {"F", "frame: see everything"},
                                            {"H", "hide and show the panel"},
                                            {"1 ... 8", "overlays: strain, springs, active constraints,"},
                                            {"", "constraint forces, contacts, normals,"},
                                            {"", "volume error, wireframe"},
                                            {"9", "no overlay"},
                                            {"P", "pin or release the node under the cursor"},
                                            {"S", "screenshot: pliant_0001.png, ..."},
                                            {"V", "record a video: pliant_0001.mp4, ..."},
                                            {"F1", "this sheet"},
                                            {"Esc", "quit"},
                                            {"left drag", "orbit"},
                                            {"middle drag", "pan; also Shift and left drag"},
                                            {"wheel", "nearer and farther"},
                                            {"right drag", "grab the nearest node"},
                                            {"double click", "turn about this place"},
                                            {"drop a file", "open a scene or a mesh"}};
        for (const auto& [key, what] : lines) {
            ImGui::TextUnformatted(key);
            ImGui::SameLine(100);
            ImGui::TextUnformatted(what);
        }
    }
    ImGui::End();
}

}  // namespace pliant::tool
