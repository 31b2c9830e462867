// Seeded random damage to a rawlog and to an INI file, in many small runs of forked processes, which saves the start of
// a program. Whatever the files contain, a run ends by itself, in time, with an exit code that doc/exit_codes.md
// explains and that is not "a defect of ours".
#include <omnimapper/base/ChildProcess.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/MappingRun.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>

#include "../../fuzz/runs/FileMutation.h"
#include "../MapFolder.h"
#include "../Rawlogs.h"

namespace {

using namespace runs;
using omnimapper::fuzz::below;
using omnimapper::fuzz::onceIn;
using omnimapper::testing::Dice;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::SimulatedLogOptions;

constexpr int kTimeLimit = 30'000;                              // [ms] for a run of a fraction of a second
constexpr std::uint64_t kMemoryLimit = std::uint64_t{3} << 30;  // bytes, in addition to those of the test itself
constexpr const char* kIni = "ini/laser2d.ini";

std::string damaged(std::string bytes, Dice& dice) {
  for (std::size_t edits = 1 + below(dice, 4); edits > 0; --edits) {
    onceIn(dice, 2) ? omnimapper::fuzz::changeNumber(bytes, dice) : omnimapper::fuzz::damageBytes(bytes, dice);
  }
  if (onceIn(dice, 10)) bytes.resize(below(dice, bytes.size() + 1));
  return bytes;
}

class Fuzz : public ::testing::Test {
 protected:
  Fuzz() {
    omnimapper::mapper::loadFeatures();
    SimulatedLogOptions options;
    options.place = SimulatedLogOptions::Place::box;
    options.laps = 0.15;
    options.odometry_rate = 10;
    options.lasers[0].rate = 5;
    options.lasers[0].beams = 61;
    log_ = rawlogs::bytesOf(SimulatedLog(options).observations()).text;
  }

  /// The exit code of a run in a separate process, or the reason why it has none.
  std::string outcome() {
    said_.clear();
    omnimapper::base::ChildProcess child([this](int to_parent) { return run(to_parent); }, kMemoryLimit);
    while (!child.isOver()) {
      if (!child.hear(said_, kTimeLimit)) return "does not end";
    }
    const int status = child.status();
    if (WIFSIGNALED(status)) return std::string("dies of ") + ::strsignal(WTERMSIG(status));
    return std::to_string(WEXITSTATUS(status));
  }

  void expectKnownOutcome() {
    static const std::set<std::string> known{"0", "3", "4", "5", "6", "7", "8", "9", "10", "11", "14"};
    const std::string found = outcome();
    EXPECT_EQ(known.count(found), 1U) << "it " << found << "; " << said_;
    ++outcomes_[found];
  }

  ScratchFolder scratch_;
  std::string log_, log_path_ = scratch_ / "x.rawlog", ini_path_ = scratch_ / "x.ini";
  std::string said_;  // reason of its failure that the run gave
  std::map<std::string, int> outcomes_;

 private:
  // Does what main() of omnimapper-graphslam does.
  int run(int to_parent) {
    const auto say = [&](const std::exception& error) {
      [[maybe_unused]] const auto written = ::write(to_parent, error.what(), std::strlen(error.what()));
    };
    auto code = ExitCode::internal;
    try {
      const auto config = omnimapper::base::Config::fromFile(ini_path_);
      omnimapper::mapper::RunRequest request;
      request.logs = {log_path_};
      request.output_folder = scratch_ / "map";
      omnimapper::base::Progress silent;
      code = omnimapper::mapper::runMapping(request, config, silent, [] { return false; }).code;
    } catch (const omnimapper::base::Error& error) {
      say(error);
      code = error.code();
    } catch (const std::exception& error) {
      say(error);
    }
    return number(code);
  }
};

TEST_F(Fuzz, DamagedRawlogsNeverCrashARun) {
  fs::copy(omnimapper::testing::sourceFile(kIni), ini_path_);
  for (unsigned seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Dice dice(seed);
    if (seed % 4 == 3) {
      rawlogs::writeGzip(log_path_, log_);
      writeFile(log_path_, damaged(readFile(log_path_), dice));
    } else {
      writeFile(log_path_, damaged(log_, dice));
    }
    expectKnownOutcome();
  }
  for (const auto& [outcome, count] : outcomes_) RecordProperty("outcome_" + outcome, count);
  EXPECT_GT(outcomes_["0"], 0) << "a log with a changed range is still valid";
  EXPECT_GT(outcomes_["9"], 0);
}

TEST_F(Fuzz, DamagedInisNeverCrashARun) {
  writeFile(log_path_, log_);
  // This INI sets keys of the engine and of scan matching, whose values are damaged, too.
  std::string ini = readFile(omnimapper::testing::sourceFile(kIni));
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Dice dice(1000 + seed);
    writeFile(ini_path_, omnimapper::fuzz::mutatedText(ini, dice));
    SCOPED_TRACE(readFile(ini_path_));
    expectKnownOutcome();
  }
  for (const auto& [outcome, count] : outcomes_) RecordProperty("outcome_" + outcome, count);
  EXPECT_GT(outcomes_["0"], 0);
  EXPECT_GT(outcomes_["3"], 0);
}

}  // namespace
