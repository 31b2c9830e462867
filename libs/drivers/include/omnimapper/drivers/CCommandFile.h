#pragma once

#include <mrpt/hwdrivers/CGenericSensor.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/drivers/CheckedSensor.h>
#include <omnimapper/obs/CObservationCommand.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace omnimapper::drivers {

/// The keys of a section with `driver = CCommandFile`, in addition to those of every MRPT driver (sensorLabel, ...).
struct CommandFileOptions {
  std::string file;              ///< the table of commands; it may be missing when the run begins
  double max_clock_offset = 10;  ///< [s]

  static const base::OptionTable<CommandFileOptions>& table();
};

/// Gives the commands that another program, such as omnimapper-serve, appends to a table of commands (obs::commandIn())
/// while the run goes on, as obs::CObservationCommand. What was in the file before initialize() belongs to an earlier
/// run and is not given. A row is rejected and counted if it is no command; if its stamp is more than
/// `max_clock_offset` from this machine's clock; if it expired before it was read; or if its stamp is not later than
/// that of the last command, so that no row is given twice. A `stop` is never rejected: where another command would be,
/// it gets the time at which it was read. A line that has no end yet is read when it has one. A file that is there and
/// cannot be opened is an Error(unreadable_input) of initialize() and doProcess().
///
/// This driver starts no thread. doProcess() takes at most 64 KiB, and never waits.
class CCommandFile : public mrpt::hwdrivers::CGenericSensor, public CheckedSensor {
  DEFINE_GENERIC_SENSOR(CCommandFile)
 public:
  CCommandFile();
  ~CCommandFile() override;

  void initialize() override;
  void doProcess() override;

  std::uint64_t leftOut() const override;
  std::string leftOutByReason() const override;
  bool waitsForOthers() const override { return true; }
  bool sendsOnRequest() const override { return true; }

 protected:
  /// Throws Error unknown_key, wrong_type or out_of_range, naming section, key and the valid values.
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& config, const std::string& section) override;

 private:
  std::string appended();
  void take(const std::string& line);
  std::optional<std::string> whyNot(const obs::CObservationCommand& command) const;

  CommandFileOptions options_;
  std::uint64_t position_ = 0;  // [bytes] up to which the file was read
  std::string columns_, begun_;
  base::Stamp last_;
  std::map<std::string, std::uint64_t> left_out_;  // by reason
};

}  // namespace omnimapper::drivers
