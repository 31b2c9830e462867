#pragma once

#include <omnimapper/source/RawlogSource.h>

#include <cstdlib>
#include <memory>
#include <sstream>
#include <vector>

#include "../Runs.h"

/// Runs omnimapper-perceive with ini/perceive.ini.
namespace perceived {

using namespace runs;
using omnimapper::testing::runProgram;
using Observations = std::vector<mrpt::obs::CObservation::Ptr>;

inline Texts perceiving(const std::string& log, const std::string& output, const Texts& more) {
  Texts words{omnimapper::testing::ownProgram("omnimapper-perceive"),
              "-i",
              omnimapper::testing::sourceFile("ini/perceive.ini"),
              "-r",
              log,
              "-o",
              output};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

inline Ended perceive(const std::string& log, const std::string& output, const Texts& more = {}) {
  return runProgram(perceiving(log, output, more));
}

inline Observations readLog(const std::string& path) {
  omnimapper::source::RawlogSource source(path);
  Observations all;
  while (const auto observation = source.next()) all.push_back(observation);
  EXPECT_EQ(source.report().exitCode(), ExitCode::ok);
  return all;
}

template <class Class>
std::vector<std::shared_ptr<const Class>> ofClass(const Observations& observations) {
  std::vector<std::shared_ptr<const Class>> found;
  for (const auto& observation : observations) {
    if (auto cast = std::dynamic_pointer_cast<const Class>(observation)) found.push_back(std::move(cast));
  }
  return found;
}

/// Writes raw.rawlog to the scratch folder from the first `count` pairs of a folder of images in the format of TUM.
inline void importFirst(const std::string& folder, int count, const std::string& intrinsics,
                        const omnimapper::testing::ScratchFolder& scratch) {
  const std::string some = scratch / "some";
  fs::create_directories(some);
  for (const char* images : {"depth", "rgb"})
    fs::create_directory_symlink(fs::path(folder) / images, some + "/" + images);
  fs::copy_file(fs::path(folder) / "rgb.txt", some + "/rgb.txt");
  std::istringstream all(readFile(folder + "/depth.txt"));
  std::string first;
  for (std::string line; count > 0 && std::getline(all, line); first += line + "\n") count -= line[0] != '#';
  writeFile(some + "/depth.txt", first);
  ASSERT_TRUE(endedWith(ExitCode::ok, runProgram({omnimapper::testing::ownProgram("omnimapper-import"), "tum", some,
                                                  scratch / "raw.rawlog", "--intrinsics", intrinsics})));
}

inline bool isInstalled(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// A fixture that perceives 30 s in a simulated home with 16 depth images and 301 scans.
class PerceivedHome : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(endedWith(ExitCode::ok, perceive(kHome, derived_))); }

  const std::string kHome = omnimapper::testing::sourceFile("rawlogs/home_30s/home_30s.rawlog");
  omnimapper::testing::ScratchFolder scratch_;
  const std::string derived_ = scratch_ / "home.rawlog";
};

}  // namespace perceived
