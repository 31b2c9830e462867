#include "OptionChecks.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/OptionTable.h>

namespace omnimapper::sim {

void requireBelow(const std::string& place, const std::string& low_key, double low, const std::string& high_key,
                  double high) {
  if (!(low < high))
    refuseValue(place, low_key, low, "must be below " + high_key + " = " + base::option_text::format(high));
}

void refuseValue(const std::string& place, const std::string& key, double value, const std::string& what) {
  throw base::Error(base::ExitCode::out_of_range, place + key + " = " + base::option_text::format(value) + ": " + what);
}

}  // namespace omnimapper::sim
