#include <fcntl.h>
#include <omnimapper/base/ChildTrial.h>
#include <omnimapper/base/Error.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>

namespace omnimapper::base {

namespace {

constexpr int kFinished = 0, kOutOfMemory = 1;

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

[[noreturn]] void doInChild(const std::function<void()>& work, std::uint64_t bytes) {
  becomeTrial(bytes);
  try {
    work();
  } catch (const std::bad_alloc&) {
    ::_exit(kOutOfMemory);
  } catch (...) {
  }
  ::_exit(kFinished);
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
  const pid_t child = ::fork();
  if (child < 0) {
    throw Error(ExitCode::internal, std::string("no child process can be started (") + std::strerror(errno) + ")");
  }
  if (child == 0) doInChild(work, bytes);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  // The machine ends with SIGKILL what takes the last of its memory.
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) throw std::bad_alloc();
  if (!WIFEXITED(status)) return TrialEnd::crashed;
  if (WEXITSTATUS(status) != kOutOfMemory) return TrialEnd::finished;
  if (!mayHave(held() + bytes)) throw std::bad_alloc();
  return TrialEnd::out_of_memory;
}

}  // namespace omnimapper::base
