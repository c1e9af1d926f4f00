// The single program of all C++ tests, run as one process per test file, so that a file's tests share
// resources (a Vulkan device, its pipelines):
//
//     pliant_tests FILE... [options of gtest]
//
// runs the tests of FILE.cpp, or all if no file is given; --gtest_filter may select fewer. It fails if no
// test is selected, and exits with 77 if all selected tests were skipped. Reasons for skipping are printed on
// separate lines, which './dev test' collects.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <set>
#include <string>

namespace {

constexpr int all_skipped = 77;

class SkipListener final : public testing::EmptyTestEventListener {
    void OnTestStart(const testing::TestInfo& test) override
    {
        name_ = std::string(test.test_suite_name()) + "." + test.name();
    }
    void OnTestPartResult(const testing::TestPartResult& result) override
    {
        if (result.skipped()) std::printf("skipped: %s: %s\n", name_.c_str(), result.message());
    }
    std::string name_;
};

/// Narrows the filter to the tests that these files have.
void keep_files(const std::set<std::string>& files)
{
    const testing::UnitTest& tests = *testing::UnitTest::GetInstance();
    std::string theirs, others;
    for (int i = 0; i < tests.total_test_suite_count(); ++i) {
        const testing::TestSuite& suite = *tests.GetTestSuite(i);
        for (int j = 0; j < suite.total_test_count(); ++j) {
            const testing::TestInfo& test = *suite.GetTestInfo(j);
            std::string& list = files.contains(std::filesystem::path(test.file()).stem()) ? theirs : others;
            list += std::string(":") + suite.name() + "." + test.name();
        }
    }
    const std::string filter = GTEST_FLAG_GET(filter);
    if (filter == "*" || filter.starts_with('-'))
        GTEST_FLAG_SET(filter, theirs + (filter == "*" ? "" : filter));
    else
        GTEST_FLAG_SET(filter, filter + (filter.find('-') == std::string::npos ? "-" : "") + others);
}

}  // namespace

int main(int argc, char** argv)
{
    testing::InitGoogleTest(&argc, argv);
    if (argc > 1) keep_files({argv + 1, argv + argc});
    testing::UnitTest& tests = *testing::UnitTest::GetInstance();
    tests.listeners().Append(new SkipListener);  // which takes ownership
    const int status = RUN_ALL_TESTS();
    if (GTEST_FLAG_GET(list_tests)) return status;
    if (tests.test_to_run_count() == 0) {
        std::fprintf(stderr, "there is no such test\n");
        return 1;
    }
    return status == 0 && tests.skipped_test_count() == tests.test_to_run_count() ? all_skipped : status;
}
