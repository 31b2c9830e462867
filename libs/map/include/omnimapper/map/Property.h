#pragma once

#include <omnimapper/base/Stamp.h>

#include <cstdint>
#include <string>
#include <variant>

namespace omnimapper::map {

/// A number with its unit, as at the end of an INI key: "m", "m2", "kg", "deg".
struct Measure {
  double value = 0;
  std::string unit;
};

/// What a plugin says about a landmark beside its shape. A text may be searched for, as a name of the landmark.
struct Property {
  using Value = std::variant<std::string, std::uint64_t, Measure, bool, base::Stamp>;

  std::string name;  ///< without the unit: "area"
  Value value;       ///< a text, a count, a measure, a flag or a time
};

/// The name with the unit: "area_m2".
std::string keyOf(const Property& property);
/// The value as people read it: "213", "7", "8.000", "yes", "1100000000.500000" (seconds since 1970).
std::string textOf(const Property& property);

}  // namespace omnimapper::map
