#pragma once

#include <omnimapper/surfaces/SurfaceClass.h>
#include <omnimapper/surfaces/SurfaceFacts.h>

#include <string>
#include <vector>

namespace omnimapper::surfaces {

/// A surface of a map with what it truly is.
struct Example {
  SurfaceClass is = SurfaceClass::surface;
  SurfaceFacts facts;  ///< `along`, `plan` and `middle` are not kept in files
};

/// A table with a header, a line for each example, lengths to the centimetre.
std::string toCsv(const std::vector<Example>& examples);
/// Throws base::Error(unreadable_input) naming `file` and the line for what toCsv() did not write.
std::vector<Example> readExamples(const std::string& text, const std::string& file);

/// What classify() goes by: surfaces of maps of simulated homes, offices and laboratories (data/examples.csv, made by
/// scripts/surface-examples), and by hand what rooms, doors (DIN 18101) and furniture usually measure (data/usual.csv),
/// for a robot's maps know no ceiling, and a simulator not all furniture.
const std::vector<Example>& knownExamples();

}  // namespace omnimapper::surfaces
