#include "PageServer.h"

#include <fcntl.h>
#include <omnimapper/base/Error.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <thread>
#include <utility>

namespace omnimapper::plugins {

namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void failToStart(const std::string& why) {
  throw base::Error(base::ExitCode::internal, "the server of the page cannot be started (" + why + ")");
}

/// The program beside the one that runs.
std::string programPath() {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  const auto path = self.parent_path() / "omnimapper-serve";
  if (!error && std::filesystem::exists(path, error)) return path.string();
  throw base::Error(base::ExitCode::unreadable_input,
                    "the page needs the program omnimapper-serve beside this one: build it, as scripts/build does, or "
                    "leave out the page");
}

/// Both ends of a pipe, which other child processes do not inherit.
struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) failToStart(std::strerror(errno));
    read = ends[0];
    write = ends[1];
  }
  ~Pipe() {
    if (read >= 0) ::close(read);
    if (write >= 0) ::close(write);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
};

pid_t spawn(const std::string& program, std::vector<std::string>& arguments, int input, int output) {
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (auto& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, output, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t process = -1;
  const int error = ::posix_spawn(&process, program.c_str(), &files, &attributes, words.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) failToStart(std::strerror(error));
  return process;
}

}  // namespace

PageServer::PageServer(std::vector<std::string> arguments) {
  constexpr auto kLongest = std::chrono::seconds(60);  // a large map is read first
  const std::string program = programPath();
  {
    Pipe input, output;
    process_ = spawn(program, arguments, input.read, output.write);
    to_child_ = std::exchange(input.write, -1);
    from_child_ = std::exchange(output.read, -1);
  }
  const auto begin = Clock::now();
  const auto has_address = [&] { return said_.find('\n', said_.find("http://")) != std::string::npos; };
  while (!has_address() && isRunning() && Clock::now() - begin < kLongest) hear(100);
  if (has_address()) return;
  if (isRunning()) ::kill(process_, SIGKILL);
  while (isRunning()) hear(100);
  hear(0);
  const std::string why = said_.empty() ? how_it_ended_ : said_;
  ::close(to_child_);
  ::close(from_child_);
  throw base::Error(base::ExitCode::unreadable_input,
                    "there is no page: " + why.substr(0, why.find_last_not_of('\n') + 1));
}

PageServer::~PageServer() {
  constexpr int kTries = 200;
  ::close(to_child_);  // which tells it to end
  for (int tries = 0; isRunning() && tries < kTries; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  if (isRunning()) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  ::close(from_child_);
}

void PageServer::hear(int milliseconds) {
  pollfd ready{from_child_, POLLIN, 0};
  while (::poll(&ready, 1, milliseconds) > 0) {
    char part[4096];
    const ssize_t count = ::read(from_child_, part, sizeof part);
    if (count <= 0) return;
    said_.append(part, static_cast<std::size_t>(count));
    milliseconds = 0;
  }
}

std::vector<std::string> PageServer::takeLines() {
  hear(0);
  std::vector<std::string> lines;
  for (auto end = said_.find('\n'); end != std::string::npos; end = said_.find('\n')) {
    if (end > 0) lines.push_back(said_.substr(0, end));
    said_.erase(0, end + 1);
  }
  return lines;
}

bool PageServer::isRunning() {
  if (!how_it_ended_.empty()) return false;
  int status = 0;
  if (::waitpid(process_, &status, WNOHANG) != process_) return true;
  how_it_ended_ = WIFSIGNALED(status) ? "it was ended by signal " + std::to_string(WTERMSIG(status))
                                      : "it ended with code " + std::to_string(WEXITSTATUS(status));
  return false;
}

}  // namespace omnimapper::plugins
