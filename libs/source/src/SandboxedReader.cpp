#include "SandboxedReader.h"

#include <unistd.h>

#include "ObjectReader.h"

namespace omnimapper::source {

namespace {

// Messages of the child to its parent, one byte each.
constexpr char kObject = 'o';     // one more object was read and used
constexpr char kGoodOrder = 'e';  // the log ended in a way that the parent can handle itself

constexpr std::uint64_t kMemory = std::uint64_t{1} << 30;

int readInChild(const std::string& path, const std::function<void(mrpt::serialization::CSerializable&)>& use,
                int to_parent) {
  const auto send = [&](char what) { return ::write(to_parent, &what, 1) == 1; };
  try {
    ObjectReader reader(path);
    while (const auto object = reader.next()) {
      use(*object);
      if (!send(kObject)) return 1;
    }
    if (reader.ending() != ObjectReader::Ending::corrupt) send(kGoodOrder);
  } catch (...) {
  }
  return 0;
}

}  // namespace

SandboxedReader::SandboxedReader(const std::string& path,
                                 const std::function<void(mrpt::serialization::CSerializable&)>& use)
    : child_([&](int to_parent) { return readInChild(path, use, to_parent); }, kMemory) {}

SandboxedReader::Answer SandboxedReader::mayReadAfter(std::uint64_t objects, const std::function<bool()>& stop) {
  while (objects >= objects_ && !child_.isOver()) {
    std::string received;
    if (!child_.hear(received, 100) && stop()) return Answer::not_known;
    count(received);
  }
  return objects < objects_ || has_good_ending_ ? Answer::yes : Answer::no;
}

void SandboxedReader::count(const std::string& received) {
  for (const char what : received) {
    if (what == kObject) ++objects_;
    if (what == kGoodOrder) has_good_ending_ = true;
  }
}

}  // namespace omnimapper::source
