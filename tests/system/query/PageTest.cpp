// The page of omnimapper-serve in a real browser.
#include "../Runs.h"

namespace page_test {
namespace {

using namespace runs;
using omnimapper::testing::runProgram;
using omnimapper::testing::sourceFile;

bool isThere(const std::string& program) {
  return runProgram({"sh", "-c", "command -v " + program}).code == 0;
}

TEST(Page, IsUsedInABrowserAsPeopleDo) {
  for (const char* program : {"chromium", "node", "python3"})
    if (!isThere(program)) GTEST_SKIP() << program << " is not on this machine; scripts/packages-test.txt names it";
  const std::string puppeteer = (fs::path(omnimapper::testing::ownProgram("")).parent_path() / "../puppeteer").string();
  const Ended fetched = runProgram({"python3", sourceFile("scripts/lib/puppeteer.py"), puppeteer});
  if (fetched.code != 0) GTEST_SKIP() << "puppeteer-core is not there: " << fetched.err;

  const omnimapper::testing::ScratchFolder scratch;
  const std::string map = scratch / "map";
  ASSERT_TRUE(endedWith(ExitCode::ok, graphslam({"-q", "-i", sourceFile("ini/home_planes.ini"), "-r",
                                                 sourceFile("rawlogs/home_30s/home_30s.rawlog"), "-o", map})));
  const Ended driven = runProgram(
      {"node", sourceFile("tests/system/query/page/drive.mjs"), puppeteer + "/puppeteer-core-browser.js",
       fs::path(omnimapper::testing::ownProgram("omnimapper-serve")).parent_path(), map, scratch / "browser"});
  EXPECT_EQ(driven.code, 0) << driven.out << driven.err;
}

}  // namespace
}  // namespace page_test
