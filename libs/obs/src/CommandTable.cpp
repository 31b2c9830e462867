#include <omnimapper/base/Error.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/obs/CommandTable.h>

#include <cmath>

namespace omnimapper::obs {

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

void requireText(const base::CsvTable& table, std::size_t row, const CObservationCommand& command) {
  for (const auto kind :
       {CommandKind::label, CommandKind::go_to, CommandKind::edit, CommandKind::plugin_on, CommandKind::plugin_off})
    if (command.kind == kind && command.text.empty()) table.refuse(row, "a command " + nameOf(kind) + " needs a text");
}

}  // namespace

CObservationCommand commandIn(const base::CsvTable& table, std::size_t row) {
  CObservationCommand command;
  command.timestamp = stampIn(table, row);
  const std::string &kind = table.text(row, "kind"), subject = textIn(table, row, "subject");
  const auto known_kind = commandKind(kind);
  if (!known_kind)
    table.refuse(row, "there is no command '" + base::printable(kind) +
                          "': it is label, go_to, follow, stop, move, standby, edit, plugin_on or plugin_off");
  command.kind = *known_kind;
  const auto known_subject = commandSubject(subject.empty() ? "any" : subject);
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

std::string commandRow(const CObservationCommand& command) {
  const auto& motion = command.motion;
  std::string row = base::formatUnix(command.timestamp) + "," + nameOf(command.kind) + "," +
                    base::csvField(base::printable(command.text)) + "," + nameOf(command.subject) + "," +
                    base::csvField(base::printable(command.origin)) + "," + base::fixed(command.expiry, 3);
  for (const double value : {motion.x(), motion.y(), motion.z() * 180 / M_PI}) row += "," + base::fixed(value, 4);
  return row;
}

}  // namespace omnimapper::obs
