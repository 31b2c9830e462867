#include <omnimapper/map/ClosedLoops.h>

#include "SectionBytes.h"

namespace omnimapper::map {

std::string ClosedLoops::toBytes() const {
  ByteWriter out;
  out.uint(loops.size(), 4);
  for (const auto& loop : loops) {
    writeId(out, loop.from);
    writeId(out, loop.to);
    for (const auto* point : {&loop.from_in_map, &loop.to_in_map})
      for (int i = 0; i < 2; ++i) out.real((*point)[i]);
    out.block(loop.owner);
    out.block(loop.note);
  }
  return out.take();
}

ClosedLoops ClosedLoops::fromSection(const MapSection& section) {
  expectSection(section, kLayer, kLayerVersion);
  ByteReader in(section.bytes, placeOf(kLayer));
  ClosedLoops read;
  for (auto left = in.uint(4); left > 0; --left) {
    ClosedLoop loop;
    loop.from = readId<base::KeyFrameTag>(in);
    loop.to = readId<base::KeyFrameTag>(in);
    for (auto* point : {&loop.from_in_map, &loop.to_in_map})
      for (int i = 0; i < 2; ++i) (*point)[i] = in.real();
    if (!loop.from_in_map.allFinite() || !loop.to_in_map.allFinite())
      refuse(kLayer, "has a point that is not finite: the file is damaged");
    loop.owner = std::string(in.block());
    loop.note = std::string(in.block());
    read.loops.push_back(std::move(loop));
  }
  expectEnd(in, kLayer);
  return read;
}

}  // namespace omnimapper::map
