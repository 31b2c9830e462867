#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/obs/CObservationCommand.h>
#include <omnimapper/source/LogLook.h>
#include <omnimapper/source/ObservationSource.h>

#include <string>
#include <vector>

namespace omnimapper::source {

struct CommandLogOptions {
  std::string label = "commands";  ///< sensor label of the commands
  static const base::OptionTable<CommandLogOptions>& table();
};

/// Streams a table of commands that somebody noted, as obs::CObservationCommand in the order of their stamps. The table
/// has comma-separated fields; its first line names the columns: stamp_s (Unix time) and kind (CommandKind); text,
/// subject (CommandSubject), origin, expiry_s, forward_m, left_m and turn_deg may be missing or empty.
class CommandLog : public ObservationSource {
 public:
  static constexpr const char* kName = "command_table";
  static constexpr const char* kSummary = "a table of commands";
  /// Whether the first line names the columns stamp_s and kind.
  static bool recognizes(const LogLook& look);

  /// Throws Error(unreadable_input) with the line for a table without rows, a kind or subject that there is not, a
  /// stamp that is no time, an expiry below 0, and a label, goal, edit or plugin without text.
  explicit CommandLog(const std::string& path, const CommandLogOptions& options = {});

  mrpt::obs::CObservation::Ptr next() override;
  double progress() const override;
  SourceReport report() const override { return report_; }

 private:
  std::vector<obs::CObservationCommand> commands_;
  std::size_t next_ = 0;
  SourceReport report_;
};

}  // namespace omnimapper::source
