#include <fcntl.h>
#include <omnimapper/testing/ChildProgram.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <thread>

#include "ProcessGroup.h"

namespace omnimapper::testing {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

int memoryFile(const char* name) {
  const int fd = ::memfd_create(name, MFD_CLOEXEC);
  if (fd < 0)
    throw std::runtime_error(std::string("cannot make a file in memory for ") + name + ": " + std::strerror(errno));
  return fd;
}

std::string contentOf(int fd) {
  struct stat file {};
  ::fstat(fd, &file);  // the offset is the program's
  std::string content(static_cast<std::size_t>(file.st_size), '\0');
  const ssize_t read = ::pread(fd, content.data(), content.size(), 0);
  content.resize(read < 0 ? 0 : static_cast<std::size_t>(read));
  return content;
}

// Becomes the program. Runs in the child process, which has one thread.
[[noreturn]] void become(const std::vector<std::string>& argv, const ProgramOptions& options, int out, int err) {
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::setpgid(0, 0);  // so that its own child processes end with it
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  const rlimit no_core{0, 0}, file{options.largest_file, options.largest_file};
  ::setrlimit(RLIMIT_CORE, &no_core);
  if (options.largest_file > 0) ::setrlimit(RLIMIT_FSIZE, &file);
  std::vector<char*> words;
  for (const auto& word : argv) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  ::execvp(words[0], words.data());
  ::dprintf(STDERR_FILENO, "%s: %s\n", words[0], std::strerror(errno));
  ::_exit(127);
}

}  // namespace

std::string toString(const Ended& ended) {
  std::string how = "ended with code " + std::to_string(ended.code);
  if (ended.signal != 0) how = std::string("was ended by signal ") + ::strsignal(ended.signal);
  if (!ended.in_time) how = "was killed after " + std::to_string(ended.own_seconds) + " s of its own";
  return how + "\nstdout: " + ended.out + "\nstderr: " + ended.err;
}

Program::Program(const std::vector<std::string>& argv, const ProgramOptions& options)
    : out_(memoryFile("stdout")), err_(memoryFile("stderr")), limit_(options.limit), start_(now()), looked_(start_) {
  child_ = ::fork();
  if (child_ < 0) throw std::runtime_error(std::string("cannot start ") + argv.at(0) + ": " + std::strerror(errno));
  if (child_ == 0) become(argv, options, out_, err_);
}

Program::~Program() {
  kill();
  ::close(out_);
  ::close(err_);
}

double Program::secondsSinceStart() const {
  return now() - start_;
}

bool Program::reap(bool block) {
  if (has_ended_) return true;
  int status = 0;
  pid_t reaped = 0;
  rusage used{};
  do reaped = ::wait4(child_, &status, block ? 0 : WNOHANG, &used);
  while (reaped < 0 && errno == EINTR);
  if (reaped != child_) return false;
  has_ended_ = true;
  ended_.seconds = secondsSinceStart();
  ended_.peak_mib = static_cast<double>(used.ru_maxrss) / 1024;
  if (WIFEXITED(status)) ended_.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) ended_.signal = WTERMSIG(status);
  ended_.out = contentOf(out_);
  ended_.err = contentOf(err_);
  return true;
}

bool Program::isRunning() {
  return !reap(false);
}

std::string Program::saidSoFar() const {
  return contentOf(err_);
}

std::string Program::printedSoFar() const {
  return contentOf(out_);
}

bool Program::hasOpen(const std::string& path) const {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path wanted = fs::canonical(path);
  for (const auto& file : fs::directory_iterator("/proc/" + std::to_string(child_) + "/fd", error)) {
    if (fs::read_symlink(file, error) == wanted) return true;
  }
  return false;
}

void Program::send(int signal) {
  if (isRunning()) ::kill(child_, signal);
}

void Program::kill() {
  if (isRunning() && ::kill(-child_, SIGKILL) != 0) ::kill(child_, SIGKILL);
  reap(true);
}

// While a thread has work, only the time on the cores counts, else all of it. A look that comes late, because this
// program had no core either, counts as one in time.
void Program::look() {
  constexpr double kLongest = 0.2;
  const auto group = lookAtProcessGroup(child_);
  const double time = now(), passed = std::min(time - looked_, kLongest);
  const double used = std::max(0.0, group.processor_seconds - processor_seconds_);
  ended_.own_seconds += group.has_work ? std::min(passed, used) : passed;
  looked_ = time;
  processor_seconds_ = group.processor_seconds;
}

bool Program::waitUntilIdle() {
  double used = -1;
  for (int quiet = 0; quiet < 10; ++quiet) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const auto group = lookAtProcessGroup(child_);
    if (group.has_work || group.processor_seconds != used) quiet = 0;
    used = group.processor_seconds;
    if (!isRunning()) return false;
  }
  return true;
}

Ended Program::wait() {
  while (isRunning()) {
    if (now() - looked_ > 0.1) look();
    if (ended_.own_seconds > limit_) {
      ended_.in_time = false;
      kill();
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return ended_;
}

Ended runProgram(const std::vector<std::string>& argv, const ProgramOptions& options) {
  return Program(argv, options).wait();
}

std::string ownProgram(const std::string& name) {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
}

}  // namespace omnimapper::testing
