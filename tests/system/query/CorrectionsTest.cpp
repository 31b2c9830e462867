// omnimapper-edit, and what a later session makes of its corrections.
#include <nlohmann/json.hpp>

#include "../Runs.h"

namespace corrections_test {
namespace {

using namespace runs;
using nlohmann::json;
using omnimapper::testing::sourceFile;

Ended run(const std::string& program, Texts arguments) {
  arguments.insert(arguments.begin(), omnimapper::testing::ownProgram(program));
  return omnimapper::testing::runProgram(arguments);
}

json asked(const std::string& map, Texts question) {
  question.insert(question.begin(), map);
  question.push_back("--json");
  return json::parse(run("omnimapper-query", question).out, nullptr, false);
}

std::set<std::string> cabinets(const std::string& map) {
  std::set<std::string> ids;
  const json answer = asked(map, {"list", "cabinet"});
  for (const auto& place : answer["places"]) ids.insert(place["id"].get<std::string>());
  return ids;
}

TEST(Corrections, ADeletedLandmarkStaysDeletedWhenTheMapIsContinuedWithALogThatShowsIt) {
  const omnimapper::testing::ScratchFolder folder;
  const std::string first = folder / "first", both = folder / "both";
  const Texts mapping{"-q", "-i", sourceFile("ini/home_planes.ini"), "-r",
                      sourceFile("rawlogs/home_30s/home_30s.rawlog")};
  const auto map = [&](const Texts& more) {
    Texts words = mapping;
    words.insert(words.end(), more.begin(), more.end());
    return graphslam(words);
  };
  ASSERT_TRUE(endedWith(ExitCode::ok, map({"-o", first})));
  auto left = cabinets(first);
  ASSERT_GE(left.size(), 2U);
  const std::string deleted = *left.rbegin();
  left.erase(deleted);
  EXPECT_EQ(run("omnimapper-edit", {first, "delete", deleted}).out, "cabinet " + deleted + " is deleted\n");
  EXPECT_TRUE(endedWith(ExitCode::command_line, run("omnimapper-edit", {first, "delete", deleted}), {deleted}));
  EXPECT_EQ(cabinets(first), left);

  ASSERT_TRUE(endedWith(ExitCode::ok, map({"--continue", first, "-o", both, "--set", "session.start=anywhere"})));
  EXPECT_EQ(cabinets(both), left);
  EXPECT_EQ(asked(both, {"deleted"})["deleted"][0]["id"], deleted);
  const auto loops = asked(both, {"loops"})["loops"];
  ASSERT_FALSE(loops.empty()) << "the sessions are tied by a loop closure";
  EXPECT_EQ(loops[0]["key_frames"][1].get<std::string>().substr(0, 2), "1:");
}

}  // namespace
}  // namespace corrections_test
