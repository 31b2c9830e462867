#pragma once

#include <cstdint>
#include <string>

namespace omnimapper::map {

/// One named part of a map file. The owner of the section defines what the bytes mean at each version.
struct MapSection {
  std::string name;
  std::uint32_t version = 1;
  std::string bytes;
};

}  // namespace omnimapper::map
