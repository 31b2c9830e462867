// Logs for which nothing was tuned, each in four variants; a short form of bench-robustness. No map may be wrong.
#include "../../bench/UntunedLogs.h"
#include "../MapFolder.h"

namespace {

using namespace runs;
using omnimapper::testing::LogVariant;
using omnimapper::testing::nameOf;

class UntunedLog : public ::testing::TestWithParam<const char*> {};

TEST_P(UntunedLog, IsMappedAlikeInEveryVariant) {
  const auto log = untuned::logNamed(GetParam());
  OMNIMAPPER_NEEDS(log);
  const omnimapper::testing::ScratchFolder scratch;
  const std::string path = scratch / "log.rawlog", folder = scratch / "map";
  const auto observations = untuned::read(*log);
  for (const auto variant :
       {LogVariant::as_it_is, LogVariant::reversed, LogVariant::every_second_scan, LogVariant::narrow_laser}) {
    if (variant == LogVariant::every_second_scan && log->is_thin) continue;
    untuned::writeVariant(observations, variant, path);
    ASSERT_TRUE(endedWith(ExitCode::ok, map({path}, folder, {"--set", "mapper.output_plugins=trajectory"})));
    const double error = untuned::errorOf(loadTrajectory(folder), untuned::truthOf(*log, observations, variant));
    RecordProperty(nameOf(variant), std::to_string(error));
    EXPECT_LT(error, untuned::kWrong) << nameOf(variant);
  }
}

// The first three are on every machine that has MRPT.
INSTANTIATE_TEST_SUITE_P(Logs, UntunedLog,
                         ::testing::Values("malaga", "simul", "range_030_bearing_015", "aces", "mit-csail",
                                           "belgioioso"),
                         [](const auto& info) {
                           std::string name = info.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
