#include "CompanionGroups.h"

#include <omnimapper/sim_world/Random.h>

namespace omnimapper::sim {

namespace {

using Place = CompanionPlan::Place;

constexpr std::uint64_t kGroupStream = 0xc0913;

struct Member {
  Place place;
  double distance, side;  // [m]
};

std::vector<Member> membersOf(CompanionGroup group, bool on_left) {
  std::vector<Member> members;
  if (group == CompanionGroup::guide) members = {{Place::stops, 1.2, 0}};
  if (group == CompanionGroup::guests) members = {{Place::beside, 1, on_left ? 0.75 : -0.75}, {Place::behind, 1, 0}};
  if (group == CompanionGroup::group || group == CompanionGroup::crowd) {
    members = {{Place::ahead, 1.2, 0},
               {Place::ahead, 1, 0.65},
               {Place::ahead, 1, -0.65},
               {Place::beside, 1, 0.75},
               {Place::beside, 1, -0.75}};
  }
  if (group == CompanionGroup::crowd) {
    members.push_back({Place::behind, 1, 0});
    members.push_back({Place::crossing, 2, 0});
  }
  return members;
}

}  // namespace

std::vector<CompanionPlan> companionsOf(CompanionGroup group, std::uint64_t seed) {
  constexpr double kShort = 1.55, kTall = 1.92;  // [m]
  Random random(seed, {kGroupStream});
  std::vector<CompanionPlan> companions;
  for (const Member& member : membersOf(group, random.chance(0.5))) {
    CompanionPlan companion;
    companion.name = "companion_" + std::to_string(companions.size() + 1);
    companion.height = random.uniform(kShort, kTall);
    companion.place = member.place;
    companion.distance = member.distance;
    companion.side = member.side;
    companions.push_back(companion);
  }
  return companions;
}

}  // namespace omnimapper::sim
