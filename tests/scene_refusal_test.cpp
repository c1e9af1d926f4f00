// Scenes that are refused, and their messages.
#include <limits>

#include "test_errors.hpp"
#include "test_scenes.hpp"

namespace pliant::test {
namespace {

struct Refusal {
    std::string text;                // of a scene, or an override of a good one
    std::vector<std::string> parts;  // of the message
};

/// A scene file with more keys for the scene and for its one cloth, each starting with a comma.
std::string with(const std::string& scene_keys, const std::string& cloth_keys = "")
{
    return R"({"pliant": 1, "cloths": [{"sheet": {"rows": 5, "columns": 4})" + cloth_keys + "}]" +
           scene_keys + "}";
}
std::string colliding(const std::string& collider) { return with(", \"colliders\": [" + collider + "]"); }

TEST(Scene, WrongFilesAreExplained)
{
    const std::string mesh = R"({"pliant": 1, "cloths": [{"mesh": {"file": "no.obj"}}]})";
    const Refusal refusals[] = {
        // the file itself
        {"", {"line 1, column 1", "unexpected end of input"}},
        {"{\n  \"pliant\": 1,\n  \"cloths\" []\n}", {"line 3, column 12", "expected ':'"}},
        {"{\"pliant\": 1} x", {"line 1, column 15"}},
        {"{\"pliant\": 1,\n", {"line 2, column 1", "unexpected end of input"}},
        {"{\"pliant\": 1 /* and so on", {"line 1", "comment"}},
        {"{\"name\": \"\xff\"}", {"line 1", "UTF-8"}},
        {std::string(100'000, '['), {"[0][0][0] is nested more than 32 levels deep"}},
        {"[1, 2, 3]", {"the scene is an array of 3", "must be an object"}},
        {"{}", {"pliant is missing", "\"pliant\": 1"}},
        {R"({"pliant": 2})", {"pliant is 2", "must be 1"}},
        {R"({"pliant": 1, "pliant": 1})", {"pliant is given twice"}},
        {with("", R"(, "springs": {"shear": {"damping": 0, "damping": 1}})"),
         {"cloths[0].springs.shear.damping is given twice"}},
        {with(R"(, "time": {"duration": 1e999})"), {"time.duration is a number beyond 1.8e308"}},
        // keys and types
        {R"({"pliant": 1, "cloth": []})", {"cloth is unknown", "did you mean \"cloths\"?"}},
        {R"({"pliant": 1})", {"cloths is empty", "at least one cloth"}},
        {with(", \"gravitation\": 1"), {"gravitation is unknown"}},
        {with(", \"new\\nline\": 1"), {"new?line is unknown", "allowed here: ", "gravity"}},
        {with(R"(, "method": "xpbd")"),
         {"method is \"xpbd\"", "must be one of mass_spring, constraint, acad"}},
        {with(R"(, "method": "constrain")"), {"method is \"constrain\"", "did you mean \"constraint\"?"}},
        {with(R"(, "method": true)"), {"method is true", "one of mass_spring"}},
        {with(R"(, "solver": "multigrid")"), {"solver is \"multigrid\"", "newton_multigrid, paper"}},
        {with(R"(, "integrator": "verlet")"),
         {"integrator is \"verlet\"", "symplectic_euler", "runge_kutta_4"}},
        {with(R"(, "integrator": "explicit_euler")"), {"time.substeps is 0", "no safe step", "at least 1"}},
        {with(R"(, "integrator": "runge_kutta_4", "method": "constraint")"),
         {"integrator is runge_kutta_4", "method constraint", "use method mass_spring"}},
        {with(R"(, "integrator": "runge_kutta_4")", R"(, "formulation": "node_centric")"),
         {"cloths[0].formulation is node_centric", "spring_list or automatic"}},
        {with("", R"(, "material": "coton")"),
         {"cloths[0].material is \"coton\"", "did you mean \"cotton\"?"}},
        {with("", R"(, "springs": {"bend_model": "cubic"})"),
         {"cloths[0].springs.bend_model is \"cubic\"", "one of skip_spring, quadratic"}},
        {with("", R"(, "springs": {"bend_model": "quadratic", "bending_stiffness": -1})"),
         {"cloths[0].springs.bending_stiffness is -1 N m", "between 0 and 1e6 N m"}},
        {with("", R"(, "springs": {"bend_model": "quadratic"}, "formulation": "node_centric")"),
         {"cloths[0].springs.bend_model is quadratic", "use formulation automatic"}},
        {with(R"(, "method": "constraint", "solver": "paper")",
              R"(, "springs": {"bend_model": "quadratic"})"),
         {"cloths[0].springs.bend_model is quadratic", "solver paper", "use newton_multigrid"}},
        {with(R"(, "method": "constraint")",
              R"(, "springs": {"bend_model": "quadratic", "bend": {"role": "constraint"}})"),
         {"cloths[0].springs.bend.role is constraint", "no bend springs", "use automatic"}},
        {with(R"(, "name": 5)"), {"name is 5", "must be a string"}},
        {with(R"(, "name": "../up")"), {"name is \"../up\"", "can name a file"}},
        {with(R"(, "cloths ": 1)"), {"cloths  is unknown", "did you mean \"cloths\"?"}},
        {R"({"pliant": 1, "cloths": {}})", {"cloths is an object", "must be an array"}},
        {R"({"pliant": 1, "cloths": []})", {"cloths is empty"}},
        {R"({"pliant": 1, "cloths": [7]})", {"cloths[0] is 7", "must be an object"}},
        // time, gravity, air, camera, check
        {with(R"(, "time": {"duration": 0})"), {"time.duration is 0 s", "above 0 and at most 1e6 s"}},
        {with(R"(, "time": {"duration": "5 s"})"), {"time.duration is \"5 s\"", "a number above 0", " s"}},
        {with(R"(, "time": {"framerate": 60})"),
         {"time.framerate is unknown", "did you mean \"frame_rate\"?"}},
        {with(R"(, "time": {"frame_rate": 0.5})"), {"time.frame_rate is 0.5 1/s", "between 1 and 10000 1/s"}},
        {with(R"(, "time": {"substeps": 1.5})"),
         {"time.substeps is 1.5 steps", "a whole number between 0 and 100000"}},
        {with(R"(, "time": {"substeps": -1})"), {"time.substeps is -1 steps", "between 0 and 100000"}},
        {with(R"(, "time": {"dt": 0.001})"), {"time.dt is given without substeps"}},
        {with(R"(, "time": {"dt": 0.001, "substeps": 5, "frame_rate": 60})"),
         {"time.dt is given beside frame_rate"}},
        {with(R"(, "time": {"dt": 1e-9, "substeps": 5})"),
         {"time.dt is 1e-9 s", "with 5 substeps", "between 1e-4 and 1 s"}},
        {with(R"(, "gravity": -9.81)"), {"gravity is -9.81", "an array of 3 numbers in m/s2"}},
        {with(R"(, "gravity": [0, -9.81])"), {"gravity is an array of 2", "an array of 3 numbers"}},
        {with(R"(, "gravity": [0, "down", 0])"), {"gravity[1] is \"down\"", "m/s2"}},
        {with(R"(, "air": {"density": -1.2})"), {"air.density is -1.2 kg/m3", "between 0 and 2000 kg/m3"}},
        {with(R"(, "camera": {"width": 8193})"),
         {"camera.width is 8193 pixels", "between 16 and 8192 pixels"}},
        {with(R"(, "camera": {"color": "strain"})"), {"camera.color is unknown", "did you mean \"colour\"?"}},
        {with(R"(, "camera": {"colour": "strian"})"),
         {"camera.colour is \"strian\"", "did you mean \"strain\"?"}},
        {with(R"(, "camera": {"field_of_view": 171})"),
         {"camera.field_of_view is 171 degrees", "between 1 and 170"}},
        {with(R"(, "camera": {"position": [0, 1, 0], "target": [0, 1, 0]})"),
         {"camera.target is [0, 1, 0] m", "differ"}},
        {with(R"(, "check": {"max_strech": [0, 1]})"),
         {"check.max_strech is unknown", "did you mean \"max_stretch\"?"}},
        {with(R"(, "check": {"max_stretch": 0.3})"),
         {"check.max_stretch is 0.3", "an array of 2 numbers, [min, max]"}},
        {with(R"(, "check": {"max_stretch": [1, 0]})"), {"check.max_stretch is [1, 0]", "in this order"}},
        {with(R"(, "check": {"solver.residual": [0, 1]})"),
         {"check.solver.residual is unknown", "\"solver.residual_max\"?"}},
        // methods and solvers
        {with(R"(, "newton_multigrid": {"newton_iterations": 0})"),
         {"newton_multigrid.newton_iterations is 0 iterations", "between 1 and 1000 iterations"}},
        {with(R"(, "newton_multigrid": {"newton_iterations": 1001})"), {"newton_iterations is 1001"}},
        {with(R"(, "newton_multigrid": {"newton_tolerance": 1.5})"),
         {"newton_multigrid.newton_tolerance is 1.5", "between 0 and 1"}},
        {with(R"(, "newton_multigrid": {"linear_iterations": 0})"),
         {"newton_multigrid.linear_iterations is 0 V-cycles", "between 1 and 10000 V-cycles"}},
        {with(R"(, "newton_multigrid": {"linear_tolerance": -0.1})"),
         {"newton_multigrid.linear_tolerance is -0.1", "between 0 and 1"}},
        {with(R"(, "newton_multigrid": {"smoothing": 9})"),
         {"newton_multigrid.smoothing is 9", "a whole number between 1 and 8"}},
        {with(R"(, "newton_multigrid": {"resists": "compression"})"),
         {"newton_multigrid.resists is \"compression\"", "one of tension, both"}},
        {with(R"(, "newton_multigrid": {"contact_stiffness": -1})"),
         {"newton_multigrid.contact_stiffness is -1 N/m", "between 0 and 1e9 N/m"}},
        {with(R"(, "newton_multigrid": {"order": 3})"), {"newton_multigrid.order is 3", "between 1 and 2"}},
        {with(R"(, "newton_multigrid": {"friction_speed": 2})"),
         {"newton_multigrid.friction_speed is 2 m/s", "above 0 and at most 1 m/s"}},
        {with(R"(, "newton_multigrid": {"newton_iteration": 3})"),
         {"newton_multigrid.newton_iteration is unknown", "\"newton_iterations\"?"}},
        {with(R"(, "paper": {"tolerance": 0})"), {"paper.tolerance is 0,", "above 0 and at most 1"}},
        {with(R"(, "paper": {"max_iterations": 100001})"),
         {"paper.max_iterations is 100001 iterations", "between 1 and 100000 iterations"}},
        {with(R"(, "paper": {"compliance": -1e-6})"),
         {"paper.compliance is -1e-6 m/N", "between 0 and 1 m/N"}},
        {with(R"(, "acad": {"activate_at": 0})"), {"acad.activate_at is 0,", "above 0 and at most 1"}},
        {with(R"(, "acad": {"deactivate_at": -0.01})"), {"acad.deactivate_at is -0.01", "between 0 and 1"}},
        {with(R"(, "acad": {"deactivate_at": 0.11})"),
         {"acad.deactivate_at is 0.11", "must not exceed activate_at, 0.1"}},
        {with(R"(, "acad": {"compression": "yes"})"), {"acad.compression is \"yes\"", "true or false"}},
        {with(R"(, "acad": {"compression": 1})"), {"acad.compression is 1", "true or false"}},
        {with(R"(, "acad": {"target": "half"})"), {"acad.target is \"half\"", "one of threshold, rest"}},
        {with(R"(, "acad": {"compliance": 0})"), {"acad.compliance is 0 m/N", "between 1e-9 and 1 m/N"}},
        {with(R"(, "acad": 0.1)"), {"acad is 0.1", "an object"}},
        // cloths
        {R"({"pliant": 1, "cloths": [{}]})", {"cloths[0] has none of sheet, mesh"}},
        {R"({"pliant": 1, "cloths": [{"shet": {}}]})",
         {"cloths[0].shet is unknown", "did you mean \"sheet\"?"}},
        {with("", R"(, "mesh": {"file": "a.obj"})"), {"cloths[0].mesh is given beside sheet", "exactly one"}},
        {R"({"pliant": 1, "cloths": [{"disc": {}}]})", {"cloths[0].disc.rings is missing"}},
        {R"({"pliant": 1, "cloths": [{"disc": {"rings": 2365}}]})", {"cloths[0].disc.rings is 2365", "2364"}},
        {R"({"pliant": 1, "cloths": [{"disc": {"rings": 2}, "pins": [{"index": 19}]}]})",
         {"cloths[0].pins[0].index is 19", "0 to 18"}},
        {R"({"pliant": 1, "cloths": [{"sheet": {"rows": 2}}]})", {"cloths[0].sheet.columns is missing"}},
        {R"({"pliant": 1, "cloths": [{"sheet": {"rows": 1, "columns": 2}}]})",
         {"cloths[0].sheet.rows is 1 nodes", "between 2"}},
        {R"({"pliant": 1, "cloths": [{"sheet": {"rows": 1e30, "columns": 2}}]})",
         {"cloths[0].sheet.rows is 1e30 nodes"}},
        {R"({"pliant": 1, "cloths": [{"sheet": {"rows": 5000, "columns": 5000}}]})",
         {"cloths[0] brings", "25000000", "at most 16777216 nodes"}},
        {R"({"pliant": 1, "cloths": [{"sheet": {"rows": 2, "columns": 2, "width": 0}}]})",
         {"cloths[0].sheet.width is 0 m", "above 0"}},
        {mesh, {"cloths[0].mesh.file cannot be used: ", "no.obj"}},
        {with("", R"(, "density": 1, "node_mass": 1)"), {"cloths[0].node_mass is given beside density"}},
        {with("", R"(, "density": 0)"), {"cloths[0].density is 0 kg/m2", "above 0"}},
        {with("", R"(, "springs": {"shear": {"stiffness": -5}})"),
         {"cloths[0].springs.shear.stiffness is -5 N/m", "between 0 and 1e9 N/m"}},
        {with("", R"(, "springs": {"bend": {"stifness": 5}})"),
         {"cloths[0].springs.bend.stifness is unknown", "\"stiffness\"?"}},
        {with("", R"(, "springs": {"structural": {"damping": 2e6}})"),
         {"structural.damping is 2e6 N s/m", "1e6 N s/m"}},
        {with("", R"(, "springs": {"bend": {"role": "sping"}})"),
         {"cloths[0].springs.bend.role is \"sping\"", "did you mean \"spring\"?"}},
        {with("", R"(, "springs": {"structural": {"role": "constraint"}})"),
         {"cloths[0].springs.structural.role is constraint", "mass_spring has no constraints",
          "use method constraint"}},
        {with(R"(, "method": "acad")", R"(, "springs": {"bend": {"role": "constraint"}})"),
         {"cloths[0].springs.bend.role is constraint", "acad makes its own constraints",
          "use method constraint"}},
        {with("", R"(, "springs": {"shear": {"limit": 5}})"),
         {"cloths[0].springs.shear.limit is 5", "between 0 and 1"}},
        {with("", R"(, "springs": {"shear": {"compliance": 1e-10}})"),
         {"cloths[0].springs.shear.compliance is 1e-10 m/N", "between 1e-9 and 1 m/N"}},
        {with("", R"(, "damping": true)"), {"cloths[0].damping is true", "between 0 and 1000 1/s"}},
        {with("", R"(, "thickness": 1.5)"), {"cloths[0].thickness is 1.5 m", "between 0 and 1 m"}},
        {with("", R"(, "position": [0, 2e6, 0])"), {"cloths[0].position[1] is 2e6 m", "1e6 m"}},
        {with("", R"(, "formulation": "edge_centric")"),
         {"formulation is \"edge_centric\"", "\"node_centric\"?"}},
        {with("", R"(, "pins": [{"index": 20}])"), {"cloths[0].pins[0].index is 20", "0 to 19"}},
        {with("", R"(, "pins": [{"index": -1}])"), {"cloths[0].pins[0].index is -1"}},
        {with("", R"(, "pins": [{"corner": "topleft"}])"),
         {"pins[0].corner is \"topleft\"", "\"top_left\"?"}},
        {with("", R"(, "pins": [{"corner": "top_left", "edge": "top"}])"),
         {"pins[0].edge is given beside corner"}},
        {with("", R"(, "pins": [{}])"), {"cloths[0].pins[0] has none of index, corner, edge, box"}},
        {with("", R"(, "pins": [{"box": {"min": [0, 0, 0]}}])"), {"cloths[0].pins[0].box.max is missing"}},
        {with("", R"(, "pins": [{"box": {"min": [0, 1, 0], "max": [1, 0, 1]}}])"),
         {"box.min is [0, 1, 0] m", "[1, 0, 1] m"}},
        {with("", R"(, "pins": [{"keyframes": [{"time": 0}]}])"),
         {"cloths[0].pins[0] has none of index, corner, edge, box"}},
        {with("", R"(, "pins": [{"index": 0, "keyframes": [{"position": [0, 1, 0]}]}])"),
         {"cloths[0].pins[0].keyframes[0].time is missing"}},
        {with("", R"(, "pins": [{"index": 0, "keyframes": [{"time": 2}, {"time": 2}]}])"),
         {"cloths[0].pins[0].keyframes[1].time is 2 s", "later than the keyframe before it, 2 s"}},
        {with("", R"(, "pins": [{"index": 0, "keyframes": [{"time": 2, "position": [2e6, 0, 0]}]}])"),
         {"cloths[0].pins[0].keyframes[0].position[0] is 2e6 m"}},
        {with("", R"(, "pins": [{"index": 0, "keyframe": []}])"),
         {"cloths[0].pins[0].keyframe is unknown", "\"keyframes\"?"}},
        // colliders
        {colliding(R"({"sphere": {"center": [0, 0, 0], "radius": 1}})"),
         {"colliders[0].sphere.center is unknown", "\"centre\"?"}},
        {colliding(R"({"sphere": {"centre": [0, 0, 0]}})"), {"colliders[0].sphere.radius is missing"}},
        {colliding(R"({"sphere": {"centre": [0, 0, 0], "radius": -1}})"),
         {"colliders[0].sphere.radius is -1 m", "above 0"}},
        {colliding(R"({"torus": {}})"), {"colliders[0].torus is unknown", "sphere, plane, box, capsule"}},
        {colliding(R"({"plane": {"normal": [0, 0, 0]}})"), {"colliders[0].plane.normal is [0, 0, 0]"}},
        {colliding(R"({"plane": {"friction": 11}})"),
         {"colliders[0].plane.friction is 11", "between 0 and 10"}},
        {colliding(R"({"plane": {"response": "sticky"}})"),
         {"plane.response is \"sticky\"", "coulomb, paper"}},
        {colliding(R"({"plane": {"keyframes": [{"time": 1}, {"time": 1}]}})"),
         {"keyframes[1].time is 1 s", "later"}},
        {colliding(R"({"box": {"centre": [0, 0, 0], "size": [1, 0, 1]}})"),
         {"colliders[0].box.size[1] is 0 m", "above 0"}},
        {colliding(R"({"capsule": {"start": [0, 0, 0], "radius": 1}})"),
         {"colliders[0].capsule.end is missing"}},
    };
    EXPECT_GE(std::size(refusals), 60U);
    for (const Refusal& refusal : refusals) {
        const TemporaryFile file(refusal.text);
        const Error error = error_of([&] { read_scene(file.path.string()); });
        EXPECT_EQ(error.kind, ErrorKind::bad_input) << error.what();
        expect_sentence(error.what(), refusal.parts);
        EXPECT_TRUE(std::string(error.what()).starts_with(file.path.string() + ": ")) << error.what();
    }
}

TEST(Scene, WrongOverridesAreExplained)
{
    const Refusal malformed[] = {
        {"time.duration", {"\"time.duration\"", "path=value", "time.duration=2"}},
        {"=2", {"path=value"}},
        {"time..duration=2", {"path=value"}},
        {"cloths[x].damping=2", {"path=value"}},
        {"cloths[0=2", {"path=value"}},
        {"name=\xff", {"path=value"}},
        {"cloths[7].damping=2", {"element 7 of cloths, which has 1"}},
        {"name.first=2", {"leads into name, which is \"hanging\"", "an object"}},
        {"time[0]=2", {"leads into time, which is an object", "an array"}},
    };
    for (const Refusal& refusal : malformed) {
        const Error error = error_of([&] { read_scene("hanging", {refusal.text}); });
        EXPECT_EQ(error.kind, ErrorKind::bad_usage) << error.what();
        expect_sentence(error.what(), refusal.parts);
    }
    const Refusal wrong[] = {
        {"time.duration=-2", {"override time.duration=-2: time.duration is -2 s"}},
        {"time.durations=2", {"override time.durations=2: time.durations is unknown", "\"duration\"?"}},
        {"air.wind=[1,0,0]", {"air.wind is unknown"}},
        {"cloths[0].sheet.rows=many", {"cloths[0].sheet.rows is \"many\"", "whole number", "nodes"}},
        {"cloths[0].node_mass=1", {"cloths[0].node_mass is given beside density"}},
        {"colliders[0].ball.radius=1", {"override colliders[0].ball.radius=1: colliders[0].ball is unknown"}},
    };
    for (const Refusal& refusal : wrong) {
        const Error error = error_of([&] { read_scene("hanging", {refusal.text}); });
        EXPECT_EQ(error.kind, ErrorKind::bad_input) << error.what();
        expect_sentence(error.what(), refusal.parts);
    }
    // An override is not to blame for a field whose name begins as its own.
    const TemporaryFile faulty(
        R"({"pliant": 1, "cloths": [{"sheet": {"rows": 3, "columns": 3, "width": 1, "height": 1}, "formulation": "node_centric", "springs": {"bend_model": "quadratic"}}]})");
    const Error error =
        error_of([&] { read_scene(faulty.path.string(), {R"(cloths[0].springs.bend={"stiffness":1})"}); });
    expect_sentence(error.what(), {faulty.path.string() + ": cloths[0].springs.bend_model is quadratic"});
    // A fault of a built-in scene itself, here with a part of it taken away, names its file.
    expect_sentence(error_of([] { read_scene("hanging", {"cloths[0].sheet=null"}); }).what(),
                    {"cloths[0] has none of"});
    expect_sentence(error_of([] { read_scene("hanging", {"cloths=null"}); }).what(), {"cloths is empty"});
}

TEST(Scene, UnknownNamesAreExplained)
{
    expect_sentence(error_of([] { read_scene("cloth_sfere"); }).what(),
                    {"\"cloth_sfere\"", "did you mean \"cloth_sphere\"?", "pliant list"});
    expect_sentence(error_of([] { read_scene("nothing/flag.json"); }).what(),
                    {"\"nothing/flag.json\"", "\"flag\"?"});
    expect_sentence(error_of([] { read_scene("\n"); }).what(),
                    {"no file and no built-in scene", "pliant list"});
    expect_sentence(error_of([] { read_scene((root / "scenes").string()); }).what(), {"is a directory"});
}

TEST(Scene, ScenesMadeInCodeAreValidatedToo)
{
    const auto refused = [](auto spoil, const std::vector<std::string>& parts) {
        Scene scene = small_scene();
        spoil(scene);
        const Error error = error_of([&] { validate(scene); });
        EXPECT_EQ(error.kind, ErrorKind::bad_input);
        expect_sentence(error.what(), parts);
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                     infinity = std::numeric_limits<double>::infinity();
    const SurfaceMesh triangle = {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 1, 2}}};
    EXPECT_NO_THROW(validate(small_scene()));
    refused([](Scene& s) { s = Scene(); }, {"cloths is empty"});
    refused([](Scene& s) { s.gravity.x = nan; }, {"gravity[0] is nan m/s2"});
    refused([](Scene& s) { s.time.duration = infinity; }, {"time.duration is inf s"});
    refused([](Scene& s) { s.name = ""; }, {"name is \"\""});
    refused(
        [](Scene& s) {
            s.checks = {{"speed", 0, 1}};
        },
        {"check.speed is unknown", "allowed here: max_stretch"});
    refused([](Scene& s) { s.cloth_handle(0)->shape = SheetOptions{.rows = 0}; },
            {"cloths[0].sheet.rows is 0 nodes"});
    refused([](Scene& s) { s.cloth_handle(0)->shape = SheetOptions{.density = 1}; },
            {"cloths[0].sheet.density is set"});
    refused([](Scene& s) { s.cloth_handle(0)->shape = DiscOptions{.rings = 0}; },
            {"cloths[0].disc.rings is 0 rings", "between 1"});
    refused([](Scene& s) { s.cloth_handle(0)->shape = DiscOptions{.density = 1}; },
            {"cloths[0].disc.density is set"});
    refused([](Scene& s) { s.cloth_handle(0).pin(20U); }, {"cloths[0].pins[0].index is 20", "0 to 19"});
    refused([](Scene& s) { s.cloth_handle(0).pin(static_cast<Corner>(9)); }, {"corner is no. 9", "top_left"});
    refused(
        [](Scene& s) {
            s.cloth_handle(0).pin({Corner::top_left, {{.time = 1}, {.time = 0.5}}});
        },
        {"cloths[0].pins[0].keyframes[1].time is 0.5 s", "1 s"});
    refused([](Scene& s) { s.method = static_cast<Method>(7); }, {"method is no. 7", "mass_spring"});
    refused([](Scene& s) { s.newton_multigrid.newton_tolerance = nan; }, {"newton_tolerance is nan"});
    refused([](Scene& s) { s.newton_multigrid.smoothing = 0; }, {"newton_multigrid.smoothing is 0"});
    refused([](Scene& s) { s.acad.deactivate_at = 0.5; }, {"acad.deactivate_at is 0.5", "activate_at, 0.1"});
    refused([](Scene& s) { s.cloth_handle(0)->springs.bend.role = SpringRole::constraint; },
            {"cloths[0].springs.bend.role is constraint", "method constraint"});
    Scene constrained = small_scene();
    constrained.method = Method::constraint;
    constrained.cloth_handle(0)->springs.bend.role = SpringRole::constraint;
    constrained.acad = {.activate_at = 0.05, .deactivate_at = 0.05};
    EXPECT_NO_THROW(validate(constrained));
    refused([](Scene& s) { s.add(Sphere{.centre = {}, .radius = 0}); },
            {"colliders[0].sphere.radius is 0 m"});
    refused([&](Scene& s) { s.add(Cloth::mesh(triangle)).pin(Edge::top); },
            {"cloths[1].pins[0].edge is on a mesh"});
    refused([&](Scene& s) { s.add(Cloth::mesh(triangle))->formulation = Formulation::node_centric; },
            {"cloths[1].formulation is node_centric", "mesh"});
    refused([](Scene& s) { s.add(Cloth::mesh({})); }, {"cloths[1].mesh has no triangle"});
    refused([](Scene& s) { s.add(Cloth::mesh({{{0, 0, 0}}, {{0, 1, 2}}})); }, {"vertex 1 in triangle 0"});
    refused(
        [&](Scene& s) {
            s.add(Cloth::mesh({{{std::numeric_limits<float>::infinity(), 0, 0}}, {{0, 0, 0}}}));
        },
        {"not finite at vertex 0"});
    refused(
        [](Scene& s) {
            for (int i = 0; i < 5; ++i) s.add(Cloth::sheet({.rows = 2048, .columns = 2048}));
        },
        {"cloths[4] brings the scene to 16777236 nodes"});
}

}  // namespace
}  // namespace pliant::test
