#include "SignedContraction.h"

#include <omnimapper/perception/ConnectedComponents.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace omnimapper::perception::objects {

namespace {

constexpr int kNone = -1;

std::uint64_t keyOf(int a, int b) {
  const auto low = static_cast<std::uint64_t>(std::min(a, b)), high = static_cast<std::uint64_t>(std::max(a, b));
  return low << 32 | high;
}

// The link between two nodes, by open addressing. Keys are never removed.
class LinkTable {
 public:
  explicit LinkTable(std::size_t links) {
    std::size_t room = 16;
    while (room < 4 * links) room *= 2;
    places_.resize(room, {kEmpty, kNone});
  }

  // The link's number, which can be set; kNone for a pair that is new.
  int& at(int a, int b) {
    if (2 * used_ >= places_.size()) grow();
    const std::uint64_t key = keyOf(a, b);
    Place& place = placeOf(key);
    if (place.key == kEmpty) {
      place = {key, kNone};
      ++used_;
    }
    return place.link;
  }

 private:
  static constexpr std::uint64_t kEmpty = ~0ULL;
  struct Place {
    std::uint64_t key;
    int link;
  };

  Place& placeOf(std::uint64_t key) {
    const std::size_t mask = places_.size() - 1;
    std::size_t i = (key * 0x9E3779B97F4A7C15ULL >> 20) & mask;
    while (places_[i].key != kEmpty && places_[i].key != key) i = (i + 1) & mask;
    return places_[i];
  }
  void grow() {
    std::vector<Place> old(2 * places_.size(), {kEmpty, kNone});
    old.swap(places_);
    for (const Place& place : old) {
      if (place.key != kEmpty) placeOf(place.key) = place;
    }
  }

  std::vector<Place> places_;
  std::size_t used_ = 0;
};

// A join that was possible when it was noted. It is out of date if the link has another weight by now.
struct Join {
  float weight, order;
  std::uint64_t nodes;
  int link;

  bool operator<(const Join& other) const { return order != other.order ? order < other.order : nodes > other.nodes; }
};

class Contraction {
 public:
  Contraction(std::size_t nodes, const std::vector<SignedLink>& links)
      : links_(links), table_(links.size()), links_of_(nodes) {
    for (std::size_t i = 0; i < nodes; ++i) groups_.add();
    joins_.reserve(links.size());
    for (std::size_t i = 0; i < links.size(); ++i) {
      const int link = static_cast<int>(i);
      table_.at(links[i].a, links[i].b) = link;
      of(links[i].a).push_back(link);
      of(links[i].b).push_back(link);
      if (links[i].weight > 0) joins_.push_back(joinBy(link));
    }
    std::make_heap(joins_.begin(), joins_.end());
  }

  void run() {
    while (!joins_.empty()) {
      std::pop_heap(joins_.begin(), joins_.end());
      const Join join = joins_.back();
      joins_.pop_back();
      const SignedLink& link = links_[static_cast<std::size_t>(join.link)];
      if (link.weight == join.weight && keyOf(link.a, link.b) == join.nodes) unite(link.a, link.b);
    }
  }

  std::vector<int> groups() {
    std::vector<int> numbers(links_of_.size(), kNone), result;
    int next = 0;
    for (int i = 0; i < static_cast<int>(links_of_.size()); ++i) {
      int& number = numbers[static_cast<std::size_t>(groups_.find(i))];
      if (number == kNone) number = next++;
      result.push_back(number);
    }
    return result;
  }

 private:
  std::vector<int>& of(int node) { return links_of_[static_cast<std::size_t>(node)]; }
  Join joinBy(int link) const {
    const SignedLink& l = links_[static_cast<std::size_t>(link)];
    return {l.weight, l.weight / (l.length + kBriefBorder), keyOf(l.a, l.b), link};
  }
  void note(int link) {
    if (!(links_[static_cast<std::size_t>(link)].weight > 0)) return;
    joins_.push_back(joinBy(link));
    std::push_heap(joins_.begin(), joins_.end());
  }

  // The node with more links stays; those of the other become its own.
  void unite(int kept, int gone) {
    if (of(kept).size() < of(gone).size()) std::swap(kept, gone);
    groups_.unite(kept, gone);
    for (const int link : of(gone)) {
      SignedLink& moved = links_[static_cast<std::size_t>(link)];
      if (moved.a != gone && moved.b != gone) continue;
      const int other = moved.a == gone ? moved.b : moved.a;
      if (other == kept) {
        moved = {kNone, kNone, 0, 0};
        continue;
      }
      int& known = table_.at(kept, other);
      if (known == kNone) {
        known = link;
        moved.a = kept;
        moved.b = other;
        of(kept).push_back(link);
      } else {
        SignedLink& both = links_[static_cast<std::size_t>(known)];
        both.weight += moved.weight;
        both.length += moved.length;
        moved = {kNone, kNone, 0, 0};
      }
      note(known);
    }
    of(gone).clear();
  }

  std::vector<SignedLink> links_;
  LinkTable table_;
  std::vector<std::vector<int>> links_of_;
  std::vector<Join> joins_;  // a heap
  detail::UnionFind groups_;
};

}  // namespace

std::vector<int> contract(std::size_t nodes, const std::vector<SignedLink>& links) {
  Contraction contraction(nodes, links);
  contraction.run();
  return contraction.groups();
}

}  // namespace omnimapper::perception::objects
