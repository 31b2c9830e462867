// sign-pictures FOLDER STYLE SEED COUNT: writes pictures of simulated door signs and signs.csv with their corners, for
// the training by omnimapper-train-doorsigns. STYLE is dark or white.
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/testing/SignPictures.h>

#include <future>
#include <iostream>
#include <thread>

int main(int argc, char** argv) {
  using namespace omnimapper;
  if (argc != 5) return std::cerr << "sign-pictures FOLDER STYLE SEED COUNT\n", 2;
  const std::string folder = argv[1];
  testing::SignPictureOptions options;
  options.style = argv[2];
  options.seed = std::stoull(argv[3]);
  const int count = std::stoi(argv[4]);
  const testing::SignPictures pictures(options);
  base::makeWritableFolder(folder);
  std::vector<std::future<std::string>> rows;
  const int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  for (int first = 0; first < threads; ++first) {
    rows.push_back(std::async(std::launch::async, [&, first] {
      std::string mine;
      for (int k = first; k < count; k += threads) {
        const auto picture = pictures.picture(k);
        const std::string file = picture.name + ".jpg";
        if (!picture.image.saveToFile(folder + "/" + file, 92)) throw std::runtime_error("cannot write " + file);
        for (const auto& sign : picture.signs) {
          mine += file + "," + sign.name + ",\"" + sign.text + "\"";
          for (const auto& corner : sign.corners_px)
            mine += "," + base::fixed(corner.x(), 2) + "," + base::fixed(corner.y(), 2);
          mine += "," + base::fixed(sign.visible, 2) + "\n";
        }
      }
      return mine;
    }));
  }
  base::writeFile(folder + "/signs.csv", [&](std::ostream& out) {
    out << "image,sign,text,x1,y1,x2,y2,x3,y3,x4,y4,visible\n";
    for (auto& each : rows) out << each.get();
  });
  return 0;
}
