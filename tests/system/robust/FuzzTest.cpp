// Seeded random damage to a rawlog and to an INI file: whatever is in them, a run ends by itself, in time, with an exit
// code that doc/exit_codes.md explains and that is not "a defect of ours".
#include <fcntl.h>
#include <omnimapper/mapper/MappingRun.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include "../MapFolder.h"
#include "../Rawlogs.h"

namespace {

using namespace runs;
using omnimapper::testing::Dice;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::SimulatedLogOptions;

constexpr double kTimeLimit = 30;                 // [s] for a run of a fraction of a second
constexpr rlim_t kMemoryLimit = rlim_t{3} << 30;  // bytes beyond what the test itself has
constexpr const char* kIni = "ini/laser2d.ini";

std::size_t below(Dice& dice, std::size_t end) {
  return static_cast<std::size_t>(dice.uniform(0, static_cast<double>(end)));
}

/// Other values in the same places: bits, bytes and numbers changed.
void changeValue(std::string& bytes, Dice& dice) {
  const std::size_t at = below(dice, bytes.size());
  const double odd[] = {0, -1, 1e9, -1e30, 1e300, 1e-300, NAN, INFINITY};
  const double number = odd[below(dice, 8)];
  const auto number32 = static_cast<float>(number);
  switch (below(dice, 4)) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(dice, 8)));
      break;
    case 1:
      bytes[at] = static_cast<char>(below(dice, 256));
      break;
    case 2:
      if (at + sizeof number <= bytes.size()) std::memcpy(&bytes[at], &number, sizeof number);
      break;
    case 3:
      if (at + sizeof number32 <= bytes.size()) std::memcpy(&bytes[at], &number32, sizeof number32);
      break;
  }
}

/// Parts cut out, doubled, or the end cut off.
void changeStructure(std::string& bytes, Dice& dice) {
  const std::size_t at = below(dice, bytes.size()), length = 1 + below(dice, 200);
  switch (below(dice, 3)) {
    case 0:
      bytes.erase(at, length);
      break;
    case 1:
      bytes.insert(at, bytes.substr(below(dice, bytes.size()), length));
      break;
    case 2:
      bytes.resize(at);
      break;
  }
}

std::string damaged(std::string bytes, Dice& dice) {
  const bool in_place = dice.uniform(0, 1) < 0.7;
  for (std::size_t edits = 1 + below(dice, 4); edits > 0 && !bytes.empty(); --edits) {
    in_place ? changeValue(bytes, dice) : changeStructure(bytes, dice);
  }
  return bytes;
}

/// Changes words of an INI: a character, a number, a line doubled or gone.
std::string damagedIni(std::string text, Dice& dice) {
  static const std::string characters = "0123456789.-+e=[];#, \n\tabcxyz_$\"\\\xc3";
  for (std::size_t edits = 1 + below(dice, 4); edits > 0 && !text.empty(); --edits) {
    const std::size_t at = below(dice, text.size());
    const auto line = text.rfind('\n', at) + 1, end = std::min(text.find('\n', at) + 1, text.size());
    switch (below(dice, 4)) {
      case 0:
        text[at] = characters[below(dice, characters.size())];
        break;
      case 1:
        text.insert(at, 1, characters[below(dice, characters.size())]);
        break;
      case 2:
        if (end > line) text.erase(line, end - line);
        break;
      case 3:
        if (end > line) text.insert(line, text.substr(line, end - line));
        break;
    }
  }
  return text;
}

class Fuzz : public ::testing::Test {
 protected:
  Fuzz() {
    omnimapper::plugins::registerPlugins();
    SimulatedLogOptions options;
    options.place = SimulatedLogOptions::Place::box;
    options.laps = 0.15;
    options.odometry_rate = 10;
    options.lasers[0].rate = 5;
    options.lasers[0].beams = 61;
    log_ = rawlogs::bytesOf(SimulatedLog(options).observations()).text;
  }

  /// The exit code of a run, or the reason why it has none; in a process of its own.
  std::string outcome() {
    const pid_t child = ::fork();
    if (child == 0) run();
    const auto start = std::chrono::steady_clock::now();
    int status = 0;
    while (::waitpid(child, &status, WNOHANG) == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (std::chrono::steady_clock::now() - start < std::chrono::duration<double>(kTimeLimit)) continue;
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      return "does not end";
    }
    if (WIFSIGNALED(status)) return std::string("dies of ") + ::strsignal(WTERMSIG(status));
    return std::to_string(WEXITSTATUS(status));
  }

  void expectKnownOutcome() {
    static const std::set<std::string> known{"0", "3", "4", "5", "6", "7", "8", "9", "10", "11", "14"};
    const std::string found = outcome();
    EXPECT_EQ(known.count(found), 1U) << "it " << found << "; " << readFile(message_path_);
    ++outcomes_[found];
  }

  ScratchFolder scratch_;
  std::string log_, log_path_ = scratch_ / "x.rawlog", ini_path_ = scratch_ / "x.ini";
  std::string message_path_ = scratch_ / "message.txt";
  std::map<std::string, int> outcomes_;

 private:
  // What main() of omnimapper-graphslam does, without the time it takes to start.
  [[noreturn]] void run() {
    limitResources();
    auto code = ExitCode::internal;
    try {
      const auto config = omnimapper::base::Config::fromFile(ini_path_);
      omnimapper::mapper::RunRequest request;
      request.logs = {log_path_};
      request.output_folder = scratch_ / "map";
      omnimapper::base::Progress silent;
      code = omnimapper::mapper::runMapping(request, config, silent, [] { return false; }).code;
    } catch (const omnimapper::base::Error& error) {
      writeFile(message_path_, error.what());
      code = error.code();
    } catch (const std::exception& error) {
      writeFile(message_path_, error.what());
    }
    ::_exit(number(code));
  }
  static void limitResources() {
    std::ifstream statm("/proc/self/statm");
    rlim_t pages = 0;
    statm >> pages;
    const rlim_t bytes = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + kMemoryLimit;
    const rlimit memory{bytes, bytes}, no_core{0, 0};
    ::setrlimit(RLIMIT_AS, &memory);
    ::setrlimit(RLIMIT_CORE, &no_core);
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
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
  EXPECT_GT(outcomes_["0"], 0) << "a changed range is a range";
  EXPECT_GT(outcomes_["9"], 0);
}

TEST_F(Fuzz, DamagedInisNeverCrashARun) {
  writeFile(log_path_, log_);
  // All keys of the engine and of scan matching, so that their values are hit too.
  std::string ini = readFile(omnimapper::testing::sourceFile(kIni));
  for (unsigned seed = 0; seed < 80; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Dice dice(1000 + seed);
    writeFile(ini_path_, damagedIni(ini, dice));
    SCOPED_TRACE(readFile(ini_path_));
    expectKnownOutcome();
  }
  for (const auto& [outcome, count] : outcomes_) RecordProperty("outcome_" + outcome, count);
  EXPECT_GT(outcomes_["0"], 0);
  EXPECT_GT(outcomes_["3"], 0);
}

}  // namespace
