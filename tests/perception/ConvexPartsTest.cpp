#include <gtest/gtest.h>
#include <omnimapper/perception/OrganizedPoints.h>

#include <algorithm>
#include <set>

#include "TableScene.h"
#include "objects/ClusterPatches.h"
#include "objects/ConvexParts.h"
#include "objects/SignedContraction.h"

namespace omnimapper::perception::objects {
namespace {

TEST(SignedContraction, JoinsWhatIsLinkedByAPositiveSum) {
  // Two squares of four nodes with a weak link for and a strong link against between them.
  const std::vector<SignedLink> links{{0, 1, 6, 6}, {1, 2, 6, 6}, {2, 3, 6, 6}, {0, 3, 6, 6}, {4, 5, 6, 6},
                                      {5, 6, 6, 6}, {6, 7, 6, 6}, {4, 7, 6, 6}, {1, 4, 2, 2}, {2, 7, -5, 5}};
  EXPECT_EQ(contract(8, links), (std::vector<int>{0, 0, 0, 0, 1, 1, 1, 1}));
  auto weaker = links;
  weaker.back().weight = -1;
  EXPECT_EQ(contract(8, weaker), std::vector<int>(8, 0));
}

TEST(SignedContraction, ALeakDoesNotJoinTwoChains) {
  // Chains 0 to 9 and 10 to 19 run along each other. They speak against each other everywhere but at one end.
  std::vector<SignedLink> links;
  for (int i = 0; i < 9; ++i) {
    links.push_back({i, i + 1, 9, 6});
    links.push_back({i + 10, i + 11, 9, 6});
  }
  for (int i = 0; i < 10; ++i) links.push_back({i, i + 10, i == 0 ? 3.F : -2.F, 3});
  const auto groups = contract(20, links);
  EXPECT_EQ((std::set<int>(groups.begin(), groups.begin() + 10)), std::set<int>{0});
  EXPECT_EQ((std::set<int>(groups.begin() + 10, groups.end())), std::set<int>{1});
}

TEST(SignedContraction, NodesWithoutLinksStayAlone) {
  EXPECT_TRUE(contract(0, {}).empty());
  EXPECT_EQ(contract(3, {{0, 2, 0, 5}}), (std::vector<int>{0, 1, 2})) << "no evidence is no reason to join";
}

// All points of a rendered scene that are above the table, by the comparator that objects are found with.
struct Above {
  OrganizedPoints points;
  std::vector<std::uint16_t> labels;
  std::vector<std::uint8_t> masked{1, 0};
  NormalImage normals;
  ClusterComparator near{points, labels, masked, 0.02F, 0.0069F};

  explicit Above(const rooms::TableScene& table) {
    const auto view = rooms::render(table.scene);
    const camera::DepthImage image(view.depth.data(), 640, 480, table.scene.camera);
    points = backProject(image);
    normals = NormalEstimator({}).estimate(image);
    for (std::size_t i = 0; i < points.z.size(); ++i) {
      const Eigen::Vector3d in_room =
          table.room_from_camera * Eigen::Vector3f(points.x[i], points.y[i], points.z[i]).cast<double>();
      labels.push_back(in_room.z() > 0.705 && in_room.x() < 1.9 ? 1 : 0);
    }
  }
  std::size_t count() const { return static_cast<std::size_t>(std::count(labels.begin(), labels.end(), 1)); }
};

std::size_t partsOf(const Above& above, int fewest) {
  const auto labels = convexParts(above.near, above.normals, 0.5, fewest);
  EXPECT_EQ(labels.size(), above.labels.size());
  std::set<std::int32_t> parts;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    EXPECT_TRUE(labels[i] == 0 || above.labels[i] == 1);
    if (labels[i] != 0) parts.insert(labels[i]);
  }
  return parts.size();
}

TEST(ConvexParts, ThreeFacesOfABoxAreOnePartAndEachBoxOfAStackIsOne) {
  rooms::TableScene table;
  table.addBlock({1, 0, 0.75}, {0.3, 0.3, 0.1}, 0.5);
  EXPECT_EQ(partsOf(Above(table), 300), 1U);
  table.addBlock({1, 0, 0.84}, {0.2, 0.2, 0.08}, 0.5);
  EXPECT_EQ(partsOf(Above(table), 300), 2U);
  table.addBlock({1, 0, 0.94}, {0.08, 0.1, 0.12}, 0.2);
  EXPECT_EQ(partsOf(Above(table), 300), 3U);
}

TEST(ConvexParts, TwoLevelsWhoseStepIsHiddenAreTwoParts) {
  rooms::TableScene table;
  table.addBlock({0.9, 0, 0.72}, {0.2, 0.3, 0.04});
  table.addBlock({1.1, 0, 0.71}, {0.2, 0.3, 0.02});  // behind it and 2 cm lower: the camera sees both tops, no side
  EXPECT_EQ(partsOf(Above(table), 300), 2U);
}

TEST(ConvexParts, PartsThatAreTooSmallFallToTheirNeighbours) {
  rooms::TableScene table;
  table.addBlock({1, 0, 0.75}, {0.3, 0.3, 0.1}, 0.5);
  table.addBlock({1, 0, 0.81}, {0.03, 0.03, 0.02}, 0.5);
  const Above above(table);
  const auto labels = convexParts(above.near, above.normals, 0.5, 3000);
  EXPECT_EQ(std::count(labels.begin(), labels.end(), 1), static_cast<std::ptrdiff_t>(above.count()));
  EXPECT_EQ(partsOf(above, 1000000), 0U);
}

TEST(ClusterPatches, CoverTheClustersAndLinkNeighbours) {
  rooms::TableScene table;
  table.addBlock({1, 0, 0.75}, {0.2, 0.2, 0.1});
  const Above above(table);
  const ClusterPatches cut = cutToPatches(above.near, above.normals, 300);
  std::vector<int> pixels(cut.patches.size(), 0);
  for (std::size_t i = 0; i < cut.labels.size(); ++i) {
    ASSERT_EQ(cut.labels[i] != 0, above.labels[i] != 0) << i;
    if (cut.labels[i] != 0) ++pixels[static_cast<std::size_t>(cut.labels[i] - 1)];
  }
  int flat = 0;
  for (std::size_t i = 0; i < cut.patches.size(); ++i) {
    EXPECT_EQ(pixels[i], cut.patches[i].pixels);
    EXPECT_NEAR(cut.patches[i].normal.norm(), 1, 1e-5);
    const Eigen::Vector3d up = table.room_from_camera.linear() * cut.patches[i].normal.cast<double>();
    if (up.z() > 0.99 || std::abs(up.z()) < 0.1) flat += pixels[i];
  }
  EXPECT_GT(flat, 0.95 * static_cast<double>(above.count())) << "few patches reach around an edge";
  for (std::size_t i = 0; i < cut.contacts.size(); ++i) {
    const auto& [a, b, length] = cut.contacts[i];
    EXPECT_LT(a, b);
    EXPECT_GT(length, 0);
    EXPECT_LE(length, 2 * kPatch + 30) << "no longer than the borders of a patch and the pixels that it was given";
    if (i == 0) continue;
    const auto& before = cut.contacts[i - 1];
    EXPECT_TRUE(before.a < a || (before.a == a && before.b < b));
  }
}

}  // namespace
}  // namespace omnimapper::perception::objects
