#include <omnimapper/draw/LabelColours.h>

#include <array>
#include <cstdint>
#include <map>

namespace omnimapper::draw {

Rgb colourOfLabel(const std::string& label) {
  static const std::map<std::string, Rgb> known{
      {"wall", {180, 83, 9}},       {"door", {22, 163, 74}},       {"door frame", {134, 180, 90}},
      {"window", {6, 182, 212}},    {"table", {147, 51, 234}},     {"counter", {192, 38, 211}},
      {"cabinet", {202, 138, 4}},   {"shelf", {161, 98, 7}},       {"seat", {37, 99, 235}},
      {"bed", {79, 70, 229}},       {"appliance", {13, 148, 136}}, {"floor", {100, 116, 139}},
      {"ceiling", {125, 200, 240}}, {"ramp", {219, 39, 119}},      {"object", {190, 75, 120}},
      {"surface", {150, 145, 140}}};
  if (const auto found = known.find(label); found != known.end()) return found->second;
  constexpr std::array<Rgb, 4> kOthers{Rgb{13, 148, 136}, Rgb{202, 138, 4}, Rgb{225, 29, 72}, Rgb{79, 70, 229}};
  std::uint32_t sum = 0;
  for (const char letter : label) sum = 31 * sum + static_cast<unsigned char>(letter);
  return kOthers[sum % kOthers.size()];
}

bool coversThePlan(const std::string& label) {
  return label == "floor" || label == "ceiling";
}

}  // namespace omnimapper::draw
