#include <gtest/gtest.h>

#include "ros_log/TopicTable.h"

namespace omnimapper::ros::topic_table_test {
namespace {

TEST(RosTopicTable, hasABoundedNumberOfReasonsAndLabels) {
  TopicTable table;
  const Channel channel{"/a", "std_msgs/String", "", "ros1"};
  for (int i = 0; i < 1000; ++i) {
    table.read(channel);
    table.leftOut(channel, std::to_string(i) + std::string(5000, 'x'));
    table.taken(channel, std::to_string(i) + std::string(5000, 'y'));
  }
  const auto lines = table.lines();
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_LT(lines[0].size(), 25'000u);
  EXPECT_NE(lines[0].find("; left out: 950, other reasons"), std::string::npos);
  EXPECT_NE(lines[0].find("; other sensors: 950"), std::string::npos);
}

}  // namespace
}  // namespace omnimapper::ros::topic_table_test
