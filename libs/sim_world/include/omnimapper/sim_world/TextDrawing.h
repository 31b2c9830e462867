#pragma once

#include <omnimapper/sim_world/Texture.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace omnimapper::sim {

enum class FontFace { sans, sans_bold, serif, serif_bold, mono, mono_bold };

/// How text looks. Fonts are DejaVu's, of the Debian package fonts-dejavu-core, unless a file is named.
struct TextStyle {
  FontFace face = FontFace::sans_bold;
  std::string font_file;       ///< a TrueType or OpenType file; empty: the face's file where Debian keeps it
  double capital_height = 32;  ///< height of a capital H [pixel]
  Eigen::Vector3f colour{0, 0, 0};
};

/// Extent of a line of UTF-8 text [pixel]: the distance that the pen travels, and the reach of ascenders and descenders
/// in the font.
struct TextExtent {
  double width = 0, above = 0, below = 0;  ///< above and below the base line, both positive
};

/// Throws base::Error(unreadable_input) if the font file is missing or is no font, std::invalid_argument if the text is
/// not UTF-8 or the height not positive.
TextExtent measureText(const std::string& line, const TextStyle& style);

/// Writes one line, anti-aliased. The pen starts at x on the base line y, both measured from the upper left corner of
/// the texture [pixel]. Pixels outside the texture are cut off. Throws as measureText().
void drawText(Texture& texture, const std::string& line, double x, double y, const TextStyle& style);

enum class Alignment { left, centre, right };
/// Writes lines below each other. The tops of the capitals of the first line are at y, and base lines are 1.6 heights
/// of a capital apart. By `alignment`, x is the left end, the middle or the right end of each line. Returns the y of
/// the last base line. Throws as measureText().
double drawLines(Texture& texture, const std::vector<std::string>& lines, double x, double y, Alignment alignment,
                 const TextStyle& style);

}  // namespace omnimapper::sim
