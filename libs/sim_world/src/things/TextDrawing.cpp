#include <ft2build.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/TextDrawing.h>
#include FT_FREETYPE_H

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <stdexcept>

#include "TextureDrawing.h"

namespace omnimapper::sim {

namespace {

// Folders of the DejaVu fonts, first those of Debian and its derivatives, then those of other systems.
constexpr const char* kFontFolders[] = {"/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu",
                                        "/usr/share/fonts/dejavu-sans-fonts", "/usr/share/fonts/TTF",
                                        "/usr/local/share/fonts"};

const char* fileName(FontFace face) {
  switch (face) {
    case FontFace::sans:
      return "DejaVuSans.ttf";
    case FontFace::sans_bold:
      return "DejaVuSans-Bold.ttf";
    case FontFace::serif:
      return "DejaVuSerif.ttf";
    case FontFace::serif_bold:
      return "DejaVuSerif-Bold.ttf";
    case FontFace::mono:
      return "DejaVuSansMono.ttf";
    case FontFace::mono_bold:
      return "DejaVuSansMono-Bold.ttf";
  }
  return "";
}

std::string fontFile(const TextStyle& style) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (!style.font_file.empty()) {
    if (fs::is_regular_file(style.font_file, ignored)) return style.font_file;
    throw base::Error(base::ExitCode::unreadable_input, style.font_file + ": no such font file");
  }
  std::string tried;
  for (const char* folder : kFontFolders) {
    const fs::path path = fs::path(folder) / fileName(style.face);
    if (fs::is_regular_file(path, ignored)) return path.string();
    tried += (tried.empty() ? "" : ", ") + std::string(folder);
  }
  throw base::Error(base::ExitCode::unreadable_input,
                    std::string("the font ") + fileName(style.face) + " is in none of " + tried +
                        "; install the package fonts-dejavu-core or name a font file");
}

// The characters of UTF-8 text.
std::vector<std::uint32_t> charactersOf(const std::string& text) {
  std::vector<std::uint32_t> characters;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i++]);
    const int more = byte < 0x80 ? 0 : byte >> 5 == 0x6 ? 1 : byte >> 4 == 0xe ? 2 : byte >> 3 == 0x1e ? 3 : -1;
    if (more < 0) throw std::invalid_argument("'" + text + "' is not UTF-8");
    std::uint32_t character = more == 0 ? byte : byte & (0x3f >> more);
    for (int k = 0; k < more; ++k) {
      if (i >= text.size() || (text[i] & 0xc0) != 0x80) throw std::invalid_argument("'" + text + "' is not UTF-8");
      character = character << 6 | (text[i++] & 0x3f);
    }
    characters.push_back(character);
  }
  return characters;
}

// A font at a size. Each call makes one, because FreeType's objects must not be shared by threads.
class Font {
 public:
  explicit Font(const TextStyle& style) {
    if (!(style.capital_height > 0)) throw std::invalid_argument("text: its height must be positive");
    const std::string file = fontFile(style);
    if (FT_Init_FreeType(&library_) != 0) throw base::Error(base::ExitCode::internal, "FreeType does not start");
    if (FT_New_Face(library_, file.c_str(), 0, &face_) != 0) {
      FT_Done_FreeType(library_);
      throw base::Error(base::ExitCode::unreadable_input, file + ": not a font that FreeType reads");
    }
    double capital = 0.73;  // height of capitals relative to the em, as in DejaVu
    if (FT_Load_Char(face_, 'H', FT_LOAD_NO_SCALE) == 0 && face_->units_per_EM > 0) {
      capital = static_cast<double>(face_->glyph->metrics.horiBearingY) / face_->units_per_EM;
    }
    FT_Set_Char_Size(face_, 0, std::lround(64 * style.capital_height / std::max(capital, 0.1)), 72, 72);
  }
  ~Font() {
    FT_Done_Face(face_);
    FT_Done_FreeType(library_);
  }
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  // Calls take(glyph, x) for each character with the place of its pen [pixel]; returns the width.
  template <class Take>
  double write(const std::string& text, bool with_pixels, const Take& take) {
    double x = 0;
    FT_UInt previous = 0;
    for (const std::uint32_t character : charactersOf(text)) {
      const FT_UInt glyph = FT_Get_Char_Index(face_, character);
      FT_Vector kerning{0, 0};
      if (previous != 0 && glyph != 0) FT_Get_Kerning(face_, previous, glyph, FT_KERNING_UNFITTED, &kerning);
      x += kerning.x / 64.0;
      if (FT_Load_Glyph(face_, glyph, FT_LOAD_NO_HINTING | (with_pixels ? FT_LOAD_RENDER : 0)) != 0) {
        throw base::Error(base::ExitCode::internal, "FreeType cannot draw a character of '" + text + "'");
      }
      take(*face_->glyph, x);
      x += face_->glyph->linearHoriAdvance / 65536.0;
      previous = glyph;
    }
    return x;
  }
  double above() const { return face_->size->metrics.ascender / 64.0; }
  double below() const { return -face_->size->metrics.descender / 64.0; }

 private:
  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
};

}  // namespace

TextExtent measureText(const std::string& line, const TextStyle& style) {
  Font font(style);
  const double width = font.write(line, false, [](const FT_GlyphSlotRec&, double) {});
  return {width, font.above(), font.below()};
}

void drawText(Texture& texture, const std::string& line, double x, double y, const TextStyle& style) {
  Font font(style);
  const int base_row = static_cast<int>(std::lround(y));
  font.write(line, true, [&](const FT_GlyphSlotRec& glyph, double pen) {
    const int left = static_cast<int>(std::lround(x + pen)) + glyph.bitmap_left, top = base_row - glyph.bitmap_top;
    for (int row = 0; row < static_cast<int>(glyph.bitmap.rows); ++row) {
      for (int column = 0; column < static_cast<int>(glyph.bitmap.width); ++column) {
        const int at_x = left + column, at_y = top + row;
        if (at_x < 0 || at_y < 0 || at_x >= texture.width || at_y >= texture.height) continue;
        const float share = glyph.bitmap.buffer[row * glyph.bitmap.pitch + column] / 255.0f;
        if (share > 0) blendPixel(texture, at_x, at_y, style.colour, share);
      }
    }
  });
}

double drawLines(Texture& texture, const std::vector<std::string>& lines, double x, double y, Alignment alignment,
                 const TextStyle& style) {
  double base_line = y + style.capital_height;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i > 0) base_line += 1.6 * style.capital_height;
    const double width = alignment == Alignment::left ? 0 : measureText(lines[i], style).width;
    drawText(texture, lines[i], x - (alignment == Alignment::centre ? width / 2 : width), base_line, style);
  }
  return base_line;
}

}  // namespace omnimapper::sim
