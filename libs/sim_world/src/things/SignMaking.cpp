#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/SignMaking.h>
#include <omnimapper/sim_world/TextDrawing.h>

#include <algorithm>
#include <cmath>

#include "SignPlate.h"
#include "TextureDrawing.h"

namespace omnimapper::sim {

namespace {

constexpr double kPixelsPerMetre = 2000;
constexpr double kLeastCapitals = 24;  // [pixel]
constexpr double kUsualWidth = 0.3;    // text is made smaller so that a sign is no wider than this [m]
constexpr double kLargest = 0.5;       // [m]

// What distinguishes a style; lengths in pixels.
struct Look {
  Colour plate, ink;
  FontFace title_face, text_face;
  double title_capitals, text_capitals;
  double margin, foot;  // left free on all sides, and below the text
  double least_width, least_height;
};

Look lookOf(SignStyle style) {
  if (style == SignStyle::dark) {
    return {{0.03f, 0.05f, 0.16f},
            {0.96f, 0.96f, 0.96f},
            FontFace::sans_bold,
            FontFace::sans_bold,
            84,
            34,
            30,
            36,
            400,
            240};
  }
  if (style == SignStyle::exit) {
    return {{0.0f, 0.3f, 0.13f},
            {0.96f, 0.96f, 0.96f},
            FontFace::sans_bold,
            FontFace::sans_bold,
            150,
            60,
            40,
            60,
            560,
            300};
  }
  return {
      {0.93f, 0.93f, 0.91f}, {0.02f, 0.02f, 0.02f}, FontFace::serif_bold, FontFace::serif, 60, 30, 36, 30, 480, 200};
}

struct Line {
  std::string text;
  TextStyle style;
  double width = 0;
};

// Both lengths of the plate in pixels, and the lines at the size that fits.
struct Layout {
  std::vector<Line> lines;
  double width = 0, height = 0;
};

[[noreturn]] void refuse(const SignSpec& spec, const std::string& why) {
  throw base::Error(base::ExitCode::out_of_range, "sign '" + spec.name + "': " + why);
}

double gapAfter(const Line& line) {
  return std::round(0.65 * std::min(line.style.capital_height, 40.0));
}

Layout layOut(const SignSpec& spec, const Look& look) {
  if (spec.lines.empty()) refuse(spec, "it has no text");
  const double wanted = (spec.width > 0 ? spec.width : kUsualWidth) * kPixelsPerMetre - 2 * look.margin;
  const double limit = (spec.width > 0 ? spec.width : kLargest) * kPixelsPerMetre - 2 * look.margin;
  Layout layout;
  double needed_width = 0, needed_height = 2 * look.margin + look.foot;
  for (std::size_t i = 0; i < spec.lines.size(); ++i) {
    Line line;
    line.text = spec.lines[i];
    line.style.face = i == 0 ? look.title_face : look.text_face;
    line.style.font_file = spec.font_file;
    line.style.capital_height = i == 0 ? look.title_capitals : look.text_capitals;
    line.style.colour = look.ink;
    line.width = measureText(line.text, line.style).width;
    if (line.width > wanted) {
      line.style.capital_height = std::max(kLeastCapitals, std::floor(line.style.capital_height * wanted / line.width));
      line.width = measureText(line.text, line.style).width;
    }
    if (line.width > limit) {
      refuse(spec, "'" + line.text + "' is too long for " + std::to_string(spec.width > 0 ? spec.width : kLargest) +
                       " m; divide it into lines" + (spec.width > 0 ? " or make the sign wider" : ""));
    }
    needed_width = std::max(needed_width, line.width + 2 * look.margin);
    needed_height += line.style.capital_height + (i + 1 < spec.lines.size() ? gapAfter(line) : 0);
    layout.lines.push_back(std::move(line));
  }
  layout.width = spec.width > 0 ? spec.width * kPixelsPerMetre : std::max(needed_width, look.least_width);
  layout.height = spec.height > 0 ? spec.height * kPixelsPerMetre : std::max(needed_height, look.least_height);
  if (needed_height > layout.height || layout.height > kLargest * kPixelsPerMetre) {
    refuse(spec, "its text is " + std::to_string(needed_height / kPixelsPerMetre) +
                     " m high; use fewer lines or make the sign higher (at most 0.5 m)");
  }
  return layout;
}

// Draws dots like braille: cells of two by three, some raised. They depend on the text.
void drawDots(Texture& texture, double x, double y, const std::string& text, const Colour& colour) {
  for (std::size_t i = 0; i < std::min<std::size_t>(text.size(), 6); ++i) {
    const int code = static_cast<unsigned char>(text[i]) * 37 % 64;
    for (int dot = 0; dot < 6; ++dot) {
      if ((code >> dot & 1) != 0) fillDisc(texture, x + 18.0 * i + 7 * (dot % 2), y + 7.0 * (dot / 2), 2.2, colour);
    }
  }
}

void drawArrow(Texture& texture, double right, double middle, const Colour& colour) {
  drawLine(texture, {right - 34, middle}, {right - 8, middle}, 5, colour);
  fillPolygon(texture, {{right - 16, middle - 12}, {right - 16, middle + 12}, {right, middle}}, colour);
}

Texture drawDark(const Layout& layout, const Look& look) {
  Texture texture = blankTexture(std::lround(layout.width), std::lround(layout.height), look.plate);
  double y = look.margin;
  for (const Line& line : layout.lines) {
    drawText(texture, line.text, (layout.width - line.width) / 2, y + line.style.capital_height, line.style);
    y += line.style.capital_height + gapAfter(line);
  }
  const Colour dots = 0.5f * look.ink + 0.5f * look.plate;
  drawDots(texture, layout.width / 2 - 30, layout.height - 40, layout.lines.front().text, dots);
  return texture;
}

Texture drawWhite(const Layout& layout, const Look& look) {
  Texture texture = blankTexture(std::lround(layout.width), std::lround(layout.height), look.plate);
  drawFrame(texture, {6, 6, layout.width - 6, layout.height - 6}, 8, look.ink);
  double y = look.margin;
  for (std::size_t i = 0; i < layout.lines.size(); ++i) {
    const Line& line = layout.lines[i];
    drawText(texture, line.text, look.margin, y + line.style.capital_height, line.style);
    y += line.style.capital_height + gapAfter(line);
  }
  const double rule = look.margin + layout.lines.front().style.capital_height + 13;
  if (layout.lines.size() > 1) fillBox(texture, {look.margin, rule, layout.width - look.margin, rule + 2}, look.ink);
  drawArrow(texture, layout.width - look.margin, layout.height - 34, 0.6f * look.ink + 0.4f * look.plate);
  return texture;
}

Texture drawExit(const Layout& layout, const Look& look) {
  Texture texture = blankTexture(std::lround(layout.width), std::lround(layout.height), look.plate);
  double y = look.margin;
  for (const Line& line : layout.lines) {
    drawText(texture, line.text, (layout.width - line.width) / 2, y + line.style.capital_height, line.style);
    y += line.style.capital_height + gapAfter(line);
  }
  drawArrow(texture, layout.width / 2 + 17, layout.height - 44, look.ink);
  return texture;
}

Texture draw(SignStyle style, const Layout& layout, const Look& look) {
  switch (style) {
    case SignStyle::dark:
      return drawDark(layout, look);
    case SignStyle::white:
      return drawWhite(layout, look);
    case SignStyle::exit:
      break;
  }
  return drawExit(layout, look);
}

}  // namespace

double usualHeight(SignStyle style) {
  switch (style) {
    case SignStyle::dark:
      return 1.5;
    case SignStyle::white:
      return 1.62;
    case SignStyle::exit:
      break;
  }
  return 2.2;
}

MadeSign makeSign(const SignSpec& spec) {
  const Look look = lookOf(spec.style);
  const Layout layout = layOut(spec, look);
  const Texture picture = draw(spec.style, layout, look);
  const double width = picture.width / kPixelsPerMetre, height = picture.height / kPixelsPerMetre;
  SignPlate plate{
      spec.name,  SurfaceKind::sign, std::make_shared<const Texture>(picture), width, height, kSignThickness,
      look.plate, spec.map_from_sign};
  std::vector<double> capitals;
  for (const Line& line : layout.lines) capitals.push_back(line.style.capital_height / kPixelsPerMetre);
  return {makePlate(plate), {spec.name, spec.lines, spec.room, spec.map_from_sign, width, height, capitals}};
}

}  // namespace omnimapper::sim
