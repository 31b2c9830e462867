#include <omnimapper/base/Error.h>

#include "pclMatcher.h"

namespace omnimapper::plugins {

std::unique_ptr<const matching::CloudMatcher> pclMatcher(const matching::CloudMatcherOptions&) {
  throw base::Error(base::ExitCode::unknown_plugin,
                    "library = pcl: this program was built without PCL; install libpcl-dev, and configure and build "
                    "again, or set library = omnimapper");
}

}  // namespace omnimapper::plugins
