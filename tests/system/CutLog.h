#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/source/RawlogWriter.h>

#include <memory>
#include <string>

#include "MapFolder.h"

namespace runs {

/// Writes the observations of a log before `cut` to one rawlog, the others to another.
inline void cutLog(const std::string& log, omnimapper::base::Stamp cut, const std::string& first,
                   const std::string& second) {
  for (const bool early : {true, false}) {
    omnimapper::source::RawlogSource source(log);
    omnimapper::source::writeRawlog(early ? first : second, [&](omnimapper::source::RawlogWriter& writer) {
      while (const auto observation = source.next()) {
        if ((observation->timestamp < cut) == early) writer.add(*observation);
      }
    });
  }
}

/// A fixture with two laps of the simulated ring (ring.rawlog), the first lap alone (a.rawlog), the second lap alone
/// (b.rawlog), and the map of the first lap in the folder `first`.
class CutRing : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = std::make_unique<omnimapper::testing::ScratchFolder>();
    omnimapper::testing::SimulatedLogOptions options;
    options.laps = 2;
    log_ = std::make_unique<SimulatedLog>(options);
    log_->writeRawlog(file("ring.rawlog"));
    const double seconds = omnimapper::base::secondsBetween(log_->begin(), log_->end());
    cutLog(file("ring.rawlog"), log_->begin() + omnimapper::base::durationFromSeconds(seconds / 2), file("a.rawlog"),
           file("b.rawlog"));
    ASSERT_TRUE(endedWith(ExitCode::ok, map({file("a.rawlog")}, file("first"))));
  }
  static void TearDownTestSuite() {
    scratch_.reset();
    log_.reset();
  }
  static std::string file(const std::string& name) { return *scratch_ / name; }

  static inline std::unique_ptr<omnimapper::testing::ScratchFolder> scratch_;
  static inline std::unique_ptr<SimulatedLog> log_;
};

}  // namespace runs
