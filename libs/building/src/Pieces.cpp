#include "Pieces.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace omnimapper::building {

namespace {

/// Looks at what is on both sides of cuts.
class SideSight {
 public:
  SideSight(const FreeSpace& space, const Pieces& pieces)
      : space_(space), pieces_(pieces), step_(sampleStep(space)), mark_(space.free.total(), 0) {}

  void look(Cut& cut) {
    const cv::Point2d along = cut.direction();
    for (double place = step_; place < cut.length() - 0.5 * step_; place += step_)
      cut.opening.push_back(sides(cut.from + along * place, cut.normal(), kAtOpening));
    lookBeyond(cut, cut.from, -along);
    lookBeyond(cut, cut.to, along);
    cut.left_clearance = clearanceAt(cut, 1);
    cut.right_clearance = clearanceAt(cut, -1);
  }

 private:
  static constexpr double kAtOpening = 3;                                           // [cells]
  static constexpr double kBeyond = 4, kThickest = 0.6, kBand = 0.1, kClose = 1.5;  // [m]

  int pieceAt(const cv::Point2d& at) const {
    const int x = cvRound(at.x), y = cvRound(at.y);
    return space_.contains(x, y) ? pieces_.number.at<int>(y, x) : 0;
  }
  int firstPiece(const cv::Point2d& at, const cv::Point2d& towards, double reach) const {
    for (double off = 1; off <= reach; off += 1)
      if (const int piece = pieceAt(at + towards * off); piece != 0) return piece;
    return 0;
  }
  Sides sides(const cv::Point2d& at, const cv::Point2d& normal, double reach) const {
    return {firstPiece(at, normal, reach), firstPiece(at, -normal, reach)};
  }

  void lookBeyond(Cut& cut, const cv::Point2d& end, const cv::Point2d& along) const {
    const cv::Point2d normal = cut.normal();
    const double band = kBand / space_.cell;
    for (double place = step_; place * space_.cell < kBeyond; place += step_) {
      const cv::Point2d at = end + along * place;
      bool is_wall = false;
      for (double off = -band; off <= band + 0.01 && !is_wall; off += 1) is_wall = !space_.isFree(at + normal * off);
      if (is_wall) cut.beyond.push_back(sides(at, normal, kThickest / space_.cell));
    }
  }

  /// The largest clearance [m] of the cells that can be reached from one side of a cut without crossing its line.
  double clearanceAt(const Cut& cut, int side) {
    const cv::Point2d along = cut.direction(), normal = cut.normal() * side;
    ++last_mark_;
    std::vector<cv::Point> reached;
    const auto visit = [&](const cv::Point& at) {
      if (!space_.contains(at.x, at.y) || space_.free.at<std::uint8_t>(at) == 0) return;
      int& mark = mark_[static_cast<std::size_t>(at.y) * space_.free.cols + at.x];
      if (mark == last_mark_) return;
      mark = last_mark_;
      reached.push_back(at);
    };
    for (double place = 1; place < cut.length() - 0.5; place += 1)
      for (const double off : {1.0, 2.0}) visit(cut.from + along * place + normal * off);
    const cv::Point2d middle = 0.5 * (cut.from + cut.to);
    const double half = 0.5 * cut.length(), reach = kClose / space_.cell;
    float largest = 0;
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const cv::Point at = reached[i];
      largest = std::max(largest, space_.clearance.at<float>(at));
      for (const cv::Point offset : {cv::Point(-1, 0), cv::Point(1, 0), cv::Point(0, -1), cv::Point(0, 1)}) {
        const cv::Point2d to = cv::Point2d(at + offset) - middle;
        const double ahead = to.dot(normal), aside = std::abs(to.dot(along));
        const bool is_on_line = ahead < 0.5 && aside <= half + 1;
        if (!is_on_line && ahead >= -1 && std::hypot(std::max(0.0, aside - half), ahead) <= reach) visit(at + offset);
      }
    }
    return largest * space_.cell;
  }

  const FreeSpace& space_;
  const Pieces& pieces_;
  double step_;
  std::vector<int> mark_;
  int last_mark_ = 0;
};

void measure(const FreeSpace& space, Pieces& pieces) {
  cv::Mat near_occupied;
  cv::dilate(space.occupied, near_occupied, cv::Mat::ones(3, 3, CV_8U));
  for (int y = FreeSpace::kMargin; y < space.free.rows - FreeSpace::kMargin; ++y) {
    const int* number = pieces.number.ptr<int>(y);
    const std::uint8_t *above = space.free.ptr(y - 1), *row = space.free.ptr(y), *below = space.free.ptr(y + 1);
    const auto* clearance = space.clearance.ptr<float>(y);
    for (int x = FreeSpace::kMargin; x < space.free.cols - FreeSpace::kMargin; ++x) {
      if (number[x] == 0) continue;
      Piece& piece = pieces.pieces[number[x]];
      piece.area += space.cell * space.cell;
      piece.clearance = std::max(piece.clearance, clearance[x] * space.cell);
      const bool is_border = row[x - 1] == 0 || row[x + 1] == 0 || above[x] == 0 || below[x] == 0;
      if (is_border) ++(near_occupied.at<std::uint8_t>(y, x) != 0 ? piece.walls : piece.unseen);
    }
  }
}

}  // namespace

void Piece::add(const Piece& other) {
  area += other.area;
  clearance = std::max(clearance, other.clearance);
  walls += other.walls;
  unseen += other.unseen;
}

double sampleStep(const FreeSpace& space) {
  return std::max(1.0, 0.05 / space.cell);
}

Pieces cutIntoPieces(const FreeSpace& space, const std::vector<Cut>& cuts) {
  cv::Mat rest = space.free.clone();
  for (const Cut& cut : cuts) cv::line(rest, cut.from, cut.to, 0);
  Pieces pieces;
  const int count = cv::connectedComponents(rest, pieces.number, 4, CV_32S);
  pieces.pieces.resize(count);
  measure(space, pieces);
  return pieces;
}

void lookAround(const FreeSpace& space, const Pieces& pieces, std::vector<Cut>& cuts) {
  SideSight sight(space, pieces);
  for (Cut& cut : cuts) sight.look(cut);
}

}  // namespace omnimapper::building
