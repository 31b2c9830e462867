#pragma once

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/serialization/CArchive.h>
#include <zlib.h>

#include <string>
#include <vector>

/// Rawlogs as bytes, for tests that damage them.
namespace rawlogs {

using Observations = std::vector<mrpt::obs::CObservation::Ptr>;

struct Bytes {
  std::string text;                 ///< the bytes of an uncompressed rawlog
  std::vector<std::size_t> starts;  ///< offset of each observation in them
};

inline Bytes bytesOf(const Observations& observations) {
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  Bytes bytes;
  for (const auto& observation : observations) {
    bytes.starts.push_back(stream.getTotalBytesCount());
    archive << *observation;
  }
  bytes.text.assign(static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount());
  return bytes;
}

inline void writeGzip(const std::string& path, const std::string& bytes) {
  gzFile file = gzopen(path.c_str(), "wb");
  EXPECT_EQ(gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size())), static_cast<int>(bytes.size()));
  EXPECT_EQ(gzclose(file), Z_OK);
}

}  // namespace rawlogs
