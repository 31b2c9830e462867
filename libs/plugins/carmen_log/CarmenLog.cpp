#include "CarmenLog.h"

#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/source/TextFileLines.h>
#include <omnimapper/source/describeInput.h>
#include <omnimapper/source/refuse.h>

#include <algorithm>
#include <deque>
#include <map>
#include <string_view>

#include "CarmenLasers.h"
#include "CarmenLine.h"

namespace omnimapper::source {

using mrpt::obs::CObservation;

namespace {

constexpr const char* kOdometryLabel = "ODOM";
constexpr const char* kScanOdometrySuffix = "_ODOM";
constexpr std::size_t kBadLinesKept = 10;
constexpr std::uint64_t kLinesUntilFirstWord = 1000;

// Throws if none of the first lines begins with the name of a CARMEN message.
void checkKind(const std::string& path) {
  TextFileLines lines(path);
  for (std::string line; lines.number() < kLinesUntilFirstWord && lines.next(line);) {
    if (line.find('\0') != std::string::npos) break;
    if (isCarmenWord(line.substr(0, line.find(' ')))) return;
  }
  if (!lines.file().problem().empty())
    refuse(path, "cannot be decompressed (" + lines.file().problem() + "); copy or download it again.");
  refuse(path,
         "is no CARMEN log: none of its first 1000 lines begins with ODOM, FLASER or the name of another CARMEN "
         "message; it " +
             describeInput(path));
}

// Reads the log once to check its clock: `lines` if there are ODOM lines and the stamps of no label run backwards.
CarmenOdometry chooseOdometry(const std::string& path) {
  TextFileLines lines(path);
  std::map<std::string, base::Stamp> latest;
  for (std::string line; lines.next(line);) {
    std::string label;
    base::Stamp stamp;
    try {
      const auto parsed = parseCarmenLine(line);
      if (const auto* odometry = std::get_if<CarmenOdometryLine>(&parsed)) {
        label = kOdometryLabel;
        stamp = odometry->stamp;
      } else if (const auto* scan = std::get_if<CarmenScanLine>(&parsed)) {
        label = scan->name;
        stamp = scan->stamp;
      } else {
        continue;
      }
    } catch (const BadCarmenLine&) {
      continue;
    }
    auto& before = latest[label];
    if (stamp < before) return CarmenOdometry::scans;
    before = stamp;
  }
  return latest.count(kOdometryLabel) > 0 ? CarmenOdometry::lines : CarmenOdometry::scans;
}

}  // namespace

const base::OptionTable<CarmenOptions>& CarmenOptions::table() {
  static const auto table = base::OptionTable<CarmenOptions>().choice<CarmenOdometry>(
      "odometry", &CarmenOptions::odometry,
      {{"automatic", CarmenOdometry::automatic}, {"lines", CarmenOdometry::lines}, {"scans", CarmenOdometry::scans}},
      "Source of the odometry: the log's ODOM lines, or the odometry in the lines of its scans. automatic: lines if "
      "there are any and no stamp of the log runs backwards, else scans.");
  return table;
}

bool CarmenLog::recognizes(const LogLook& look) {
  if (look.is_folder || look.head.find('\0') != std::string::npos) return false;
  for (std::size_t line = 0; line < look.head.size();) {
    const auto end = std::min(look.head.find('\n', line), look.head.size());
    if (isCarmenWord(std::string_view(look.head).substr(line, std::min(look.head.find(' ', line), end) - line)))
      return true;
    line = end + 1;
  }
  return false;
}

class CarmenLog::Stream {
 public:
  Stream(const std::string& path, const CarmenOptions& options) : lines_(path), odometry_(options.odometry) {
    checkKind(path);
    if (odometry_ == CarmenOdometry::automatic) odometry_ = chooseOdometry(path);
  }

  CObservation::Ptr next() {
    while (waiting_.empty() && readLine()) {
    }
    if (waiting_.empty()) return nullptr;
    const auto observation = waiting_.front();
    waiting_.pop_front();
    report_.count(observation->sensorLabel, observation->GetRuntimeClass()->className, observation->timestamp);
    return observation;
  }

  double progress() const { return lines_.file().fraction(); }
  const SourceReport& report() const { return report_; }
  CarmenOdometry odometry() const { return odometry_; }
  std::uint64_t badLineCount() const { return bad_line_count_; }
  const std::vector<BadLine>& badLines() const { return bad_lines_; }
  std::uint64_t unusedOdometry() const { return unused_odometry_; }

 private:
  // Appends the observations of the next line to waiting_. Returns false at the end.
  bool readLine() {
    if (report_.ending != SourceReport::Ending::open) return false;
    if (!lines_.next(line_)) {
      finish();
      return false;
    }
    try {
      take(parseCarmenLine(line_));
      ++report_.objects;
      report_.bytes += line_.size() + 1;
    } catch (const BadCarmenLine& bad) {
      last_line_is_cut_ = !lines_.isWhole();
      ++bad_line_count_;
      if (bad_lines_.size() < kBadLinesKept) bad_lines_.push_back({lines_.number(), bad.what()});
    }
    return true;
  }

  void take(const CarmenLine& line) {
    if (const auto* parameter = std::get_if<CarmenParameter>(&line)) {
      lasers_.set(*parameter);
    } else if (const auto* odometry = std::get_if<CarmenOdometryLine>(&line)) {
      if (odometry_ == CarmenOdometry::lines) {
        takeOdometry(*odometry);
      } else {
        ++unused_odometry_;
      }
    } else if (const auto* scan = std::get_if<CarmenScanLine>(&line)) {
      takeScan(*scan);
    } else if (const auto& name = std::get<CarmenOtherLine>(line).name; !name.empty()) {
      ++report_.other_objects[name];
    }
  }

  void takeOdometry(const CarmenOdometryLine& line) {
    const auto observation = odometryAt(kOdometryLabel, repaired(kOdometryLabel, line.stamp), line.pose);
    observation->hasVelocities = true;
    observation->velocityLocal = {line.forward_speed, 0, line.turn_rate};
    waiting_.push_back(observation);
  }

  void takeScan(const CarmenScanLine& line) {
    const base::Stamp stamp = repaired(line.name, line.stamp);
    const std::string label = odometry_ == CarmenOdometry::scans ? kOdometryLabel : line.name + kScanOdometrySuffix;
    auto& before = latest_[label];
    // ODOM comes first, also in a log that begins with a scan: a mapper takes the first odometry it meets.
    const bool too_early = label != kOdometryLabel && latest_.count(kOdometryLabel) == 0;
    if (stamp > before && !too_early) {
      before = stamp;
      waiting_.push_back(odometryAt(label, stamp, line.robot_pose));
    } else {
      ++unused_odometry_;
    }
    waiting_.push_back(lasers_.scan(line, stamp));
  }

  // t'_i = max(t_i, t'_(i-1) + 1 ms); a first stamp of zero, which means "no stamp" in MRPT, counts as too early.
  base::Stamp repaired(const std::string& label, base::Stamp stamp) {
    auto& before = latest_.emplace(label, base::stampFromUnix(0)).first->second;
    const base::Stamp earliest = before + base::durationFromSeconds(0.001);
    if (stamp < earliest) ++report_.repaired_stamps;
    before = std::max(stamp, earliest);
    return before;
  }

  static mrpt::obs::CObservationOdometry::Ptr odometryAt(const std::string& label, base::Stamp stamp,
                                                         const mrpt::math::TPose2D& pose) {
    auto observation = mrpt::obs::CObservationOdometry::Create();
    observation->sensorLabel = label;
    observation->timestamp = stamp;
    observation->odometry = mrpt::poses::CPose2D(pose);
    return observation;
  }

  void finish() {
    note();
    const auto& file = lines_.file();
    const std::string place = file.path() + ": ";
    if (file.ending() == CompressedFile::Ending::corrupt) {
      end(SourceReport::Ending::corrupt, place + "is corrupt (" + file.problem() + "); copy or download it again");
    } else if (file.ending() == CompressedFile::Ending::truncated) {
      end(SourceReport::Ending::truncated, place + "is truncated (" + file.problem() + "); copy or download it again");
    } else if (bad_line_count_ > 0) {
      const bool is_cut = bad_line_count_ == 1 && last_line_is_cut_;
      end(is_cut ? SourceReport::Ending::truncated : SourceReport::Ending::corrupt,
          place + (is_cut ? "is truncated: it ends in the middle of a line; copy or download it again"
                          : "lines that cannot be read were left out: " + std::to_string(bad_line_count_)));
    } else {
      report_.ending = SourceReport::Ending::complete;
    }
  }

  void note() {
    auto& notes = report_.notes;
    notes.push_back("lines read: " + std::to_string(report_.objects) + ", bad: " + std::to_string(bad_line_count_));
    for (const auto& bad : bad_lines_)
      notes.push_back("line " + std::to_string(bad.number) + " left out: it " + bad.reason);
    if (bad_line_count_ > bad_lines_.size())
      notes.push_back("... and " + std::to_string(bad_line_count_ - bad_lines_.size()) + " more bad lines");
    notes.push_back("odometry: of the " +
                    std::string(odometry_ == CarmenOdometry::lines ? "ODOM lines, and repeated for each scan"
                                                                   : "scans' own lines") +
                    "; ODOM lines or repetitions left out: " + std::to_string(unused_odometry_));
  }

  void end(SourceReport::Ending ending, const std::string& what) {
    report_.ending = ending;
    report_.message = what + ". Line " + std::to_string(lines_.number()) + " is the last that was read.";
    if (!bad_lines_.empty())
      report_.message += " The first line that cannot be read is line " + std::to_string(bad_lines_[0].number) +
                         ": it " + bad_lines_[0].reason + ".";
  }

  TextFileLines lines_;
  CarmenOdometry odometry_;
  CarmenLasers lasers_;
  std::string line_;
  std::deque<CObservation::Ptr> waiting_;
  std::map<std::string, base::Stamp> latest_;  // by label, repaired
  SourceReport report_;
  std::vector<BadLine> bad_lines_;
  std::uint64_t bad_line_count_ = 0;
  std::uint64_t unused_odometry_ = 0;
  bool last_line_is_cut_ = false;
};

CarmenLog::CarmenLog(const std::string& path, const CarmenOptions& options)
    : stream_(std::make_unique<Stream>(path, options)) {}
CarmenLog::~CarmenLog() = default;

CObservation::Ptr CarmenLog::next() {
  return stream_->next();
}
double CarmenLog::progress() const {
  return stream_->progress();
}
SourceReport CarmenLog::report() const {
  return stream_->report();
}
CarmenOdometry CarmenLog::odometry() const {
  return stream_->odometry();
}
std::uint64_t CarmenLog::badLineCount() const {
  return stream_->badLineCount();
}
const std::vector<CarmenLog::BadLine>& CarmenLog::badLines() const {
  return stream_->badLines();
}
std::uint64_t CarmenLog::unusedOdometry() const {
  return stream_->unusedOdometry();
}

}  // namespace omnimapper::source
