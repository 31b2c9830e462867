#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <omnimapper/source/ImageSettings.h>

#include <functional>
#include <memory>
#include <string>

namespace omnimapper::source {

/// Where writeRawlog() takes what goes into the file, in order.
class RawlogWriter {
 public:
  explicit RawlogWriter(mrpt::serialization::CArchive& archive) : archive_(archive) {}
  void add(const mrpt::obs::CObservation& observation);
  void add(const mrpt::obs::CActionCollection& actions, const mrpt::obs::CSensoryFrame& frame);

 private:
  mrpt::serialization::CArchive& archive_;
};

/// Writes a rawlog (gzip) in whole or not at all: to a temporary file that is read back, byte by byte the same, before
/// it takes the place of `path`. The same content gives the same bytes. Throws Error(disk_full) as base::replaceFile.
/// How images are kept is a setting of MRPT's for the whole process while it writes.
void writeRawlog(const std::string& path, const std::function<void(RawlogWriter&)>& fill,
                 ColourImages images = ColourImages::lossless);

}  // namespace omnimapper::source
