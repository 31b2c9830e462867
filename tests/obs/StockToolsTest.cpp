#include <gtest/gtest.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>
#include <omnimapper/testing/Fixtures.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace omnimapper::obs::stock_tools_test {
namespace {

std::string outputOf(const std::string& command) {
  std::string output;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  char buffer[4096];
  for (std::size_t n; pipe && (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) output.append(buffer, n);
  if (pipe) ::pclose(pipe);
  return output;
}

bool rawlogEditIsInstalled() {
  return std::system("command -v rawlog-edit >/dev/null 2>&1") == 0;
}

class StockTools : public ::testing::Test {
 protected:
  void SetUp() override {
    if (testing::kIsSanitized) GTEST_SKIP() << "a stock tool cannot load a library that is built with a sanitizer";
    if (!rawlogEditIsInstalled()) GTEST_SKIP() << "rawlog-edit (Debian package mrpt-apps) is not installed";
    mrpt::io::CFileGZOutputStream out(rawlog_);
    auto archive = mrpt::serialization::archiveFrom(out);
    for (int i = 1; i <= 3; ++i) {
      CObservationRelativeMotion motion;
      motion.begin = base::stampFromUnix(i);
      motion.timestamp = base::stampFromUnix(i + 1);
      motion.sensorLabel = "wheels";
      motion.begin_from_end = mrpt::poses::CPose3D(0.125 * i, 0, 0, 0.5, 0, 0);
      archive << motion;
    }
  }
  std::string tool(const std::string& arguments) const {
    // In the folder itself: --export-txt of 2.5.8 loses the slash between folder and file.
    return outputOf("cd '" + folder_.path() + "' && rawlog-edit -p '" OMNIMAPPER_OBS_LIBRARY "' -i motion.rawlog " +
                    arguments);
  }

  testing::ScratchFolder folder_;
  std::string rawlog_ = folder_ / "motion.rawlog";
};

TEST_F(StockTools, rawlogEditDescribesOurClassOnceItHasLoadedOurLibrary) {
  const std::string text = tool("--describe");
  EXPECT_NE(text.find("CObservationRelativeMotion"), std::string::npos) << text;
  EXPECT_NE(text.find("x y z [m]: 0.375 0 0"), std::string::npos) << text;
}

TEST_F(StockTools, rawlogEditExportsOurClassAsText) {
  const std::string text = tool("--export-txt");
  std::ifstream file(folder_ / "motion_wheels.txt");
  ASSERT_TRUE(file) << text;
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 4u);
  std::istringstream row(lines[3]);
  double end = 0, begin = 0, x = 0;
  row >> end >> begin >> x;
  EXPECT_EQ(end, 4);
  EXPECT_EQ(begin, 3);
  EXPECT_EQ(x, 0.375);
}

}  // namespace
}  // namespace omnimapper::obs::stock_tools_test
