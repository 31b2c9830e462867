#pragma once

#include <omnimapper/surfaces/SurfaceClass.h>
#include <omnimapper/surfaces/SurfaceFacts.h>

#include <string>
#include <vector>

namespace omnimapper::surfaces {

/// A surface of a map with its true class.
struct Example {
  SurfaceClass is = SurfaceClass::surface;
  SurfaceFacts facts;  ///< `along`, `plan` and `middle` are not kept in files
};

/// The examples as a table with a header and one line each, lengths rounded to the centimetre.
std::string toCsv(const std::vector<Example>& examples);
/// Reads text of toCsv(). For any other text, throws base::Error(unreadable_input), which names `file` and the line.
std::vector<Example> readExamples(const std::string& text, const std::string& file);

/// The examples that classify() uses by default: surfaces of maps of simulated homes, offices and laboratories
/// (data/examples.csv, made by scripts/surface-examples), and usual sizes of rooms, doors (DIN 18101) and furniture,
/// entered by hand (data/usual.csv), because the maps of a robot have no ceiling and a simulator lacks some furniture.
const std::vector<Example>& knownExamples();

}  // namespace omnimapper::surfaces
