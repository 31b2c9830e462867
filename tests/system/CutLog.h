#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/source/RawlogWriter.h>

#include <string>

namespace runs {

/// Writes the observations of a log before `cut` to one rawlog, the others to another.
inline void cutLog(const std::string& log, omnimapper::base::Stamp cut, const std::string& first,
                   const std::string& second) {
  for (const bool early : {true, false}) {
    omnimapper::source::RawlogSource source(log);
    omnimapper::source::writeRawlog(early ? first : second, [&](omnimapper::source::RawlogWriter& writer) {
      while (const auto observation = source.next()) {
        if ((observation->timestamp < cut) == early) writer.add(*observation);
      }
    });
  }
}

}  // namespace runs
