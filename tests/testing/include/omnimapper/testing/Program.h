#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::testing {

/// How a program came to its end, and what it printed.
struct Ended {
  int code = -1;         ///< exit code; -1 if a signal ended it
  int signal = 0;        ///< the signal that ended it; 0 if it left by itself
  bool in_time = true;   ///< false if it was killed because its time was over
  std::string out, err;  ///< standard output and error, whole
  double seconds = 0;    ///< from its start to its end
  double peak_mib = 0;   ///< most memory that it held at a time [MiB]
};

/// One word or two on how it ended, then what it printed: for messages of tests.
std::string toString(const Ended& ended);

struct ProgramOptions {
  double time_limit = 120;         ///< [s] then it is killed
  std::uint64_t largest_file = 0;  ///< bytes; a file that would grow larger cannot be written; 0: no limit
};

/// A program as a process of its own. It does not outlive this object.
class Program {
 public:
  /// Starts it: argv[0] is a path, or a name to be found as a shell does.
  explicit Program(const std::vector<std::string>& argv, const ProgramOptions& options = {});
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  bool isRunning();
  /// Whether it has that file open now.
  bool hasOpen(const std::string& path) const;
  /// Sends it a signal, unless it has ended.
  void send(int signal);
  /// Waits for its end; the same answer every time.
  Ended wait();

 private:
  void kill();  ///< and all that it started
  bool reap(bool block);
  double secondsSinceStart() const;

  pid_t child_ = -1;
  int out_ = -1, err_ = -1;  // files in memory
  double time_limit_, start_;
  bool has_ended_ = false;
  Ended ended_;
};

/// Starts it and waits for its end.
Ended runProgram(const std::vector<std::string>& argv, const ProgramOptions& options = {});

/// Path of a program of the project, such as "omnimapper-graphslam": it lies beside the test.
std::string ownProgram(const std::string& name);

}  // namespace omnimapper::testing
