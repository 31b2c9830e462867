#include <omnimapper/sim_world/PosterMaking.h>
#include <omnimapper/sim_world/TextDrawing.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "SignPlate.h"
#include "TextureDrawing.h"

namespace omnimapper::sim {

namespace {

constexpr const char* kTitles[] = {"SUMMER FESTIVAL", "ROBOTS", "VISIT THE COAST", "OPEN DAY", "JAZZ NIGHT",
                                   "RESEARCH WEEK",   "SPACE",  "MOUNTAINS",       "THEATRE",  "EXHIBITION"};
constexpr const char* kNotices[][4] = {{"PLEASE KEEP", "THIS DOOR", "CLOSED", ""},
                                       {"NOTICE", "Coffee machine out", "of order until", "Thursday 14:00"},
                                       {"NO FOOD", "OR DRINKS", "in this area", ""},
                                       {"LOST", "Black umbrella,", "call 4711", ""},
                                       {"SAFETY FIRST", "Wear goggles", "at all times", ""},
                                       {"MEETING", "moved to floor 3", "Tuesday 9:30", ""}};

// The style with which the line is at most `room` wide and its capitals are at most `capitals` high.
TextStyle fitted(const std::string& line, double room, double capitals, FontFace face, const Colour& colour,
                 const std::string& font_file) {
  TextStyle style{face, font_file, capitals, colour};
  const double width = measureText(line, style).width;
  if (width > room) style.capital_height *= room / width;
  return style;
}

void writeInMiddle(Texture& texture, const std::string& line, double y, const TextStyle& style) {
  drawLines(texture, {line}, texture.width / 2.0, y, Alignment::centre, style);
}

void drawShape(Texture& texture, Random& random, double size) {
  const double x = random.uniform(0.1, 0.9) * texture.width, y = random.uniform(0.2, 0.8) * texture.height;
  const Colour colour = randomColour(random, 0.3, 1, 0.3, 1);
  const double radius = random.uniform(0.06, 0.2) * size, turn = random.uniform(0, M_PI);
  const int corners = random.integer(2, 6);
  if (corners == 2) return fillDisc(texture, x, y, radius, colour);
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = turn + 2 * M_PI * i / corners;
    outline.emplace_back(x + radius * std::cos(angle), y + radius * std::sin(angle));
  }
  fillPolygon(texture, outline, colour);
}

void drawPoster(Texture& texture, Random& random, const std::string& font_file) {
  const Colour sky = randomColour(random, 0.2, 0.8, 0.4, 1), ground = randomColour(random, 0.2, 0.8, 0.2, 0.9);
  const double horizon = random.uniform(0.4, 0.8) * texture.height, side = std::min(texture.width, texture.height);
  fillBox(texture, {0, 0, 1.0 * texture.width, horizon}, sky);
  fillBox(texture, {0, horizon, 1.0 * texture.width, 1.0 * texture.height}, ground);
  for (int i = random.integer(8, 14); i > 0; --i) drawShape(texture, random, side);
  for (int i = random.integer(2, 5); i > 0; --i) {
    const Eigen::Vector2d from{random.uniform() * texture.width, random.uniform() * texture.height},
        to{random.uniform() * texture.width, random.uniform() * texture.height};
    const double width = random.uniform(2, 8);
    drawLine(texture, from, to, width, randomColour(random, 0.3, 1, 0.2, 1));
  }
  const char* title = kTitles[random.integer(0, static_cast<int>(std::size(kTitles)) - 1)];
  const bool bright = sky.sum() > 1.6f;
  const TextStyle style = fitted(title, 0.85 * texture.width, 0.09 * texture.height, FontFace::serif_bold,
                                 Colour::Constant(bright ? 0.05f : 0.95f), font_file);
  writeInMiddle(texture, title, 0.05 * texture.height, style);
}

void drawNotice(Texture& texture, Random& random, const std::string& font_file) {
  const auto& lines = kNotices[random.integer(0, static_cast<int>(std::size(kNotices)) - 1)];
  const Colour ink = randomColour(random, 0, 1, 0.05, 0.4);
  fillBox(texture, {0, 0, 1.0 * texture.width, 1.0 * texture.height}, colourOf(random.uniform(0.1, 0.2), 0.1, 0.95));
  if (random.chance(0.5)) drawFrame(texture, {8, 8, texture.width - 8.0, texture.height - 8.0}, 6, ink);
  double y = 0.14 * texture.height;
  for (int i = 0; i < 4; ++i) {
    const FontFace face = i == 0 ? FontFace::sans_bold : FontFace::sans;
    const TextStyle style = fitted(lines[i], 0.8 * texture.width, 0.11 * texture.height, face, ink, font_file);
    writeInMiddle(texture, lines[i], y, style);
    y += 0.2 * texture.height;
  }
}

void drawExtinguisher(Texture& texture, Random&, const std::string& font_file) {
  const double w = texture.width, h = texture.height;
  const Colour red(0.75f, 0.04f, 0.04f), white = Colour::Constant(0.96f);
  fillBox(texture, {0, 0, w, h}, red);
  drawFrame(texture, {0.03 * w, 0.03 * h, 0.97 * w, 0.97 * h}, 0.02 * w, white);
  fillBox(texture, {0.38 * w, 0.3 * h, 0.58 * w, 0.68 * h}, white);
  fillDisc(texture, 0.48 * w, 0.3 * h, 0.1 * w, white);
  drawLine(texture, {0.48 * w, 0.24 * h}, {0.48 * w, 0.15 * h}, 0.05 * w, white);
  drawLine(texture, {0.48 * w, 0.17 * h}, {0.68 * w, 0.24 * h}, 0.04 * w, white);
  drawLine(texture, {0.68 * w, 0.24 * h}, {0.7 * w, 0.5 * h}, 0.04 * w, white);
  const TextStyle style = fitted("FIRE EXTINGUISHER", 0.84 * w, 0.08 * h, FontFace::sans_bold, white, font_file);
  writeInMiddle(texture, "FIRE EXTINGUISHER", 0.78 * h, style);
}

void drawClock(Texture& texture, Random& random, const std::string& font_file) {
  const double x = texture.width / 2.0, y = texture.height / 2.0, r = 0.47 * std::min(texture.width, texture.height);
  const Colour ink = Colour::Constant(0.05f);
  fillBox(texture, {0, 0, 2 * x, 2 * y}, randomColour(random, 0, 0.6, 0.2, 0.6));
  fillDisc(texture, x, y, r, Colour::Constant(0.95f));
  drawRing(texture, x, y, 0.96 * r, 0.06 * r, ink);
  const TextStyle style{FontFace::sans_bold, font_file, 0.14 * r, ink};
  for (int hour = 1; hour <= 12; ++hour) {
    const double angle = M_PI * hour / 6;
    drawLines(texture, {std::to_string(hour)}, x + 0.75 * r * std::sin(angle),
              y - 0.75 * r * std::cos(angle) - 0.07 * r, Alignment::centre, style);
  }
  const double hours = random.uniform(0, 12);
  const auto hand = [&](double turns, double length, double width) {
    const Eigen::Vector2d tip(x + length * std::sin(2 * M_PI * turns), y - length * std::cos(2 * M_PI * turns));
    drawLine(texture, {x, y}, tip, width, ink);
  };
  hand(hours / 12, 0.45 * r, 0.06 * r);
  hand(hours - std::floor(hours), 0.62 * r, 0.035 * r);
}

void drawAnnouncement(Texture& texture, Random& random, const std::string& font_file) {
  static constexpr const char* kEvents[] = {"LECTURE", "CONCERT", "SALE", "SEMINAR", "BLOOD DRIVE", "DEFENSE"};
  static constexpr const char* kMonths[] = {"March", "April", "May", "June", "October", "November"};
  const double width = texture.width, height = texture.height;
  const Colour paper = colourOf(random.uniform(), random.uniform(0.05, 0.6), 0.95),
               ink = randomColour(random, 0.3, 1, 0.05, 0.35);
  const std::string event = kEvents[random.integer(0, 5)], day = std::to_string(random.integer(1, 30)),
                    month = kMonths[random.integer(0, 5)], room = "Room " + std::to_string(random.integer(101, 399)),
                    hour = std::to_string(random.integer(8, 19)) + (random.chance(0.5) ? ":00" : ":30");
  fillBox(texture, {0, 0, width, height}, paper);
  const auto write = [&](const std::string& line, double y, double capitals, FontFace face) {
    writeInMiddle(texture, line, y * height, fitted(line, 0.84 * width, capitals * height, face, ink, font_file));
  };
  write(event, 0.07, 0.09, FontFace::sans_bold);
  write(day, 0.25, 0.24, FontFace::sans_bold);
  write(month, 0.56, 0.06, FontFace::sans);
  write(hour, 0.69, 0.07, FontFace::sans_bold);
  write(room, 0.84, 0.08, FontFace::sans_bold);
}

struct PosterLook {
  double width, height;  // [m]
  double spread;         // largest part by which the seed changes the size
  void (*draw)(Texture&, Random&, const std::string&);
};

PosterLook lookOf(PosterKind kind) {
  switch (kind) {
    case PosterKind::poster:
      return {0.6, 0.84, 0.25, drawPoster};
    case PosterKind::notice:
      return {0.297, 0.21, 0, drawNotice};
    case PosterKind::extinguisher:
      return {0.2, 0.25, 0, drawExtinguisher};
    case PosterKind::clock:
      return {0.3, 0.3, 0.15, drawClock};
    case PosterKind::announcement:
      return {0.42, 0.594, 0, drawAnnouncement};
  }
  throw std::invalid_argument("unknown kind of poster");
}

}  // namespace

Body makePoster(const PosterSpec& spec) {
  if (spec.width < 0 || spec.height < 0) throw std::invalid_argument(spec.name + ": a negative size");
  const PosterLook look = lookOf(spec.kind);
  constexpr std::uint64_t kStream = 0x9057e7;
  Random random(spec.seed, {kStream, static_cast<std::uint64_t>(spec.kind)});
  const double scale = random.uniform(1 - look.spread, 1 + look.spread);
  const double width = spec.width > 0 ? spec.width : scale * look.width,
               height = spec.height > 0 ? spec.height : scale * look.height;
  const double pixels_per_metre = 512 / std::max(width, height);
  Texture picture = blankTexture(std::max(16L, std::lround(width * pixels_per_metre)),
                                 std::max(16L, std::lround(height * pixels_per_metre)), Colour::Ones());
  look.draw(picture, random, spec.font_file);
  return makePlate({spec.name, SurfaceKind::poster, std::make_shared<const Texture>(std::move(picture)), width, height,
                    kPosterThickness, Colour::Constant(0.8f), spec.map_from_poster});
}

}  // namespace omnimapper::sim
