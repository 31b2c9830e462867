// Checks the rules of doc/architecture.md and CONTRIBUTING.md that a machine can check.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "SourceTree.h"

namespace {

using source_tree::codeOnly;
using source_tree::files;
using source_tree::folders;
using source_tree::lines;
using source_tree::matches;
using source_tree::projectPath;
using source_tree::read;
using source_tree::fs::path;

const std::vector<std::string> cpp_extensions{".h", ".cpp"};

/// The words of `foreach(variable ...)` in a CMakeLists.txt.
std::vector<std::string> listed(const std::string& cmake_lists, const std::string& variable) {
  const auto list =
      matches(read(omnimapper::testing::sourceFile(cmake_lists)), R"(foreach\()" + variable + R"( ([^)]*)\))");
  return list.empty() ? std::vector<std::string>{} : matches(list.front(), R"((\w+))");
}

/// Names of the libraries, from the bottom to the top.
std::vector<std::string> libraryOrder() {
  return listed("libs/CMakeLists.txt", "lib");
}

std::set<std::string> includedLibraries(const path& file) {
  const auto includes = matches(read(file), R"(#include\s*[<"]omnimapper/(\w+)/)");
  return {includes.begin(), includes.end()};
}

/// Reports each line of code (comments and strings blanked) below a folder that contains the pattern, except in one
/// file.
void expectAbsent(const std::string& folder, const std::string& pattern, const std::string& why,
                  const std::string& but_for = "") {
  const std::regex regex(pattern);
  for (const path& file : files(folder, cpp_extensions)) {
    if (projectPath(file) == but_for) continue;
    const auto code = lines(codeOnly(read(file)));
    for (std::size_t i = 0; i < code.size(); ++i) {
      EXPECT_FALSE(std::regex_search(code[i], regex))
          << projectPath(file) << ":" << i + 1 << ": " << code[i] << "\n  " << why;
    }
  }
}

/// Reports each text file of the project that contains the pattern anywhere.
void expectAbsentFromText(const std::string& pattern, const std::string& why) {
  const std::regex regex(pattern);
  std::vector<path> all;
  for (const char* folder : {"libs", "apps", "tests", "scripts", "cmake", "ini", "doc", ".ci", ".github"}) {
    const auto below = files(folder, {".h", ".cpp", ".txt", ".cmake", ".in", ".ini", ".md", ".sh", ""});
    all.insert(all.end(), below.begin(), below.end());
  }
  for (const char* file : {"CMakeLists.txt", "README.md", "CONTRIBUTING.md", "CHANGELOG.md", "AGENTS.md"}) {
    all.emplace_back(omnimapper::testing::sourceFile(file));
  }
  for (const path& file : all) {
    const auto text = lines(read(file));
    for (std::size_t i = 0; i < text.size(); ++i) {
      EXPECT_FALSE(std::regex_search(text[i], regex))
          << projectPath(file) << ":" << i + 1 << ": " << text[i] << "\n  " << why;
    }
  }
}

void expectAtMostLines(const path& file, std::size_t limit) {
  const std::size_t length = lines(read(file)).size();
  EXPECT_LE(length, limit) << projectPath(file) << " has " << length << " lines; the limit is " << limit
                           << ": split it along its concepts";
}

TEST(SourceText, commentsAndLiteralsAreBlankedAndLinesStay) {
  EXPECT_EQ(codeOnly("a // b\nc /* d\ne */ f"), "a     \nc     \n     f");
  EXPECT_EQ(codeOnly(R"(x = "a\"b"; y = '"'; z = 1'000;)"), "x =       ; y =    ; z = 1'000;");
  EXPECT_EQ(codeOnly("r = R\"js(exit(1)\n\")js\" + s"), "r =             \n      + s");
}

TEST(HouseRules, librariesIncludeOnlyWhatStandsAboveThemAndTheirCMakeListsNames) {
  const auto order = libraryOrder();
  ASSERT_FALSE(order.empty()) << "no list of libraries found in libs/CMakeLists.txt";
  const auto rank = [&](const std::string& lib) { return std::find(order.begin(), order.end(), lib) - order.begin(); };
  for (const std::string& lib : order) {
    const auto named =
        matches(read(omnimapper::testing::sourceFile("libs/" + lib + "/CMakeLists.txt")), R"(omnimapper::(\w+))");
    for (const path& file : files("libs/" + lib, cpp_extensions)) {
      for (const std::string& used : includedLibraries(file)) {
        if (used == lib) continue;
        EXPECT_LT(rank(used), rank(lib)) << projectPath(file) << " includes omnimapper/" << used
                                         << ", which libs/CMakeLists.txt lists after " << lib;
        EXPECT_TRUE(std::count(named.begin(), named.end(), used) > 0)
            << projectPath(file) << " includes omnimapper/" << used << ", but libs/" << lib
            << "/CMakeLists.txt does not name omnimapper::" << used;
      }
    }
  }
}

// The folders of a library's private sources include one another in one direction only. Shared code is outside of them.
TEST(HouseRules, roomsOfALibraryIncludeInOneDirection) {
  for (const std::string& lib : folders("libs")) {
    std::set<std::pair<std::string, std::string>> includes;
    for (const path& file : files("libs/" + lib + "/src", {".h", ".cpp"})) {
      const std::string room = file.parent_path().filename();
      for (std::string other : matches(read(file), R"re(#include\s*"(?:\.\./)?(\w+)/)re"))
        includes.insert({room, other});
    }
    for (const auto& [room, other] : includes) {
      if (room >= other) continue;
      EXPECT_EQ(includes.count({other, room}), 0) << "libs/" << lib << "/src: " << room << " and " << other;
    }
  }
}

TEST(HouseRules, everyLibraryFolderIsListed) {
  auto order = libraryOrder();
  order.emplace_back("plugins");
  for (const std::string& folder : folders("libs")) {
    EXPECT_TRUE(std::count(order.begin(), order.end(), folder) > 0)
        << "libs/" << folder << " is missing from the list in libs/CMakeLists.txt";
  }
}

TEST(HouseRules, aFeatureStandsOnTheInterfaceOfPluginsAndOnNoOtherFeature) {
  const auto order = libraryOrder();
  const auto floor = std::find(order.begin(), order.end(), "mapper");
  ASSERT_NE(floor, order.end());
  const auto features = listed("libs/plugins/CMakeLists.txt", "feature");
  for (const std::string& feature : folders("libs/plugins")) {
    const std::string folder = "libs/plugins/" + feature;
    EXPECT_TRUE(std::count(features.begin(), features.end(), feature) > 0)
        << folder << " is missing from the list in libs/plugins/CMakeLists.txt";
    const auto named =
        matches(read(omnimapper::testing::sourceFile(folder + "/CMakeLists.txt")), R"(omnimapper::(\w+))");
    for (const path& file : files(folder, cpp_extensions)) {
      for (const std::string& used : includedLibraries(file)) {
        EXPECT_NE(std::find(order.begin(), floor, used), floor)
            << projectPath(file) << " includes omnimapper/" << used
            << ": features may use the libraries up to derived, but neither the engine nor what is above it";
        EXPECT_TRUE(std::count(named.begin(), named.end(), used) > 0)
            << projectPath(file) << " includes omnimapper/" << used << ", but " << folder
            << "/CMakeLists.txt does not name omnimapper::" << used;
      }
      for (const std::string& other : matches(read(file), R"(#include\s*"([^"]*)/)")) {
        ADD_FAILURE() << projectPath(file) << " includes from " << other
                      << ": code that two features share belongs in a library";
      }
    }
    EXPECT_FALSE(files("tests/plugins/" + feature, {".cpp"}).empty()) << folder << " has no test in tests/plugins";
  }
}

TEST(HouseRules, publicHeadersAreFreeOfPclOpenCvAndSolvers) {
  const std::regex foreign(R"(#include\s*[<"](pcl/|opencv|ceres/|suitesparse/|cholmod|Cholmod|amd\.h))");
  for (const path& file : files("libs", {".h"})) {
    if (projectPath(file).find("/include/") == std::string::npos) continue;
    for (const std::string& line : lines(read(file))) {
      EXPECT_FALSE(std::regex_search(line, foreign))
          << projectPath(file) << ": " << line << "\n  these libraries are PRIVATE: include them in .cpp files only";
    }
  }
}

TEST(HouseRules, publicHeadersAreGuardedByPragmaOnce) {
  for (const path& file : files("libs", {".h"})) {
    EXPECT_NE(read(file).find("#pragma once\n"), std::string::npos) << projectPath(file);
  }
}

TEST(HouseRules, appsAreShort) {
  for (const path& file : files("apps", cpp_extensions)) expectAtMostLines(file, 99);
}

TEST(HouseRules, filesAreShort) {
  for (const char* folder : {"libs", "tests"}) {
    for (const path& file : files(folder, cpp_extensions)) expectAtMostLines(file, 500);
  }
}

TEST(HouseRules, librariesNeitherPrintNorExit) {
  expectAbsent("libs", R"(\bstd::(cout|cerr|clog)\b|\b[fv]?printf\s*\(|\bputs\s*\()",
               "libraries do not print: return the text, throw base::Error or report to base::Progress");
  expectAbsent("libs", R"((^|[^.\w>])(std::)?(exit|quick_exit|abort|terminate)\s*\()",
               "libraries do not end the program: throw base::Error (a forked child may end itself with _exit)");
}

TEST(HouseRules, librariesReadNoWallClockAndSeedTheirRandomNumbers) {
  expectAbsent("libs", R"(system_clock|mrpt::Clock::now\b|mrpt::system::now\b|getCurrentTime|\btime\s*\((nullptr|0)\))",
               "time comes from the log, so that two runs agree in every bit; sensors use live::hostNow()",
               "libs/live/src/HostClock.cpp");
  expectAbsent("libs", R"(random_device|\bs?rand\s*\(|randomize\s*\(\s*\))", "random numbers come from a seed");
}

TEST(HouseRules, nothingIsLeftForLaterOrSwitchedOff) {
  const std::string to_do = std::string("TO") + "DO", fix_me = std::string("FIX") + "ME";
  expectAbsentFromText("\\b(" + to_do + "|" + fix_me + "|XX" + "X)\\b", "finish it, or make it an issue");
  expectAbsent("tests", R"(\bDISABLED_\w)", "run the test or delete it");
  for (const char* folder : {"libs", "apps", "tests"}) {
    expectAbsent(folder, R"(#\s*if\s+(0|false)\b)", "delete code that is switched off: git keeps it");
  }
}

TEST(HouseRules, aSkippedTestSaysWhy) {
  const std::regex bare(R"(\bGTEST_SKIP\s*\(\s*\)\s*;)");
  for (const path& file : files("tests", cpp_extensions)) {
    EXPECT_FALSE(std::regex_search(codeOnly(read(file)), bare))
        << projectPath(file) << " skips without a reason: GTEST_SKIP() << \"...\", or OMNIMAPPER_NEEDS";
  }
}

TEST(HouseRules, testsBoundNoWallTime) {
  for (const path& file : files("tests", cpp_extensions)) {
    if (projectPath(file).rfind("tests/bench/", 0) == 0) continue;
    EXPECT_FALSE(std::regex_search(codeOnly(read(file)),
                                   std::regex(R"((EXPECT|ASSERT)_L[TE]\([^;]*(steady_clock|ended\.seconds,))")))
        << projectPath(file) << " fails on a busy machine: wait for a state instead";
  }
}

TEST(HouseRules, nothingNamesAPlaceOnOneMachine) {
  const std::string slash = "/";
  expectAbsentFromText("(^|[^\\w.])" + slash + "(work|home|root|Users)" + slash,
                       "a path of one machine: take it from the command line, the INI or the source tree");
}

TEST(HouseRules, theLibrariesKnowNothingOfTheExampleFromOutside) {
  for (const path& file : files("libs")) {
    EXPECT_FALSE(std::regex_search(read(file), std::regex("beacon", std::regex::icase)))
        << projectPath(file) << " mentions doc/examples/beacons, which must not need support in the libraries";
  }
}

TEST(HouseRules, testFoldersMirrorTheLibraries) {
  const auto libraries = folders("libs");
  const std::vector<std::string> others{"bench", "fuzz", "system", "testing"};
  for (const std::string& folder : folders("tests")) {
    if (std::count(others.begin(), others.end(), folder) > 0) continue;
    EXPECT_TRUE(std::count(libraries.begin(), libraries.end(), folder) > 0)
        << "tests/" << folder << " has no library libs/" << folder;
  }
  for (const std::string& library : libraries) {
    EXPECT_FALSE(files("tests/" + library, {".cpp"}).empty())
        << "libs/" << library << " has no test in tests/" << library;
  }
  for (const path& file : files("tests", {".cpp"})) {
    const std::string name = file.stem();
    if (projectPath(file).rfind("tests/bench/", 0) == 0 || projectPath(file).rfind("tests/testing/", 0) == 0 ||
        projectPath(file).rfind("tests/system/package/", 0) == 0 ||
        projectPath(file).rfind("tests/drivers/players/", 0) == 0 ||
        projectPath(file).rfind("tests/drivers/openni2/", 0) == 0 ||
        projectPath(file).rfind("tests/fuzz/targets/", 0) == 0 || projectPath(file).rfind("tests/fuzz/runs/", 0) == 0 ||
        name == "LibFuzzer") {
      continue;
    }
    EXPECT_TRUE(name.size() > 4 && name.compare(name.size() - 4, 4, "Test") == 0)
        << projectPath(file) << " is not built: tests are named XTest.cpp";
  }
}

}  // namespace
