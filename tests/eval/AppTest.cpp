#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/surfaces/SurfaceSet.h>
#include <omnimapper/testing/Fixtures.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "Trajectories.h"

namespace omnimapper::eval::app_test {
namespace {

namespace fs = std::filesystem;

// Runs omnimapper-eval on two trajectories: the reference, and an estimate 0.1 m beside it in another world frame.
class EvalApp : public ::testing::Test {
 protected:
  void SetUp() override {
    reference_ = folder_ / "reference.tum";
    estimate_ = folder_ / "estimate.tum";
    const Trajectory walk = randomWalk(50, 1);
    writeTum(reference_, walk);
    writeTum(estimate_, inOtherWorld(someMotion(), walk));
  }
  // Returns the exit code; the output is in text_.
  int run(const std::string& arguments) {
    const auto program = fs::read_symlink("/proc/self/exe").parent_path() / "omnimapper-eval";
    const std::string out = folder_ / "printed.txt";
    const int status = std::system((program.string() + " " + arguments + " > " + out + " 2>&1").c_str());
    text_ = contentOf(out);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  static std::string contentOf(const std::string& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  bool printed(const std::string& words) const { return text_.find(words) != std::string::npos; }

  testing::ScratchFolder folder_;
  std::string reference_, estimate_, text_;
};

TEST_F(EvalApp, PrintsATableAndLeavesNumbersAndPlots) {
  const std::string out = folder_ / "results/ate";
  ASSERT_EQ(run("ate " + estimate_ + " " + reference_ + " --align se3 -o " + out + " --json " + folder_ / "n.json"), 0)
      << text_;
  EXPECT_TRUE(printed("50 pairs, 0 unpaired poses")) << text_;
  EXPECT_TRUE(printed("translation        0.0000")) << text_;
  for (const char* name : {"numbers.json", "errors.svg", "trajectory.svg"}) EXPECT_TRUE(fs::exists(out + "/" + name));
  EXPECT_EQ(contentOf(folder_ / "n.json"), contentOf(out + "/numbers.json"));
  EXPECT_NE(contentOf(folder_ / "n.json").find("\"translation_m\""), std::string::npos);
}

TEST_F(EvalApp, HoldsAMapAgainstTheTrueSurfacesInTheFrameOfTheTruth) {
  surfaces::SurfaceSet truth{"test", {}, {}};
  auto& wall = truth.surfaces.emplace_back();
  wall.name = "wall";
  wall.is = surfaces::SurfaceClass::wall;
  wall.plane = {-Eigen::Vector3d::UnitY(), 3};
  wall.parts.push_back({{{0, 3, 0}, {4, 3, 0}, {4, 3, 2}, {0, 3, 2}}, {}});
  const auto write = [](const std::string& path, const std::string& text) { std::ofstream(path) << text; };
  const std::string world = folder_ / "world", map = folder_ / "map";
  for (const auto& folder : {world, map}) fs::create_directories(folder);
  write(world + "/surfaces.json", toJson(truth));
  write(map + "/surfaces.json", toJson(surfaces::moved(truth, someMotion())));
  EXPECT_NE(run("map " + map + " " + world), 0);
  EXPECT_TRUE(printed("trajectory.tum: is missing")) << text_;
  fs::copy(estimate_, map + "/trajectory.tum");
  fs::copy(reference_, world + "/truth.tum");
  ASSERT_EQ(run("map " + map + " " + world + " -o " + folder_ / "quality"), 0) << text_;
  EXPECT_TRUE(printed("1 of 1")) << text_;
  for (const char* name : {"numbers.json", "plan.svg"}) EXPECT_TRUE(fs::exists(folder_ / "quality/" + name)) << name;
  ASSERT_EQ(run("map " + map + " " + world + " --align none"), 0) << text_;
  EXPECT_TRUE(printed("0 of 1")) << text_;
  EXPECT_NE(run("map " + (folder_ / "nowhere") + " " + world + " --align none"), 0);
  EXPECT_TRUE(printed("nowhere")) << text_;
}

TEST_F(EvalApp, HoldsAMapAgainstTheDepthImagesOfALog) {
  const auto code = [](base::ExitCode exit_code) { return static_cast<int>(exit_code); };
  const std::string home = testing::sourceFile("rawlogs/home_30s"), log = home + "/home_30s.rawlog";
  const std::string truth = home + "/truth.tum", map = folder_ / "map", out = folder_ / "views";
  // The floor, in another frame than the truth's.
  surfaces::SurfaceSet floor{"test", {}, {}};
  floor.surfaces.emplace_back().name = "floor";
  floor.surfaces.front().parts.push_back({{{-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}}, {}});
  fs::create_directories(map);
  std::ofstream(map + "/surfaces.json") << toJson(surfaces::moved(floor, someMotion()));
  writeTum(map + "/trajectory.tum", inOtherWorld(someMotion(), readTum(truth)));
  const std::string rest = " --interpolate 0.06 --views 10";
  ASSERT_EQ(run("views " + map + " " + log + " " + truth + rest + " -o " + out + " --json " + folder_ / "v.json"), 0)
      << text_;
  EXPECT_TRUE(printed("1 surfaces drawn in the map")) << text_;
  for (const char* name : {"numbers.json", "plan.svg"}) EXPECT_TRUE(fs::exists(out + "/" + name)) << name;
  EXPECT_EQ(contentOf(folder_ / "v.json"), contentOf(out + "/numbers.json"));
  EXPECT_NE(contentOf(folder_ / "v.json").find("\"surfaces_of_map\": [\n    \"floor\""), std::string::npos)
      << "the floor was found in the frame of the truth: " << contentOf(folder_ / "v.json");
  EXPECT_EQ(run("views " + map + " " + log), code(base::ExitCode::command_line));
  EXPECT_EQ(run("views " + map + " " + log + " " + truth + " --align sim3"), code(base::ExitCode::command_line));
  EXPECT_EQ(run("views " + map + " " + (folder_ / "nowhere") + " " + truth + rest),
            code(base::ExitCode::unreadable_input));
  EXPECT_TRUE(printed("nowhere")) << text_;
  EXPECT_EQ(run("views " + map + " " + log + " " + reference_ + " --align none"),
            code(base::ExitCode::unreadable_input));
  EXPECT_TRUE(printed("no depth image has a pose")) << text_;
  const std::string half = folder_ / "half.rawlog";
  fs::copy(log, half);
  fs::resize_file(half, fs::file_size(half) / 2);
  EXPECT_EQ(run("views " + map + " " + half + " " + truth + rest), code(base::ExitCode::damaged_input)) << text_;
  EXPECT_TRUE(printed("surfaces drawn in the map")) << "of what was readable: " << text_;
  EXPECT_EQ(run("views --help"), 0);
  EXPECT_TRUE(printed("omnimapper-eval views out/cabinet cabinet.rawlog cabinet.truth.tum")) << text_;
}

TEST_F(EvalApp, KnowsRelativeErrorAndRelations) {
  EXPECT_EQ(run("rpe " + estimate_ + " " + reference_ + " --delta 2 --unit s"), 0) << text_;
  EXPECT_TRUE(printed("48 spans")) << text_;
  std::ofstream(folder_ / "r.relations") << "1000000000 1000000001 0 0 0 0 0 0\n";
  EXPECT_EQ(run("relations " + estimate_ + " " + folder_ / "r.relations" + " -o " + folder_ / "r"), 0) << text_;
  EXPECT_TRUE(printed("1 relation judged, 0 missed")) << text_;
}

TEST_F(EvalApp, HelpShowsExamples) {
  EXPECT_EQ(run("--help"), 0);
  EXPECT_TRUE(printed("omnimapper-eval ate ")) << text_;
}

TEST_F(EvalApp, ExitCodesShowWhatIsWrong) {
  const auto code = [](base::ExitCode exit_code) { return static_cast<int>(exit_code); };
  const std::string files = estimate_ + " " + reference_;
  EXPECT_EQ(run(""), code(base::ExitCode::command_line));
  EXPECT_EQ(run("ate " + estimate_), code(base::ExitCode::command_line));
  EXPECT_EQ(run("ate " + files + " --algin se3"), code(base::ExitCode::command_line));
  EXPECT_EQ(run("ate " + files + " --align se4"), code(base::ExitCode::command_line));
  EXPECT_TRUE(printed("none | first | yaw | se3 | sim3")) << text_;
  EXPECT_EQ(run("rpe " + files + " --delta 0"), code(base::ExitCode::out_of_range));
  EXPECT_EQ(run("ate " + estimate_ + " " + folder_ / "missing.tum"), code(base::ExitCode::unreadable_input));
  EXPECT_TRUE(printed("missing.tum")) << text_;
  EXPECT_EQ(run("ate " + files + " -o " + reference_ + "/below"), code(base::ExitCode::unwritable_output));
}

}  // namespace
}  // namespace omnimapper::eval::app_test
