#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <omnimapper/source/ImageSettings.h>

#include <functional>
#include <memory>
#include <string>

namespace omnimapper::source {

/// Receives the content of the file that writeRawlog() writes, in order.
class RawlogWriter {
 public:
  explicit RawlogWriter(mrpt::serialization::CArchive& archive) : archive_(archive) {}
  void add(const mrpt::obs::CObservation& observation);
  void add(const mrpt::obs::CActionCollection& actions, const mrpt::obs::CSensoryFrame& frame);

 private:
  mrpt::serialization::CArchive& archive_;
};

/// Writes a gzip rawlog as a whole or not at all: to a temporary file, which is read back and compared by size and
/// checksum before it replaces `path`. The same content gives the same bytes. Throws as base::replaceFile(). While the
/// file is written, `images` is MRPT's setting for the whole process.
void writeRawlog(const std::string& path, const std::function<void(RawlogWriter&)>& fill,
                 ColourImages images = ColourImages::lossless);

}  // namespace omnimapper::source
