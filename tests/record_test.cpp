// The records of a run: statistics, the summary, checks, point caches and sequences of meshes.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>

#include <unistd.h>
#include <nlohmann/json.hpp>

#include "files/numbered_name.hpp"
#include "pliant/mesh.hpp"
#include "pliant/simulation.hpp"
#include "record/cache_file.hpp"
#include "record/run_record.hpp"
#include "scene/fields.hpp"
#include "test_errors.hpp"

namespace pliant {
namespace {

using test::error_of;

/// An empty folder for the length of a test.
class Record : public testing::Test {
protected:
    Record()
    {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        const std::string name = std::string("pliant_") + test->name() + "_" + std::to_string(::getpid());
        folder = std::filesystem::temp_directory_path() / name;
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
    }
    ~Record() override
    {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
    }

    std::set<std::string> names() const
    {
        std::set<std::string> found;
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            found.insert(entry.path().filename());
        return found;
    }

    std::filesystem::path folder;
};

using Names = std::set<std::string>;

std::string bytes_of(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void write_text(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream(file, std::ios::binary) << text;
}

std::vector<std::vector<std::string>> rows_of(const std::filesystem::path& csv)
{
    std::vector<std::vector<std::string>> rows;
    std::istringstream text(bytes_of(csv));
    for (std::string line; std::getline(text, line);) {
        std::istringstream cells(line);
        rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
    }
    return rows;
}

Report report_at(double time, double max_stretch, double mean_stretch = 0, double penetration = 0)
{
    Report report;
    report.simulated_seconds = time;
    report.measures.max_stretch = max_stretch;
    report.measures.mean_stretch = mean_stretch;
    report.measures.max_penetration = penetration;
    return report;
}

constexpr std::size_t first_cloth = 12, second_cloth = 15, all_nodes = first_cloth + second_cloth;
constexpr std::size_t all_triangles = 2 * 3 * 2 + 2 * 4 * 2;

/// Two sheets of 4 x 3 and 3 x 5 nodes that fall side by side.
Scene two_sheets()
{
    Scene scene;
    scene.name = "two sheets";
    scene.add(Cloth::sheet({.rows = 4, .columns = 3}));
    scene.add(Cloth::sheet({.rows = 3, .columns = 5}))->position = {2, 1, 0};
    return scene;
}

SimulationOptions on_one_thread()
{
    SimulationOptions options;
    options.backend = Backend::cpu;
    options.threads = 1;
    return options;
}

/// Positions of all cloths, one after the other.
std::vector<Vec3> all_positions(Simulation& simulation)
{
    std::vector<Vec3> all;
    for (std::size_t c = 0; c < simulation.scene().cloth_count(); ++c) {
        const auto positions = simulation.positions(c);
        all.insert(all.end(), positions.begin(), positions.end());
    }
    return all;
}

/// Records the start and `frames` frames; returns the positions of each.
std::vector<std::vector<Vec3>> record(CacheFile& cache, Simulation& simulation, std::uint64_t frames)
{
    std::vector<std::vector<Vec3>> recorded;
    for (std::uint64_t frame = 0; frame <= frames; ++frame) {
        if (frame > 0) simulation.advance(1.0 / 60);
        cache.add(simulation, frame);
        recorded.push_back(all_positions(simulation));
    }
    return recorded;
}

template <class Value>
Value value_at(const std::string& bytes, std::size_t offset)
{
    Value value{};
    if (offset + sizeof value > bytes.size()) throw std::out_of_range("the file is too short");
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

// --- statistics ----------------------------------------------------------------------------------

TEST_F(Record, StatisticsHaveANamedColumnForEveryValue)
{
    const auto file = folder / "statistics.csv";
    Report report = report_at(0.1, 0.25, 0.125, 0.5);
    report.frames = 6;
    report.measures.max_speed = 3;
    report.measures.kinetic_energy = 4;
    report.measures.elastic_energy = 5;
    report.measures.potential_energy = -7;
    report.measures.non_finite = 8;
    report.solver.newton_last = 3;
    report.solver.iterations_last = 24;
    report.solver.residual_last = 0.0625;
    report.solver.active_last = 17;
    report.solver.energy_lost = -0.5;
    StatisticsFile statistics(file);
    statistics.add(Report{}, 0);
    statistics.add(report, 9.5);
    statistics.finish();

    const auto rows = rows_of(file);
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[0],
              (std::vector<std::string>{"frame", "time_s", "max_stretch", "mean_stretch", "max_penetration_m",
                                        "max_speed_m_per_s", "kinetic_energy_J", "elastic_energy_J",
                                        "potential_energy_J", "non_finite_nodes", "wall_ms", "newton",
                                        "iterations", "residual", "active_constraints", "energy_lost_J"}));
    EXPECT_EQ(rows[1], std::vector<std::string>(16, "0"));
    EXPECT_EQ(rows[2], (std::vector<std::string>{"6", "0.1", "0.25", "0.125", "0.5", "3", "4", "5", "-7", "8",
                                                 "9.5", "3", "24", "0.0625", "17", "-0.5"}));
}

TEST_F(Record, StatisticsOfADivergedRunKeepTheirColumns)
{
    const auto file = folder / "statistics.csv";
    Report report =
        report_at(1, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN());
    for (double* energy : {&report.measures.kinetic_energy, &report.measures.elastic_energy,
                           &report.measures.potential_energy, &report.solver.energy_lost})
        *energy = -std::numeric_limits<double>::max();  // as many digits as a number can have
    StatisticsFile statistics(file);
    statistics.add(report, 1);
    statistics.finish();
    const auto rows = rows_of(file);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[1].size(), rows[0].size());
    EXPECT_EQ(rows[1][2], "inf");
}

TEST_F(Record, StatisticsAppearOnlyWhenTheyAreFinished)
{
    const auto file = folder / "statistics.csv";
    write_text(file, "of an older run\n");
    {
        StatisticsFile statistics(file);
        statistics.add(Report{}, 0);
    }
    EXPECT_EQ(bytes_of(file), "of an older run\n");
    EXPECT_EQ(names(), Names{"statistics.csv"});

    StatisticsFile statistics(file);
    statistics.finish();
    EXPECT_EQ(rows_of(file).size(), 1U);
    EXPECT_EQ(names(), Names{"statistics.csv"});
}

TEST_F(Record, StatisticsRefuseAFolderThatIsNotThere)
{
    const Error error = error_of([&] { StatisticsFile(folder / "no" / "statistics.csv"); });
    EXPECT_EQ(error.kind, ErrorKind::bad_input);
    EXPECT_NE(std::string(error.what()).find("no/statistics.csv"), std::string::npos) << error.what();
}

// --- summary -------------------------------------------------------------------------------------

TEST(RunSummary, StretchIsOfTheLastSecondAndThePeakOfTheWholeRun)
{
    RunSummary summary;
    summary.add_frame(report_at(0.5, 0.9, 0.5));
    summary.add_frame(report_at(1.0, 0.4, 0.1));
    summary.add_frame(report_at(1.5, 0.2, 0.2));
    summary.add_frame(report_at(2.0, 0.1, 0.3));
    EXPECT_DOUBLE_EQ(summary.max_stretch(2.0), 0.2);  // the frames after 1 s and up to 2 s
    EXPECT_DOUBLE_EQ(summary.mean_stretch(2.0), 0.25);
    EXPECT_DOUBLE_EQ(summary.max_stretch_peak(), 0.9);
}

TEST(RunSummary, LessThanASecondIsAllLastSecond)
{
    RunSummary summary;
    summary.add_frame(report_at(0.25, 0.5, 0.1));
    summary.add_frame(report_at(0.5, 0.3, 0.3));
    EXPECT_DOUBLE_EQ(summary.max_stretch(0.5), 0.5);
    EXPECT_DOUBLE_EQ(summary.mean_stretch(0.5), 0.2);
    EXPECT_DOUBLE_EQ(summary.max_stretch_peak(), 0.5);
}

TEST(RunSummary, OneFrameOfASecondOrMoreCounts)
{
    RunSummary summary;
    summary.add_frame(report_at(1, 0.5, 0.2));
    summary.add_frame(report_at(2, 0.25, 0.1));
    EXPECT_DOUBLE_EQ(summary.max_stretch(2), 0.25);
    EXPECT_DOUBLE_EQ(summary.mean_stretch(2), 0.1);
}

TEST(RunSummary, KeepsTheDeepestPenetration)
{
    RunSummary summary;
    for (const double depth : {0.0, 0.003, 0.001}) summary.add_frame(report_at(1, 0, 0, depth));
    EXPECT_DOUBLE_EQ(summary.max_penetration(), 0.003);
}

TEST(RunSummary, OfNothingIsZero)
{
    const RunSummary summary;
    EXPECT_EQ(summary.max_stretch(0), 0);
    EXPECT_EQ(summary.mean_stretch(0), 0);
    EXPECT_EQ(summary.max_stretch_peak(), 0);
    EXPECT_EQ(summary.max_penetration(), 0);
}

TEST(RunSummary, ValuesDescribeTheSimulation)
{
    Simulation simulation(two_sheets(), on_one_thread());
    RunSummary summary;
    for (int frame = 0; frame < 6; ++frame) {
        simulation.advance(1.0 / 60);
        summary.add_frame(simulation.report());
    }
    const auto values = summary.values(simulation);
    EXPECT_EQ(values.at("nodes"), static_cast<double>(all_nodes));
    EXPECT_EQ(values.at("triangles"), static_cast<double>(all_triangles));
    EXPECT_EQ(values.at("springs"), static_cast<double>(simulation.spring_count()));
    EXPECT_EQ(values.at("frames"), 6);
    EXPECT_EQ(values.at("steps"), static_cast<double>(simulation.report().steps));
    EXPECT_NEAR(values.at("simulated_seconds"), 0.1, 1e-9);
    EXPECT_EQ(values.at("finite"), 1);
    EXPECT_GT(values.at("frames_per_second"), 0);
    EXPECT_NEAR(values.at("real_time_factor"), values.at("frames_per_second") / 60,
                1e-6 * values.at("real_time_factor"));
    // Both have fallen by g t^2 / 2 (and a little more, by the integrator), from 0 m and from 1 m.
    EXPECT_NEAR(values.at("lowest_height"), -0.049, 0.005);
    EXPECT_NEAR(values.at("highest_height"), 0.951, 0.005);
}

TEST_F(Record, SummaryHasEveryKeyOfTheContract)
{
    const auto file = folder / "summary.json";
    Simulation simulation(two_sheets(), on_one_thread());
    simulation.advance(1.0 / 60);
    RunSummary summary;
    summary.add_frame(simulation.report());
    summary.write(file, simulation, 1.5);

    const auto json = nlohmann::json::parse(bytes_of(file));
    const Names contract = {"scene",
                            "method",
                            "backend",
                            "device",
                            "threads",
                            "nodes",
                            "springs",
                            "triangles",
                            "frames",
                            "steps",
                            "finite",
                            "simulated_seconds",
                            "wall_seconds",
                            "max_stretch",
                            "mean_stretch",
                            "frames_per_second",
                            "real_time_factor",
                            "max_penetration",
                            "state_hash",
                            "max_stretch_peak",
                            "passes"};
    for (const std::string& key : contract) EXPECT_TRUE(json.contains(key)) << key;
    EXPECT_EQ(json.at("scene"), "two sheets");
    EXPECT_EQ(json.at("method"), "mass_spring");
    EXPECT_FALSE(json.contains("solver"));  // which mass_spring has none of
    EXPECT_EQ(json.at("backend"), "cpu");
    EXPECT_EQ(json.at("device"), simulation.device_name());
    EXPECT_EQ(json.at("threads"), 1);
    EXPECT_EQ(json.at("nodes"), all_nodes);
    EXPECT_EQ(json.at("wall_seconds"), 1.5);
    EXPECT_EQ(json.at("finite"), true);
    EXPECT_EQ(json.at("state_hash"), hash_text(simulation.state_hash()));
    EXPECT_FALSE(json.at("passes").empty());
    for (const auto& [pass, milliseconds] : json.at("passes").items()) EXPECT_GE(milliseconds, 0.0) << pass;
    EXPECT_EQ(names(), Names{"summary.json"});
}

TEST_F(Record, SummaryOfASolvedRunTellsOfItsSolver)
{
    Scene scene = two_sheets();
    scene.method = Method::constraint;
    scene.cloth_handle(0).pin(Edge::top);
    Simulation simulation(scene, on_one_thread());
    simulation.advance(1.0 / 60);
    RunSummary().write(folder / "summary.json", simulation, 1);

    const auto json = nlohmann::json::parse(bytes_of(folder / "summary.json"));
    EXPECT_EQ(json.at("method"), "constraint");
    const SolverReport& solver = simulation.report().solver;
    ASSERT_EQ(json.contains("solver"), solver.used());
    if (!solver.used()) return;
    const nlohmann::json expected = {{"name", "newton_multigrid"},
                                     {"newton_mean", solver.newton_mean},
                                     {"newton_max", solver.newton_max},
                                     {"iterations_mean", solver.iterations_mean},
                                     {"iterations_max", solver.iterations_max},
                                     {"residual_max", solver.residual_max},
                                     {"frames_cut", solver.frames_cut},
                                     {"steps_added", solver.steps_added},
                                     {"searches_refused", solver.searches_refused},
                                     {"energy_lost", solver.energy_lost},
                                     {"active_mean", solver.active_mean},
                                     {"active_max", solver.active_max}};
    EXPECT_EQ(json.at("solver"), expected);
}

TEST_F(Record, SummaryOfADivergedRunIsStillJson)
{
    Scene scene = two_sheets();
    scene.time.substeps = 1;
    scene.cloth_handle(0)->springs.structural = {1e9, 0};
    scene.cloth_handle(0).pin(Corner::top_left);
    Simulation simulation(scene, on_one_thread());
    RunSummary summary;
    for (int frame = 0; frame < 60 && simulation.report().finite; ++frame) {
        simulation.advance(1.0 / 60);
        summary.add_frame(simulation.report());
    }
    ASSERT_FALSE(simulation.report().finite);
    summary.write(folder / "summary.json", simulation, 1);
    const auto json = nlohmann::json::parse(bytes_of(folder / "summary.json"));
    EXPECT_EQ(json.at("finite"), false);
    EXPECT_EQ(json.at("frames"), simulation.report().frames);
}

TEST_F(Record, SummaryWithoutSpringsHasNoStableStep)
{
    Scene scene;
    auto cloth = scene.add(Cloth::sheet({.rows = 2, .columns = 2}));
    cloth->springs = {{0, 0}, {0, 0}, {0, 0}};
    cloth->damping = 0;
    Simulation simulation(scene, on_one_thread());
    RunSummary().write(folder / "summary.json", simulation, 0);
    const auto json = nlohmann::json::parse(bytes_of(folder / "summary.json"));
    EXPECT_TRUE(json.at("stable_step_seconds").is_null());
}

// --- checks --------------------------------------------------------------------------------------

TEST(FailedChecks, BoundsBelongToTheRange)
{
    Scene scene;
    scene.checks = {{"max_stretch", 0.1, 0.2}};
    EXPECT_TRUE(failed_checks(scene, {{"max_stretch", 0.1}}).empty());
    EXPECT_TRUE(failed_checks(scene, {{"max_stretch", 0.2}}).empty());
    EXPECT_EQ(failed_checks(scene, {{"max_stretch", 0.21}}).size(), 1U);
    EXPECT_EQ(failed_checks(scene, {{"max_stretch", 0.09}}).size(), 1U);
}

TEST(FailedChecks, NotANumberFails)
{
    Scene scene;
    scene.checks = {{"kinetic_energy", -1e300, 1e300}};
    EXPECT_EQ(failed_checks(scene, {{"kinetic_energy", std::numeric_limits<double>::quiet_NaN()}}).size(),
              1U);
    EXPECT_EQ(failed_checks(scene, {{"kinetic_energy", std::numeric_limits<double>::infinity()}}).size(), 1U);
}

TEST(FailedChecks, NameTheValueAndItsBounds)
{
    Scene scene;
    scene.checks = {{"frames", 3, 3}, {"max_stretch", 0.125, 0.25}, {"finite", 1, 1}};
    const auto failures = failed_checks(scene, {{"frames", 3}, {"max_stretch", 0.75}, {"finite", 0}});
    ASSERT_EQ(failures.size(), 2U);
    for (const char* part : {"max_stretch", "0.75", "0.125", "0.25"})
        EXPECT_NE(failures[0].find(part), std::string::npos) << part << " in: " << failures[0];
    EXPECT_NE(failures[1].find("finite"), std::string::npos) << failures[1];
}

TEST(FailedChecks, EveryNameThatASceneMayCheckIsInTheSummary)
{
    Simulation simulation(two_sheets(), on_one_thread());
    const auto values = RunSummary().values(simulation);
    for (const char* name : scene_format::check_names) EXPECT_TRUE(values.contains(name)) << name;
}

// --- numbered names ------------------------------------------------------------------------------

TEST(NumberedName, FillsInTheNumber)
{
    EXPECT_EQ(NumberedName("seq_%04d.ply").at(7), "seq_0007.ply");
    EXPECT_EQ(NumberedName("seq_%04d.ply").at(12345), "seq_12345.ply");
    EXPECT_EQ(NumberedName("%d").at(0), "0");
    EXPECT_EQ(NumberedName("a b/%02d.obj").at(3), "a b/03.obj");
    EXPECT_EQ(NumberedName("%01d.obj").at(12), "12.obj");
    EXPECT_EQ(NumberedName("%d.ply").at(18'446'744'073'709'551'615U), "18446744073709551615.ply");
}

TEST(NumberedName, RefusesEverythingElseByName)
{
    for (const char* pattern : {"", "seq.ply", "%", "seq_%", "seq_%s.ply", "seq_%4d.ply", "seq_%-4d.ply",
                                "seq_%04x.ply", "seq_%04.ply", "seq_%012d.ply", "seq_%%d.ply", "%d_%d.ply",
                                "%04d.%ply", "seq_%n.ply", "seq_%0", "seq_%99999999999999999999d.ply"}) {
        const Error error = error_of([&] { NumberedName{pattern}; });
        EXPECT_EQ(error.kind, ErrorKind::bad_usage) << pattern;
        EXPECT_NE(std::string(error.what()).find(std::string("'") + pattern + "'"), std::string::npos)
            << error.what();
        EXPECT_NE(std::string(error.what()).find("%04d"), std::string::npos) << error.what();
    }
}

TEST_F(Record, CachesAreKnownByTheirEnding)
{
    EXPECT_NO_THROW(make_cache_file((folder / "a.pc2").string()));
    EXPECT_NO_THROW(make_cache_file((folder / "a_%04d.ply").string()));
    EXPECT_NO_THROW(make_cache_file((folder / "a_%d.obj").string()));
    for (const char* name : {"a", "a.abc", "a.pc2.txt", ".pc2", "a_%04d.stl", "a.ply", "a.obj"}) {
        const Error error = error_of([&] { make_cache_file(name); });
        EXPECT_EQ(error.kind, ErrorKind::bad_usage) << name;
        EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
    EXPECT_EQ(names(), Names{});
}

// --- point cache ---------------------------------------------------------------------------------

TEST_F(Record, PointCacheHoldsAHeaderAndEveryPosition)
{
    Simulation simulation(two_sheets(), on_one_thread());
    const auto cache = make_cache_file((folder / "cloth.pc2").string());
    const auto frames = record(*cache, simulation, 4);
    cache->finish();

    const std::string bytes = bytes_of(folder / "cloth.pc2");
    ASSERT_EQ(bytes.size(), 32 + frames.size() * all_nodes * 12);
    EXPECT_EQ(bytes.substr(0, 12), std::string("POINTCACHE2\0", 12));
    EXPECT_EQ(value_at<std::int32_t>(bytes, 12), 1);  // version
    EXPECT_EQ(value_at<std::int32_t>(bytes, 16), static_cast<std::int32_t>(all_nodes));
    EXPECT_EQ(value_at<float>(bytes, 20), 0);  // first frame
    EXPECT_EQ(value_at<float>(bytes, 24), 1);  // frames between two samples
    EXPECT_EQ(value_at<std::int32_t>(bytes, 28), static_cast<std::int32_t>(frames.size()));
    for (std::size_t frame = 0; frame < frames.size(); ++frame)
        for (std::size_t node = 0; node < all_nodes; ++node)
            ASSERT_EQ(value_at<Vec3>(bytes, 32 + 12 * (frame * all_nodes + node)), frames[frame][node])
                << "frame " << frame << ", node " << node;
}

TEST_F(Record, PointCacheHasTheMeshOfTheFirstFrameBesideIt)
{
    Simulation simulation(two_sheets(), on_one_thread());
    const auto cache = make_cache_file((folder / "cloth.v2.pc2").string());
    const auto frames = record(*cache, simulation, 2);
    cache->finish();

    EXPECT_EQ(names(), (Names{"cloth.v2.pc2", "cloth.v2.obj"}));
    const SurfaceMesh mesh = read_mesh(folder / "cloth.v2.obj");
    EXPECT_EQ(mesh.vertices, frames[0]);
    ASSERT_EQ(mesh.triangles.size(), all_triangles);
    EXPECT_EQ(mesh.triangles[0], simulation.triangles(0)[0]);
    const Triangle last = simulation.triangles(1).back();
    EXPECT_EQ(mesh.triangles.back(), (Triangle{last[0] + 12, last[1] + 12, last[2] + 12}));
}

TEST_F(Record, PointCacheAppearsOnlyWhenItIsFinished)
{
    write_text(folder / "cloth.pc2", "of an older run");
    {
        Simulation simulation(two_sheets(), on_one_thread());
        const auto cache = make_cache_file((folder / "cloth.pc2").string());
        record(*cache, simulation, 2);
    }
    EXPECT_EQ(bytes_of(folder / "cloth.pc2"), "of an older run");
    EXPECT_EQ(names(), (Names{"cloth.obj", "cloth.pc2"}));
}

// --- sequences of meshes -------------------------------------------------------------------------

TEST_F(Record, MeshSequencesHoldEveryFrame)
{
    for (const std::string ending : {".ply", ".obj"}) {
        Simulation simulation(two_sheets(), on_one_thread());
        const auto cache = make_cache_file((folder / ("cloth_%03d" + ending)).string());
        const auto frames = record(*cache, simulation, 2);
        cache->finish();
        for (std::size_t frame = 0; frame < frames.size(); ++frame) {
            const SurfaceMesh mesh = read_mesh(folder / ("cloth_00" + std::to_string(frame) + ending));
            EXPECT_EQ(mesh.vertices, frames[frame]) << ending << " " << frame;
            EXPECT_EQ(mesh.triangles.size(), all_triangles);
        }
    }
    EXPECT_EQ(names(), (Names{"cloth_000.ply", "cloth_001.ply", "cloth_002.ply", "cloth_000.obj",
                              "cloth_001.obj", "cloth_002.obj"}));
}

TEST_F(Record, MeshSequencesNameTheFolderThatIsNotThere)
{
    Simulation simulation(two_sheets(), on_one_thread());
    const Error error =
        error_of([&] { make_cache_file((folder / "no" / "cloth_%d.ply").string())->add(simulation, 0); });
    EXPECT_EQ(error.kind, ErrorKind::bad_input);
    EXPECT_NE(std::string(error.what()).find("no/cloth_0.ply"), std::string::npos) << error.what();
}

// --- hashes --------------------------------------------------------------------------------------

TEST(HashText, HasSixteenDigits)
{
    EXPECT_EQ(hash_text(0), "0000000000000000");
    EXPECT_EQ(hash_text(0xABC), "0000000000000abc");
    EXPECT_EQ(hash_text(0x1234567890abcdef), "1234567890abcdef");
    EXPECT_EQ(hash_text(~0ull), "ffffffffffffffff");
}

TEST(HashText, TheSameStateHasTheSameHash)
{
    Simulation one(two_sheets(), on_one_thread()), other(two_sheets(), on_one_thread());
    EXPECT_EQ(one.state_hash(), other.state_hash());
    one.advance(1.0 / 60);
    EXPECT_NE(one.state_hash(), other.state_hash());
    other.advance(1.0 / 60);
    EXPECT_EQ(one.state_hash(), other.state_hash());
}

}  // namespace
}  // namespace pliant
