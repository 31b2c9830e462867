#pragma once

#include <omnimapper/eval/AbsoluteTrajectoryError.h>
#include <omnimapper/eval/RelationError.h>
#include <omnimapper/eval/RelativePoseError.h>

#include <string>

namespace omnimapper::eval {

/// A result as a small table of text for a terminal, with angles in degrees.
std::string table(const AbsoluteTrajectoryError& error);
std::string table(const RelativePoseError& error);
std::string table(const RelationError& error);

/// The same numbers as a JSON object, whose keys end in their unit (translation_m, rotation_deg, ...).
std::string json(const AbsoluteTrajectoryError& error);
std::string json(const RelativePoseError& error);
std::string json(const RelationError& error);

/// Writes numbers.json, errors.svg and, for an absolute error, trajectory.svg into a folder, which is created if
/// missing. `title` is the heading of the plots. Throws as base::makeWritableFolder() and base::writeFile() do.
void saveReport(const std::string& folder, const std::string& title, const AbsoluteTrajectoryError& error,
                const Trajectory& reference);
void saveReport(const std::string& folder, const std::string& title, const RelativePoseError& error);
void saveReport(const std::string& folder, const std::string& title, const RelationError& error);

}  // namespace omnimapper::eval
