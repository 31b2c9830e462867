#include "CommandLog.h"

#include <omnimapper/base/CsvTable.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Names.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::source {

namespace {

std::string textIn(const base::CsvTable& table, std::size_t row, const std::string& column) {
  return table.has(column) ? table.text(row, column) : "";
}

double numberIn(const base::CsvTable& table, std::size_t row, const std::string& column) {
  return textIn(table, row, column).empty() ? 0 : table.number(row, column);
}

base::Stamp stampIn(const base::CsvTable& table, std::size_t row) {
  try {
    const auto stamp = base::parseUnix(table.text(row, "stamp_s"));
    if (base::isValid(stamp)) return stamp;
  } catch (const base::Error&) {
  }
  table.refuse(row, "stamp_s is '" + base::printable(table.text(row, "stamp_s")) + "', which is no Unix time");
}

void requireText(const base::CsvTable& table, std::size_t row, const obs::CObservationCommand& command) {
  using obs::CommandKind;
  for (const auto kind :
       {CommandKind::label, CommandKind::go_to, CommandKind::edit, CommandKind::plugin_on, CommandKind::plugin_off})
    if (command.kind == kind && command.text.empty()) table.refuse(row, "a command " + nameOf(kind) + " needs a text");
}

obs::CObservationCommand commandIn(const base::CsvTable& table, std::size_t row) {
  obs::CObservationCommand command;
  command.timestamp = stampIn(table, row);
  const std::string &kind = table.text(row, "kind"), subject = textIn(table, row, "subject");
  const auto known_kind = obs::commandKind(kind);
  if (!known_kind)
    table.refuse(row, "there is no command '" + base::printable(kind) +
                          "': it is label, go_to, follow, stop, move, standby, edit, plugin_on or plugin_off");
  command.kind = *known_kind;
  const auto known_subject = obs::commandSubject(subject.empty() ? "any" : subject);
  if (!known_subject)
    table.refuse(row, "there is no subject '" + base::printable(subject) + "': it is any, map, object or place");
  command.subject = *known_subject;
  command.text = textIn(table, row, "text");
  command.origin = textIn(table, row, "origin");
  command.expiry = numberIn(table, row, "expiry_s");
  if (command.expiry < 0) table.refuse(row, "expiry_s is below 0");
  command.motion = {numberIn(table, row, "forward_m"), numberIn(table, row, "left_m"),
                    M_PI / 180 * numberIn(table, row, "turn_deg")};
  requireText(table, row, command);
  return command;
}

}  // namespace

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
    commands_.push_back(commandIn(table, row));
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
