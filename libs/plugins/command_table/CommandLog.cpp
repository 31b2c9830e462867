#include "CommandLog.h"

#include <omnimapper/base/CsvTable.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/obs/CommandTable.h>

#include <algorithm>

namespace omnimapper::source {

const base::OptionTable<CommandLogOptions>& CommandLogOptions::table() {
  static const auto table =
      base::OptionTable<CommandLogOptions>().text("label", &CommandLogOptions::label, "Sensor label of the commands.");
  return table;
}

bool CommandLog::recognizes(const LogLook& look) {
  if (look.is_folder) return false;
  const std::string columns = "," + look.head.substr(0, look.head.find_first_of("\r\n")) + ",";
  return columns.find(",stamp_s,") != std::string::npos && columns.find(",kind,") != std::string::npos;
}

CommandLog::CommandLog(const std::string& path, const CommandLogOptions& options) {
  const base::CsvTable table(path, kSummary);
  for (std::size_t row = 0; row < table.size(); ++row) {
    commands_.push_back(obs::commandIn(table, row));
    commands_.back().sensorLabel = options.label;
  }
  if (commands_.empty())
    throw base::Error(base::ExitCode::unreadable_input,
                      path + ": the table of commands has no row; each command is a row under stamp_s,kind,text,...");
  std::stable_sort(commands_.begin(), commands_.end(),
                   [](const auto& a, const auto& b) { return a.timestamp < b.timestamp; });
}

mrpt::obs::CObservation::Ptr CommandLog::next() {
  if (next_ == commands_.size()) {
    report_.ending = SourceReport::Ending::complete;
    return nullptr;
  }
  auto command = std::make_shared<obs::CObservationCommand>(commands_[next_++]);
  ++report_.objects;
  report_.count(command->sensorLabel, command->GetRuntimeClass()->className, command->timestamp);
  return command;
}

double CommandLog::progress() const {
  return static_cast<double>(next_) / static_cast<double>(commands_.size());
}

}  // namespace omnimapper::source
