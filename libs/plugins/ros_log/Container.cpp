#include "Container.h"

#include <omnimapper/source/describeInput.h>
#include <omnimapper/source/refuse.h>

#include "BagFile.h"
#include "Db3File.h"
#include "McapFile.h"
#include "RandomFile.h"
#include "decompressed.h"
#include "unpackedFile.h"

namespace omnimapper::ros {

void Container::timeChunks() {
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    if (chunks_[i].isTimed()) continue;
    for (const auto& message : load(i)) chunks_[i].include(message.time);
  }
}

namespace {

std::unique_ptr<Container> openUnpacked(const std::string& path, Channels& channels) {
  const std::string head = RandomFile(path).read(0, kLogHead);
  if (BagFile::recognizes(head)) return std::make_unique<BagFile>(path, channels);
  if (McapFile::recognizes(head)) return std::make_unique<McapFile>(path, channels);
  if (Db3File::recognizes(head)) return std::make_unique<Db3File>(path, channels);
  const std::string packing = source::describePacking(path, head);
  source::refuse(path, "is no log of ROS: it " + (packing.empty() ? source::describeInput(path) : packing));
}

}  // namespace

std::unique_ptr<Container> openContainer(const std::string& path, Channels& channels) {
  if (!isZstd(RandomFile(path).read(0, kLogHead))) return openUnpacked(path, channels);
  const UnpackedFile unpacked(path);
  auto container = openUnpacked(unpacked.path(), channels);
  if (!unpacked.damage().what.empty()) container->setDamageOfUnpacking(unpacked.damage());
  return container;
}

}  // namespace omnimapper::ros
