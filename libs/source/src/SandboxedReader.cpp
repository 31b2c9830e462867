#include "SandboxedReader.h"

#include <unistd.h>

#include "ObjectReader.h"

namespace omnimapper::source {

namespace {

// What the child tells its parent, a byte at a time.
constexpr char kObject = 'o';     // one more object was read and used
constexpr char kGoodOrder = 'e';  // the reading came to an end of a kind that the parent can meet itself

constexpr std::uint64_t kMemory = std::uint64_t{1} << 30;

int readInChild(const std::string& path, const std::function<void(mrpt::serialization::CSerializable&)>& use,
                int to_parent) {
  const auto tell = [&](char what) { return ::write(to_parent, &what, 1) == 1; };
  try {
    ObjectReader reader(path);
    while (const auto object = reader.next()) {
      use(*object);
      if (!tell(kObject)) return 1;
    }
    if (reader.ending() != ObjectReader::Ending::corrupt) tell(kGoodOrder);
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
    std::string told;
    if (!child_.hear(told, 100) && stop()) return Answer::not_known;
    count(told);
  }
  return objects < objects_ || has_good_ending_ ? Answer::yes : Answer::no;
}

void SandboxedReader::count(const std::string& told) {
  for (const char what : told) {
    if (what == kObject) ++objects_;
    if (what == kGoodOrder) has_good_ending_ = true;
  }
}

}  // namespace omnimapper::source
