#include <omnimapper/base/CsvTable.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/drivers/CCommandFile.h>
#include <omnimapper/drivers/readDriverSection.h>
#include <omnimapper/live/HostClock.h>
#include <omnimapper/obs/CommandTable.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <system_error>

IMPLEMENTS_GENERIC_SENSOR(CCommandFile, omnimapper::drivers)

namespace omnimapper::drivers {

namespace {

constexpr std::size_t kMostAtOnce = 65536, kLongestLine = 4096;  // [bytes]

[[noreturn]] void refuseFile(const std::string& file, const std::string& reason) {
  throw base::Error(base::ExitCode::unreadable_input,
                    file + ": commands cannot be read: " + reason + "; is it a file that another user wrote?");
}

/// 0 for a file that is not there yet.
std::uint64_t sizeOf(const std::string& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    if (!error || status.type() == std::filesystem::file_type::not_found) return 0;
    refuseFile(file, error.message());
  }
  const auto size = std::filesystem::is_regular_file(status) ? std::filesystem::file_size(file, error) : 0;
  return error ? 0 : size;
}

std::ifstream opened(const std::string& file) {
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) refuseFile(file, std::strerror(errno));
  return in;
}

std::string firstLine(const std::string& file) {
  auto in = opened(file);
  std::string line(kLongestLine, '\0');
  in.read(line.data(), static_cast<std::streamsize>(line.size()));
  line.resize(static_cast<std::size_t>(in.gcount()));
  const auto end = line.find('\n');
  return end == std::string::npos ? "" : line.substr(0, end + 1);
}

}  // namespace

const base::OptionTable<CommandFileOptions>& CommandFileOptions::table() {
  using Options = CommandFileOptions;
  static const auto table =
      base::OptionTable<Options>()
          .text("file", &Options::file, "Table of commands to which another program appends; it may come later.")
          .number("max_clock_offset_s", &Options::max_clock_offset, base::Range::positive(),
                  "A command is rejected if its time stamp differs from this machine's clock by more than this.");
  return table;
}

CCommandFile::CCommandFile() {
  m_sensorLabel = "commands";
}
CCommandFile::~CCommandFile() = default;

void CCommandFile::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& config, const std::string& section) {
  options_ = readUnderMrpt([&] {
    auto options = readDriverSection<CommandFileOptions>(config, section);
    if (options.file.empty())
      throw base::Error(base::ExitCode::out_of_range, "[" + section + "] file names no table of commands");
    return options;
  });
}

void CCommandFile::initialize() {
  position_ = sizeOf(options_.file);
  columns_ = position_ > 0 ? firstLine(options_.file) : "";
  begun_.clear();
}

std::string CCommandFile::appended() {
  const std::uint64_t size = sizeOf(options_.file);
  if (size < position_) {  // it is another file
    position_ = 0;
    columns_.clear();
    begun_.clear();
  }
  if (size == position_) return {};
  auto in = opened(options_.file);
  in.seekg(static_cast<std::streamoff>(position_));
  std::string bytes(std::min<std::uint64_t>(size - position_, kMostAtOnce), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  position_ += bytes.size();
  return bytes;
}

void CCommandFile::doProcess() {
  begun_ += appended();
  for (auto end = begun_.find('\n'); end != std::string::npos; end = begun_.find('\n')) {
    const std::string line = begun_.substr(0, end + 1);
    begun_.erase(0, end + 1);
    if (columns_.empty())
      columns_ = line;
    else if (line.size() > kLongestLine)
      ++left_out_["of more than 4096 bytes"];
    else
      take(line);
  }
  // Of a line that is too long only the beginning is kept.
  if (begun_.size() > 2 * kLongestLine) begun_.resize(2 * kLongestLine);
}

void CCommandFile::take(const std::string& line) {
  std::istringstream table(columns_ + line);
  try {
    auto command = std::make_shared<obs::CObservationCommand>(obs::commandIn(base::CsvTable(table, options_.file), 0));
    const auto why = whyNot(*command);
    if (why && command->kind != obs::CommandKind::stop) {
      ++left_out_[*why];
      return;
    }
    // A robot is stopped whatever the clocks say: those who heed it must not take it for an old command.
    if (why) command->timestamp = live::hostNow();
    last_ = std::max(last_, command->timestamp);
    command->sensorLabel = m_sensorLabel;
    appendObservation(command);
  } catch (const base::Error&) {
    ++left_out_["that are no commands"];
  }
}

std::optional<std::string> CCommandFile::whyNot(const obs::CObservationCommand& command) const {
  const double age = base::secondsBetween(command.timestamp, live::hostNow());
  if (command.expiry > 0 && age > command.expiry) return "that expired before they were read";
  if (std::abs(age) > options_.max_clock_offset)
    return "whose stamp is further than max_clock_offset_s from the clock of this machine";
  if (!(last_ < command.timestamp)) return "not later than the command before";
  return std::nullopt;
}

std::uint64_t CCommandFile::leftOut() const {
  std::uint64_t sum = 0;
  for (const auto& [reason, count] : left_out_) sum += count;
  return sum;
}

std::string CCommandFile::leftOutByReason() const {
  std::string text;
  for (const auto& [reason, count] : left_out_)
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + reason;
  return text;
}

}  // namespace omnimapper::drivers
