#pragma once

#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace omnimapper::source {

/// A folder of small depth and colour images, to be imported.
class RgbdImages {
 protected:
  void writeText(const std::string& name, const std::string& text) {
    const std::filesystem::path path(folder_ / name);
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  void writeDepth(const std::string& name, std::uint16_t value, unsigned width = 4, unsigned height = 3) {
    mrpt::img::CImage image;
    image.resize(width, height, mrpt::img::CH_GRAY, mrpt::img::PixelDepth::D16U);
    for (unsigned y = 0; y < height; ++y)
      for (unsigned x = 0; x < width; ++x)
        image.ptrLine<std::uint16_t>(y)[x] = static_cast<std::uint16_t>(value + x + 10 * y);
    save(image, name);
  }
  void writeColour(const std::string& name, std::uint8_t red) {
    mrpt::img::CImage image(4, 3, mrpt::img::CH_RGB);
    image.filledRectangle(0, 0, 3, 2, mrpt::img::TColor(red, 20, 30));
    save(image, name);
  }
  /// Three depth images, the colour of the second 30 ms late.
  void writeTum() {
    writeText("depth.txt", "# depth maps\n10.0 depth/a.png\n10.1 depth/b.png\n10.2 depth/c.png\n");
    writeText("rgb.txt", "# colour\n10.01 rgb/a.png\n10.13 rgb/b.png\n10.195 rgb/c.png\n");
    for (const char* name : {"a", "b", "c"}) {
      writeDepth(std::string("depth/") + name + ".png", 5000);
      writeColour(std::string("rgb/") + name + ".png", static_cast<std::uint8_t>(name[0]));
    }
  }

  testing::ScratchFolder folder_;

 private:
  void save(const mrpt::img::CImage& image, const std::string& name) {
    const std::filesystem::path path(folder_ / name);
    std::filesystem::create_directories(path.parent_path());
    ASSERT_TRUE(image.saveToFile(path.string()));
  }
};

}  // namespace omnimapper::source
