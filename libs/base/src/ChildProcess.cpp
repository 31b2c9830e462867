#include <fcntl.h>
#include <omnimapper/base/ChildProcess.h>
#include <omnimapper/base/Error.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>

namespace omnimapper::base {

namespace {

// Exit codes of the child. Sanitizers use 1 for crashes, and the shell uses 126 and above.
constexpr int kFinished = 0, kOutOfMemory = 101, kThrew = 102;

// Bytes of address space that this process uses.
rlim_t held() {
  std::ifstream statm("/proc/self/statm");
  rlim_t pages = 0;
  statm >> pages;
  return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

bool mayHave(rlim_t bytes) {
  rlimit memory{};
  return ::getrlimit(RLIMIT_AS, &memory) != 0 || memory.rlim_cur == RLIM_INFINITY || memory.rlim_cur >= bytes;
}

// Limits the memory of the child and silences it.
void limit(std::uint64_t bytes) {
  const rlim_t most = held() + bytes;
  const rlimit memory{most, most}, no_core{0, 0};
  ::setrlimit(RLIMIT_AS, &memory);
  ::setrlimit(RLIMIT_CORE, &no_core);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
}

int exitCodeOf(const std::function<void()>& work, int to_parent) {
  try {
    work();
  } catch (const std::bad_alloc&) {
    return kOutOfMemory;
  } catch (const std::exception& error) {
    [[maybe_unused]] const auto written = ::write(to_parent, error.what(), std::strlen(error.what()));
    return kThrew;
  }
  return kFinished;
}

}  // namespace

ChildProcess::ChildProcess(const std::function<int(int to_parent)>& work, std::uint64_t bytes) {
  int channel[2];
  const bool has_channel = ::pipe2(channel, O_CLOEXEC) == 0;
  if (has_channel) process_ = ::fork();
  if (process_ < 0) {
    if (has_channel) ::close(channel[0]), ::close(channel[1]);
    throw Error(ExitCode::internal, std::string("no child process can be started (") + std::strerror(errno) + ")");
  }
  if (process_ == 0) {
    ::close(channel[0]);
    limit(bytes);
    ::_exit(work(channel[1]));
  }
  ::close(channel[1]);
  from_child_ = channel[0];
}

ChildProcess::~ChildProcess() {
  if (process_ > 0) ::kill(process_, SIGKILL);
  ::close(from_child_);
  status();
}

bool ChildProcess::hear(std::string& said, int milliseconds) {
  pollfd ready{from_child_, POLLIN, 0};
  if (::poll(&ready, 1, milliseconds) <= 0) return false;
  char part[4096];
  const ssize_t count = ::read(from_child_, part, sizeof part);
  if (count > 0) said.append(part, static_cast<std::size_t>(count));
  is_over_ = count == 0 || (count < 0 && errno != EINTR);
  return true;
}

int ChildProcess::status() {
  if (process_ < 0) return status_;
  while (::waitpid(process_, &status_, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return status_;
}

ChildOutcome tryInChild(const std::function<void()>& work, std::uint64_t bytes) {
  ChildProcess child([&work](int to_parent) { return exitCodeOf(work, to_parent); }, bytes);
  ChildOutcome end;
  while (!child.isOver()) child.hear(end.message, -1);
  const int status = child.status();
  // The kernel kills a process with SIGKILL if the machine runs out of memory.
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) throw std::bad_alloc();
  if (!WIFEXITED(status)) return end;
  switch (WEXITSTATUS(status)) {
    case kFinished:
      end.how = ChildOutcome::How::finished;
      break;
    case kThrew:
      end.how = ChildOutcome::How::threw;
      break;
    case kOutOfMemory:
      if (!mayHave(held() + bytes)) throw std::bad_alloc();
      end.how = ChildOutcome::How::out_of_memory;
      break;
    default:
      break;
  }
  return end;
}

}  // namespace omnimapper::base
