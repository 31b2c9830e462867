#include <fcntl.h>
#include <omnimapper/base/ChildTrial.h>
#include <omnimapper/base/Error.h>
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

// Exit codes of the child.
constexpr int kFinished = 0, kOutOfMemory = 1, kThrew = 2;

// Of address space, by this process.
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

[[noreturn]] void doInChild(const std::function<void()>& work, std::uint64_t bytes, int to_parent) {
  becomeTrial(bytes);
  try {
    work();
  } catch (const std::bad_alloc&) {
    ::_exit(kOutOfMemory);
  } catch (const std::exception& error) {
    [[maybe_unused]] const auto written = ::write(to_parent, error.what(), std::strlen(error.what()));
    ::_exit(kThrew);
  }
  ::_exit(kFinished);
}

// To its end.
std::string readAll(int file) {
  std::string all;
  char part[4096];
  for (;;) {
    const ssize_t count = ::read(file, part, sizeof part);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return all;
    all.append(part, static_cast<std::size_t>(count));
  }
}

}  // namespace

void becomeTrial(std::uint64_t bytes) {
  const rlim_t most = held() + bytes;
  const rlimit memory{most, most}, no_core{0, 0};
  ::setrlimit(RLIMIT_AS, &memory);
  ::setrlimit(RLIMIT_CORE, &no_core);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
}

TrialEnd tryInChild(const std::function<void()>& work, std::uint64_t bytes) {
  int channel[2];
  const bool has_channel = ::pipe2(channel, O_CLOEXEC) == 0;
  const pid_t child = has_channel ? ::fork() : -1;
  if (child < 0) {
    if (has_channel) ::close(channel[0]), ::close(channel[1]);
    throw Error(ExitCode::internal, std::string("no child process can be started (") + std::strerror(errno) + ")");
  }
  if (child == 0) doInChild(work, bytes, channel[1]);
  ::close(channel[1]);
  TrialEnd end;
  end.message = readAll(channel[0]);
  ::close(channel[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  // The machine ends with SIGKILL what takes the last of its memory.
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) throw std::bad_alloc();
  if (!WIFEXITED(status)) return end;
  switch (WEXITSTATUS(status)) {
    case kFinished:
      end.how = TrialEnd::How::finished;
      break;
    case kThrew:
      end.how = TrialEnd::How::threw;
      break;
    case kOutOfMemory:
      if (!mayHave(held() + bytes)) throw std::bad_alloc();
      end.how = TrialEnd::How::out_of_memory;
      break;
    default:
      break;
  }
  return end;
}

}  // namespace omnimapper::base
