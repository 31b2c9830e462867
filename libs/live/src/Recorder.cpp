#include <fcntl.h>
#include <mrpt/serialization/CSerializable.h>
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/live/HostClock.h>
#include <omnimapper/live/Recorder.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace omnimapper::live {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kBlock = std::chrono::milliseconds(900);  // time of the observations in one member of gzip
constexpr std::size_t kLargestBlock = 16 << 20;          // [bytes] a third of a second of a VGA camera at 30 Hz

// Writes all bytes. Throws the system's reason if it cannot.
void writeAll(int file, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t some = ::write(file, bytes.data() + done, bytes.size() - done);
    if (some < 0 && errno == EINTR) continue;
    if (some <= 0) throw std::runtime_error(some < 0 ? std::strerror(errno) : "nothing more fits");
    done += static_cast<std::size_t>(some);
  }
}

}  // namespace

Encoded encode(const mrpt::obs::CObservation& observation) {
  auto bytes = std::make_shared<std::vector<std::uint8_t>>();
  mrpt::serialization::ObjectToOctetVector(&observation, *bytes);
  return bytes;
}

mrpt::obs::CObservation::Ptr decode(const Encoded& encoded) {
  mrpt::serialization::CSerializable::Ptr object;
  mrpt::serialization::OctetVectorToObject(*encoded, object);
  auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object);
  if (!observation) throw std::runtime_error("the recorded object is no observation");
  return observation;
}

RecorderOptions recorderOptions(const LiveOptions& options) {
  constexpr double kMega = 1e6;
  return {options.compression, static_cast<std::uint64_t>(options.split_mb * kMega),
          static_cast<std::size_t>(options.queue_mb * kMega)};
}

std::string nameByTime() {
  const auto now = static_cast<std::time_t>(base::unixSeconds(hostNow()));
  std::tm parts{};
  localtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d_%H-%M-%S", &parts);
  return text;
}

Recorder::Recorder(const std::string& folder, const std::string& name, const RecorderOptions& options)
    : folder_(folder), name_(name), options_(options) {
  std::error_code none;
  has_made_folder_ = !std::filesystem::exists(folder, none);
  base::makeWritableFolder(folder);
  openNext();
  thread_ = std::thread([this] { run(); });
}

Recorder::~Recorder() {
  close();
}

bool Recorder::hasRoomFor(std::size_t bytes) const {
  const std::lock_guard lock(mutex_);
  return waiting_.empty() || waiting_bytes_ + bytes <= options_.queue_bytes;
}

void Recorder::add(const Encoded& observation) {
  const std::lock_guard lock(mutex_);
  if (closing_ || !failure_.empty()) return;
  // In queue sizes. Camera frames are left out before, so this is reached by data of other sensors.
  constexpr std::size_t kBeyond = 4;
  if (waiting_bytes_ > kBeyond * options_.queue_bytes) {
    failure_ = folder_ + "/" + files_.back() + ": recording ended: the disk is too slow for the data";
    for (const auto& one : waiting_) waiting_bytes_ -= one->size();
    waiting_.clear();
    return;
  }
  waiting_.push_back(observation);
  waiting_bytes_ += observation->size();
  if (waiting_bytes_ >= kLargestBlock) wake_.notify_all();
}

void Recorder::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

void Recorder::discard() {
  close();
  std::error_code none;
  for (const auto& file : files()) std::filesystem::remove(folder_ + "/" + file, none);
  if (has_made_folder_) std::filesystem::remove(folder_, none);
}

Recorder::Statistics Recorder::statistics() const {
  const std::lock_guard lock(mutex_);
  return statistics_;
}

std::string Recorder::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

std::vector<std::string> Recorder::files() const {
  const std::lock_guard lock(mutex_);
  return files_;
}

void Recorder::openNext() {
  char number[16] = "";
  if (!files_.empty()) std::snprintf(number, sizeof number, "_%03zu", files_.size());
  const std::string file = name_ + number + ".rawlog", path = folder_ + "/" + file;
  const int next = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (next < 0)
    throw base::Error(base::ExitCode::unwritable_output, path + ": cannot be recorded to: " + std::strerror(errno));
  if (file_ >= 0) ::close(file_);
  file_ = next;
  file_bytes_ = 0;
  const std::lock_guard lock(mutex_);
  files_.push_back(file);
}

void Recorder::run() {
  for (bool is_last = false; !is_last;) {
    std::vector<Encoded> block;
    std::size_t bytes = 0;
    {
      std::unique_lock lock(mutex_);
      wake_.wait_for(lock, kBlock, [this] { return closing_ || waiting_bytes_ >= kLargestBlock; });
      while (!waiting_.empty() && bytes < kLargestBlock) {
        bytes += waiting_.front()->size();
        block.push_back(std::move(waiting_.front()));
        waiting_.pop_front();
      }
      is_last = closing_ && waiting_.empty();
    }
    if (block.empty()) continue;
    const auto begin = Clock::now();
    std::string failure;
    try {
      writeBlock(block, bytes);
    } catch (const std::exception& error) {
      failure = error.what();
    }
    const std::lock_guard lock(mutex_);
    waiting_bytes_ -= bytes;
    statistics_.seconds += std::chrono::duration<double>(Clock::now() - begin).count();
    if (failure.empty()) {
      statistics_.observations += block.size();
      statistics_.bytes += bytes;
      continue;
    }
    if (failure_.empty()) failure_ = folder_ + "/" + files_.back() + ": recording ended: " + failure;
    waiting_.clear();
    waiting_bytes_ = 0;
    return;
  }
}

// Writes a block as a whole or not at all.
void Recorder::writeBlock(const std::vector<Encoded>& block, std::size_t bytes) {
  if (options_.split_bytes > 0 && file_bytes_ >= options_.split_bytes) openNext();
  const std::string member = compressed(block, bytes);
  try {
    writeAll(file_, member);
  } catch (const std::exception&) {
    if (::ftruncate(file_, static_cast<off_t>(file_bytes_)) == 0) throw;
    throw std::runtime_error("the incomplete last block cannot be removed: " + std::string(std::strerror(errno)));
  }
  file_bytes_ += member.size();
  const std::lock_guard lock(mutex_);
  statistics_.bytes_on_disk += member.size();
}

std::string Recorder::compressed(const std::vector<Encoded>& block, std::size_t bytes) const {
  z_stream stream{};
  constexpr int kGzip = 15 + 16, kMemory = 8;
  if (deflateInit2(&stream, options_.compression, Z_DEFLATED, kGzip, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("zlib cannot begin");
  std::string member(deflateBound(&stream, static_cast<uLong>(bytes)) + 64 * (block.size() + 1), '\0');
  stream.next_out = reinterpret_cast<Bytef*>(member.data());
  stream.avail_out = static_cast<uInt>(member.size());
  int result = Z_OK;
  for (std::size_t i = 0; i < block.size() && result == Z_OK; ++i) {
    stream.next_in = const_cast<Bytef*>(block[i]->data());
    stream.avail_in = static_cast<uInt>(block[i]->size());
    result = deflate(&stream, i + 1 == block.size() ? Z_FINISH : Z_NO_FLUSH);
  }
  member.resize(stream.total_out);
  deflateEnd(&stream);
  if (result != Z_STREAM_END) throw std::runtime_error("zlib cannot compress it");
  return member;
}

}  // namespace omnimapper::live
