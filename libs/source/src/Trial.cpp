#include "Trial.h"

#include <fcntl.h>
#include <omnimapper/base/Error.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

#include "CompressedFile.h"
#include "ObjectReader.h"

namespace omnimapper::source {

namespace {

// What the child tells its parent, a byte at a time.
constexpr char kObject = 'o';     // one more object was read and used
constexpr char kGoodOrder = 'e';  // the reading came to an end of a kind that the parent can meet itself

[[noreturn]] void failTrial(const std::string& path) {
  throw base::Error(base::ExitCode::internal,
                    path + ": cannot be tried in a process of its own (" + std::strerror(errno) + ").");
}

void limitMemory() {
  std::ifstream statm("/proc/self/statm");
  rlim_t pages = 0;
  statm >> pages;
  const rlim_t bytes = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + (rlim_t{1} << 30);
  const rlimit limit{bytes, bytes};
  ::setrlimit(RLIMIT_AS, &limit);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
}

[[noreturn]] void readInChild(const std::string& path,
                              const std::function<void(mrpt::serialization::CSerializable&)>& use, int to_parent) {
  limitMemory();
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  const auto tell = [&](char what) {
    if (::write(to_parent, &what, 1) != 1) ::_exit(1);
  };
  try {
    ObjectReader reader(path);
    while (const auto object = reader.next()) {
      use(*object);
      tell(kObject);
    }
    if (reader.ending() != ObjectReader::Ending::corrupt) tell(kGoodOrder);
  } catch (...) {
  }
  ::_exit(0);
}

}  // namespace

bool isVerified(const std::string& path) {
  CompressedFile file(path);
  if (!file.isCompressed()) return false;
  std::vector<char> buffer(1 << 17);
  while (file.ending() == CompressedFile::Ending::open) file.read(buffer.data(), buffer.size());
  return file.ending() == CompressedFile::Ending::end;
}

Trial tryReading(const std::string& path, const std::function<void(mrpt::serialization::CSerializable&)>& use) {
  Trial trial;
  int channel[2];
  if (::pipe(channel) != 0) failTrial(path);
  const pid_t child = ::fork();
  if (child < 0) failTrial(path);
  if (child == 0) {
    ::close(channel[0]);
    readInChild(path, use, channel[1]);
  }
  ::close(channel[1]);
  trial.may_read_next = false;
  char told[4096];
  for (ssize_t n; (n = ::read(channel[0], told, sizeof told)) > 0 || (n < 0 && errno == EINTR);) {
    for (ssize_t i = 0; i < n; ++i) {
      if (told[i] == kObject) ++trial.objects;
      if (told[i] == kGoodOrder) trial.may_read_next = true;
    }
  }
  ::close(channel[0]);
  ::waitpid(child, nullptr, 0);
  return trial;
}

}  // namespace omnimapper::source
