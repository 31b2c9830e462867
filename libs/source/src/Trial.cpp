#include "Trial.h"

#include <fcntl.h>
#include <omnimapper/base/ChildTrial.h>
#include <omnimapper/base/Error.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

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

[[noreturn]] void readInChild(const std::string& path,
                              const std::function<void(mrpt::serialization::CSerializable&)>& use, int to_parent) {
  constexpr std::uint64_t kMemory = std::uint64_t{1} << 30;
  base::becomeTrial(kMemory);
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

Trial::Trial(const std::string& path, const std::function<void(mrpt::serialization::CSerializable&)>& use) {
  int channel[2];
  if (::pipe2(channel, O_CLOEXEC) != 0) failTrial(path);
  child_ = ::fork();
  if (child_ < 0) {
    ::close(channel[0]);
    ::close(channel[1]);
    failTrial(path);
  }
  if (child_ == 0) {
    ::close(channel[0]);
    readInChild(path, use, channel[1]);
  }
  ::close(channel[1]);
  from_child_ = channel[0];
}

Trial::~Trial() {
  ::kill(child_, SIGKILL);
  ::close(from_child_);
  while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

Trial::Answer Trial::mayReadAfter(std::uint64_t objects, const std::function<bool()>& stop) {
  while (objects >= objects_ && !is_over_) {
    if (!isToldWithin(100) && stop()) return Answer::not_known;
  }
  return objects < objects_ || has_good_ending_ ? Answer::yes : Answer::no;
}

// False if the child says nothing for so long.
bool Trial::isToldWithin(int milliseconds) {
  pollfd ready{from_child_, POLLIN, 0};
  if (::poll(&ready, 1, milliseconds) <= 0) return false;
  char told[4096];
  const ssize_t n = ::read(from_child_, told, sizeof told);
  is_over_ = n == 0 || (n < 0 && errno != EINTR);
  for (ssize_t i = 0; i < n; ++i) {
    if (told[i] == kObject) ++objects_;
    if (told[i] == kGoodOrder) has_good_ending_ = true;
  }
  return true;
}

}  // namespace omnimapper::source
