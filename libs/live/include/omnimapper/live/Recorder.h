#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/live/LiveOptions.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace omnimapper::live {

/// An observation, serialized as in a rawlog.
using Encoded = std::shared_ptr<const std::vector<std::uint8_t>>;

Encoded encode(const mrpt::obs::CObservation& observation);
/// The observation that a reader of the rawlog gets. Throws std::exception if the bytes are not an observation.
mrpt::obs::CObservation::Ptr decode(const Encoded& encoded);

struct RecorderOptions {
  int compression = 1;                  ///< level of zlib, 0 to 9
  std::uint64_t split_bytes = 0;        ///< size on the disk at which the next file is begun; 0: never
  std::size_t queue_bytes = 256 << 20;  ///< size of the waiting data above which hasRoomFor() is false
};

RecorderOptions recorderOptions(const LiveOptions& options);

/// A name for the files of a recording that begins now, such as 2026-11-27_07-15-37.
std::string nameByTime();

/// Writes observations to rawlogs as they come, in a separate thread. Each block of about a second is a complete gzip
/// member, so that all but the last second of a file can be read if its writer was killed.
class Recorder {
 public:
  /// Files are named NAME.rawlog, NAME_001.rawlog and so on, in `folder`, which is made if it is missing. Throws
  /// Error(unwritable_output) if the first file cannot be made or exists already.
  Recorder(const std::string& folder, const std::string& name, const RecorderOptions& options);
  /// Calls close().
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Whether the queue of data to be written has room for so many bytes.
  bool hasRoomFor(std::size_t bytes) const;
  /// Adds an observation to the queue; may be called from any thread. Observations are written in the order of the
  /// calls. After a failure of the recording, add() does nothing.
  void add(const Encoded& observation);
  /// Writes the queued observations and ends the recording.
  void close();
  /// Ends the recording and removes its files. Also removes the folder if the recorder made it and nothing else is in
  /// it.
  void discard();

  struct Statistics {
    std::uint64_t observations = 0;
    std::uint64_t bytes = 0;  ///< size of the written observations before compression
    std::uint64_t bytes_on_disk = 0;
    double seconds = 0;  ///< working time of the thread
  };
  Statistics statistics() const;
  /// Why recording ended early; empty if it did not. The files can be read up to that point.
  std::string failure() const;
  /// Names of the files that have been begun, without the folder.
  std::vector<std::string> files() const;

 private:
  void run();
  void openNext();
  void writeBlock(const std::vector<Encoded>& block, std::size_t bytes);
  std::string compressed(const std::vector<Encoded>& block, std::size_t bytes) const;

  const std::string folder_, name_;
  bool has_made_folder_ = false;
  const RecorderOptions options_;
  int file_ = -1;
  std::uint64_t file_bytes_ = 0;  // size of the complete blocks in the current file

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Encoded> waiting_;
  std::size_t waiting_bytes_ = 0;
  bool closing_ = false;
  Statistics statistics_;
  std::string failure_;
  std::vector<std::string> files_;
  std::thread thread_;
};

}  // namespace omnimapper::live
