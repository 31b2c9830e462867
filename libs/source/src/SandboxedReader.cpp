#include "SandboxedReader.h"

#include <unistd.h>

namespace omnimapper::source {

namespace {

// Messages of the child to its parent, one byte each.
constexpr char kStep = 'o';       // one more step was done
constexpr char kGoodOrder = 'e';  // the log ended in a way that the parent can handle itself

constexpr std::uint64_t kMemory = std::uint64_t{1} << 30;

int readInChild(const SandboxedReader::ReadLog& read, int to_parent) {
  const auto send = [&](char what) { return ::write(to_parent, &what, 1) == 1; };
  try {
    if (read([&] { return send(kStep); })) send(kGoodOrder);
  } catch (...) {
  }
  return 0;
}

}  // namespace

SandboxedReader::SandboxedReader(const ReadLog& read)
    : child_([&](int to_parent) { return readInChild(read, to_parent); }, kMemory) {}

SandboxedReader::Answer SandboxedReader::mayReadAfter(std::uint64_t steps, const std::function<bool()>& stop) {
  while (steps >= steps_ && !child_.isOver()) {
    std::string received;
    if (!child_.hear(received, 100) && stop()) return Answer::not_known;
    count(received);
  }
  return steps < steps_ || has_good_ending_ ? Answer::yes : Answer::no;
}

void SandboxedReader::count(const std::string& received) {
  for (const char what : received) {
    if (what == kStep) ++steps_;
    if (what == kGoodOrder) has_good_ending_ = true;
  }
}

}  // namespace omnimapper::source
