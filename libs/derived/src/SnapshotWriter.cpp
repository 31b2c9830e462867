#include <omnimapper/derived/SnapshotWriter.h>

#include <algorithm>
#include <exception>

namespace omnimapper::derived {

SnapshotWriter::~SnapshotWriter() {
  if (written_.valid()) written_.wait();
}

std::string SnapshotWriter::offer(const mapper::View& view) {
  const auto now = Clock::now();
  if (written_.valid()) {
    if (written_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return "";
    return finished();
  }
  if (period_.count() <= 0 || now < next_ || view.map.key_frames.empty()) return "";
  next_ = now + std::chrono::duration_cast<Clock::duration>(period_);
  copy_ = std::make_unique<const mapper::Snapshot>(mapper::Snapshot{view.map, view.graph, view.uncertainty});
  written_ = std::async(std::launch::async, [this, copy = copy_.get(), now] {
    write_(copy->state());
    return std::chrono::duration<double>(Clock::now() - now).count();
  });
  return "";
}

std::string SnapshotWriter::wait() {
  return written_.valid() ? finished() : "";
}

std::string SnapshotWriter::finished() {
  std::string problem;
  try {
    const std::chrono::duration<double> pause(written_.get() * (1 / share_ - 1));
    next_ = std::max(next_, Clock::now() + std::chrono::duration_cast<Clock::duration>(pause));
    ++count_;
  } catch (const std::exception& error) {
    problem = error.what();
  }
  copy_.reset();
  return problem;
}

}  // namespace omnimapper::derived
