#pragma once

#include <omnimapper/base/CsvTable.h>
#include <omnimapper/obs/CObservationCommand.h>

#include <string>

namespace omnimapper::obs {

/// The first line of a table of commands that commandRow() writes. In one that people write, all columns but stamp_s
/// and kind may be missing or empty.
inline constexpr char kCommandColumns[] = "stamp_s,kind,text,subject,origin,expiry_s,forward_m,left_m,turn_deg";

/// The command in a row of a table: stamp_s (Unix time), kind (CommandKind), text, subject (CommandSubject), origin,
/// expiry_s, forward_m, left_m and turn_deg. It has no sensor label. Throws Error(unreadable_input) with the line for a
/// kind or subject that there is not, a stamp that is no time, an expiry below 0, and a label, goal, edit or plugin
/// without text.
CObservationCommand commandIn(const base::CsvTable& table, std::size_t row);

/// The row of a command under kCommandColumns, without a line end. Control characters of its texts are escaped.
std::string commandRow(const CObservationCommand& command);

}  // namespace omnimapper::obs
