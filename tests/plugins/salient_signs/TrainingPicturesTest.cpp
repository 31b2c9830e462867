#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <ostream>

#include "salient_signs/TrainingPictures.h"

namespace omnimapper::signs::pictures_test {
namespace {

void writePicture(const std::string& path, int left, int top, int right, int bottom) {
  mrpt::img::CImage picture(160, 120, mrpt::img::CH_GRAY);
  picture.filledRectangle(0, 0, 159, 119, mrpt::img::TColor(0, 0, 0));
  if (right > left) picture.filledRectangle(left, top, right, bottom, mrpt::img::TColor(255, 255, 255));
  ASSERT_TRUE(picture.saveToFile(path));
}

void writeText(const std::string& path, const std::string& text) {
  base::writeFile(path, [&](std::ostream& out) { out << text; });
}

std::string refusalOf(const std::string& folder) {
  try {
    readTrainingFolder(folder);
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
    return error.what();
  }
  return "";
}

TEST(ReadTrainingFolder, aTableHasTheSignsOfEachPicture) {
  const testing::ScratchFolder folder;
  writePicture(folder / "b.png", 0, 0, 0, 0);
  writePicture(folder / "a.png", 0, 0, 0, 0);
  writeText(folder / "signs.csv",
            "sign,image,x1,y1,x2,y2,x3,y3,x4,y4,text,visible\n"
            "118,b.png,10,20,50.5,20,50.5,45,10,45,\"118|a, \"\"b\"\"\",0.75\n"
            "119,b.png,60,20,90,20,90,45,60,45,,1\n");
  const TrainingSet set = readTrainingFolder(folder.path());
  ASSERT_EQ(set.pictures.size(), 2u);
  EXPECT_EQ(set.pictures[0].name, "a.png");
  EXPECT_TRUE(set.pictures[0].signs.empty());
  ASSERT_EQ(set.pictures[1].signs.size(), 2u);
  const TrueSign& sign = set.pictures[1].signs[0];
  EXPECT_EQ(sign.sign, "118");
  EXPECT_EQ(sign.visible, 0.75);
  EXPECT_EQ(sign.corners_px[2], Eigen::Vector2f(50.5f, 45));
  EXPECT_FALSE(counts(sign));
  EXPECT_TRUE(counts(set.pictures[1].signs[1]));
  EXPECT_EQ(set.pictures[1].load().getWidth(), 160);
}

TEST(ReadTrainingFolder, aMaskHasTheSignsOfItsPicture) {
  const testing::ScratchFolder folder;
  writePicture(folder / "a.png", 0, 0, 0, 0);
  writePicture(folder / "a.mask.png", 30, 40, 80, 70);
  writePicture(folder / "without.png", 0, 0, 0, 0);
  const TrainingSet set = readTrainingFolder(folder.path());
  ASSERT_EQ(set.pictures.size(), 1u);
  ASSERT_EQ(set.pictures[0].signs.size(), 1u);
  EXPECT_LT((set.pictures[0].signs[0].corners_px[0] - Eigen::Vector2f(30, 40)).norm(), 2);
  EXPECT_LT((set.pictures[0].signs[0].corners_px[2] - Eigen::Vector2f(80, 70)).norm(), 2);
}

TEST(ReadTrainingFolder, whatIsWrongIsSaidWithFileAndLine) {
  const testing::ScratchFolder folder;
  EXPECT_NE(refusalOf(folder / "absent"), "");
  EXPECT_NE(refusalOf(folder.path()).find("signs.csv"), std::string::npos);
  writePicture(folder / "a.png", 0, 0, 0, 0);
  const std::string head = "image,x1,y1,x2,y2,x3,y3,x4,y4\n";
  for (const auto& [text, said] :
       {std::pair<std::string, std::string>{"", "empty"},
        {"image,x1\na.png,1\n", "no column"},
        {head + "a.png,1,2,3\n", "signs.csv:2"},
        {head + "c.png,1,2,3,4,5,6,7,8\n", "c.png"},
        {head + "a.png,0,0,9,0,9,9,0,9\na.png,1,2,3,4,5,x,7,8\n", "signs.csv:3"},
        {head + "a.png,1,2,3,4,5,nan,7,8\n", "no number"},
        {"image,x1,x1\na.png,1,2\n", "'x1' twice"},
        {head + "a.png,0,0,9,0,0,9,9,9\n", "signs.csv:2: its corners"},
        {head + "a.png,0,0,0,9,9,9,9,0\n", "signs.csv:2: its corners"},
        {head + "a.png,5,5,5,5,5,5,5,5\n", "signs.csv:2: its corners"},
        {"image,x1,y1,x2,y2,x3,y3,x4,y4,visible\na.png,0,0,9,0,9,9,0,9,1.5\n", "signs.csv:2: column visible"}}) {
    writeText(folder / "signs.csv", text);
    EXPECT_NE(refusalOf(folder.path()).find(said), std::string::npos) << text;
  }
}

TEST(ReadTrainingFolder, aPictureThatIsNoneIsRefusedWhenItIsNeeded) {
  const testing::ScratchFolder folder;
  writeText(folder / "a.jpg", "no picture");
  writeText(folder / "signs.csv", "image,x1,y1,x2,y2,x3,y3,x4,y4\n");
  const TrainingSet set = readTrainingFolder(folder.path());
  ASSERT_EQ(set.pictures.size(), 1u);
  EXPECT_THROW(set.pictures[0].load(), base::Error);
  std::filesystem::remove(folder / "a.jpg");
  ASSERT_TRUE(mrpt::img::CImage(cv::Mat(20, 30, CV_16UC1, cv::Scalar(1000)), mrpt::img::DEEP_COPY)
                  .saveToFile(folder / "a.png"));
  try {
    readTrainingFolder(folder.path()).pictures.at(0).load();
    FAIL() << "pictures of 16 bits are not supported";
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("a.png"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace omnimapper::signs::pictures_test
