#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <string>

/// Runs the tests of one source: `unit_tests kepler_test`; without a name all of them. Options are
/// GoogleTest's. Returns 77 where none failed but some were skipped: CTest then counts none of the source as
/// passed, and lists it.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc > 1) {
    std::string filter;
    const auto& all = *testing::UnitTest::GetInstance();
    for (int i = 0; i < all.total_test_suite_count(); ++i) {
      const auto& suite = *all.GetTestSuite(i);
      for (int j = 0; j < suite.total_test_count(); ++j) {
        const auto& test = *suite.GetTestInfo(j);
        if (std::filesystem::path(test.file()).stem() == argv[1])
          filter += std::string(suite.name()) + "." + test.name() + ":";
      }
    }
    if (filter.empty()) {
      std::cerr << "There is no test in a source named " << argv[1] << ".\n";
      return 1;
    }
    testing::GTEST_FLAG(filter) = filter;
  }
  const int failed = RUN_ALL_TESTS();
  constexpr int skipped = 77;
  return failed == 0 && testing::UnitTest::GetInstance()->skipped_test_count() > 0 ? skipped : failed;
}
