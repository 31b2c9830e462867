#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::testing {

/// How a program ended, and what it printed.
struct Ended {
  int code = -1;           ///< exit code; -1 if a signal ended it
  int signal = 0;          ///< the signal that ended it; 0 if it left by itself
  bool in_time = true;     ///< false if it was killed at its limit
  std::string out, err;    ///< standard output and error, whole
  double seconds = 0;      ///< [s] from start to end
  double own_seconds = 0;  ///< [s] the same, but without the time in which other programs had the cores
  double peak_mib = 0;     ///< largest memory in use [MiB]
};

/// How it ended, then what it printed, for messages of tests.
std::string toString(const Ended& ended);

struct ProgramOptions {
  double limit = 120;              ///< [s] of Ended::own_seconds after which the program is killed
  std::uint64_t largest_file = 0;  ///< [bytes] a write beyond this size of a file fails; 0: no limit
};

/// A program that runs as a child process. The destructor ends it.
class Program {
 public:
  /// Starts the program. argv[0] is a path, or a name that is searched as by a shell.
  explicit Program(const std::vector<std::string>& argv, const ProgramOptions& options = {});
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  bool isRunning();
  /// What the program has written to its standard error until now.
  std::string saidSoFar() const;
  /// What it has written to its standard output until now.
  std::string printedSoFar() const;
  /// Whether the program has that file open now.
  bool hasOpen(const std::string& path) const;
  /// Waits until neither the program nor one that it started has had anything to do for half a second. Returns false if
  /// the program has ended instead.
  bool waitUntilIdle();
  /// Sends the program a signal, unless it has ended.
  void send(int signal);
  /// Waits for the end of the program. May be called again, with the same result.
  Ended wait();

 private:
  void kill();  ///< kills the program and all processes that it started
  void look();  ///< adds to Ended::own_seconds what has passed since it was called last
  bool reap(bool block);
  double secondsSinceStart() const;

  pid_t child_ = -1;
  int out_ = -1, err_ = -1;  // files in memory
  double limit_, start_;
  double looked_, processor_seconds_ = 0;  // when look() was called last, and what it saw
  bool has_ended_ = false;
  Ended ended_;
};

/// Starts a program and waits for its end.
Ended runProgram(const std::vector<std::string>& argv, const ProgramOptions& options = {});

/// Path of a program of the project, such as "omnimapper-graphslam", which is in the folder of the test.
std::string ownProgram(const std::string& name);

}  // namespace omnimapper::testing
