#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/PosterMaking.h>
#include <omnimapper/sim_world/Scene.h>
#include <omnimapper/sim_world/SignMaking.h>

namespace sign_making_test {
namespace {

using namespace omnimapper;
using Eigen::Vector3d;
using sim::SignStyle;

// The sign is on a wall that faces -y of the map, at eye height: x of the sign is x of the map, y is z, and z is -y.
geometry::Se3 onWall() {
  Eigen::Matrix3d axes;
  axes.col(0) = Vector3d::UnitX(), axes.col(1) = Vector3d::UnitZ(), axes.col(2) = -Vector3d::UnitY();
  return {Eigen::Quaterniond(axes), {4, 2, 1.6}};
}

sim::SignSpec spec(std::vector<std::string> lines, SignStyle style) {
  sim::SignSpec spec;
  spec.name = "sign";
  spec.lines = std::move(lines);
  spec.room = "office";
  spec.style = style;
  spec.map_from_sign = onWall();
  return spec;
}

// The brightness that a reader sees at a place in the sign's frame, by a ray from half a metre before it.
class Reader {
 public:
  explicit Reader(const sim::MadeSign& made) : sign_(made.sign), world_{}, scenes_((addTo(world_, made), world_)) {}
  float brightness(double x, double y) const {
    const Vector3d eye = sign_.map_from_sign * Vector3d(x, y, 0.5);
    const sim::Hit hit = scenes_.at(0).cast({eye, sign_.map_from_sign.rotation * -Vector3d::UnitZ()});
    if (!hit.isHit() || hit.surface != 0) return -1;
    return scenes_.material(0).texture->at(hit.texture_at.x(), hit.texture_at.y()).mean();
  }
  bool isWithin(double x, double y) const { return brightness(x, y) >= 0; }

 private:
  static void addTo(sim::World& world, const sim::MadeSign& made) {
    world.bodies.push_back(made.body);
    world.signs.push_back(made.sign);
    sim::validate(world);
  }
  sim::Sign sign_;
  sim::World world_;
  sim::Scenes scenes_;
};

TEST(SignMaking, theFrontIsAPlanarSurfaceOfTheSignsSizeInItsMiddle) {
  for (const SignStyle style : {SignStyle::dark, SignStyle::white, SignStyle::exit}) {
    const sim::MadeSign made = sim::makeSign(spec({"118", "Dr. Smith"}, style));
    EXPECT_EQ(made.body.name, made.sign.name);
    EXPECT_EQ(made.body.surfaces[0].name, "sign");
    EXPECT_EQ(made.body.surfaces[0].kind, sim::SurfaceKind::sign);
    ASSERT_TRUE(made.body.surfaces[0].face);
    EXPECT_TRUE(made.body.surfaces[0].face->plane_in_body.normal.isApprox(Vector3d::UnitZ()));
    EXPECT_NEAR(made.body.surfaces[0].face->plane_in_body.distance, 0, 1e-12);
    const Reader reader(made);
    const double x = made.sign.width / 2 - 1e-3, y = made.sign.height / 2 - 1e-3;
    EXPECT_TRUE(reader.isWithin(x, y) && reader.isWithin(-x, -y));
    EXPECT_FALSE(reader.isWithin(x + 2e-3, 0) || reader.isWithin(0, -y - 2e-3));
    const Eigen::Matrix3d axes = made.sign.map_from_sign.rotation.toRotationMatrix();
    EXPECT_NEAR(axes.determinant(), 1, 1e-12);
  }
}

// The letter L: its stem is on the left, its foot goes to the right and is below.
TEST(SignMaking, textIsUprightForTheReader) {
  for (const SignStyle style : {SignStyle::dark, SignStyle::white}) {
    const sim::MadeSign made = sim::makeSign(spec({"L"}, style));
    const Reader reader(made);
    const bool dark = style == SignStyle::dark;
    std::vector<Eigen::Vector2d> ink;
    // Within the border, and left of the arrow.
    for (double x = -made.sign.width / 2 + 0.01; x < made.sign.width / 4; x += 0.001) {
      for (double y = -made.sign.height / 2 + 0.01; y < made.sign.height / 2 - 0.01; y += 0.001) {
        const float light = reader.brightness(x, y);
        if (dark ? light > 0.7 : light < 0.3) ink.emplace_back(x, y);
      }
    }
    ASSERT_GT(ink.size(), 100u);
    double low = 1, high = -1;
    for (const auto& p : ink) low = std::min(low, p.y()), high = std::max(high, p.y());
    double upper_right = -1, lower_right = -1;
    for (const auto& p : ink) {
      if (p.y() > high - 0.5 * (high - low)) upper_right = std::max(upper_right, p.x());
      if (p.y() < low + 0.1 * (high - low)) lower_right = std::max(lower_right, p.x());
    }
    EXPECT_GT(lower_right, upper_right + 0.25 * (high - low));
  }
}

TEST(SignMaking, numberIsInTheUpperLeftOfAWhiteSign) {
  const Reader reader(sim::makeSign(spec({"118"}, SignStyle::white)));
  const auto darkest = [&](double from) {
    float least = 1;
    for (double x = from; x < from + 0.04; x += 0.0007) least = std::min(least, reader.brightness(x, 0.02));
    return least;
  };
  EXPECT_LT(darkest(-0.1), 0.2);
  EXPECT_GT(darkest(0.05), 0.8);
}

TEST(SignMaking, textContrastsAndCanBeRead) {
  for (const SignStyle style : {SignStyle::dark, SignStyle::white}) {
    const auto made = sim::makeSign(spec({"Conference Room 4", "please knock", "Mon - Fri"}, style));
    const sim::Texture& picture = *made.body.surfaces[0].material.texture;
    int dark = 0, light = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
      dark += picture.rgb[i] < 60;
      light += picture.rgb[i] > 200;
    }
    const double all = static_cast<double>(picture.rgb.size()) / 3;
    EXPECT_GT(dark / all, 0.04);
    EXPECT_GT(light / all, 0.04);
    EXPECT_NEAR(picture.width / made.sign.width, 2000, 1e-6);
    EXPECT_LE(made.sign.width, 0.31);
  }
}

// 84, 60 and 150 pixels at 2000 a metre; a name of 24 letters does not fit 30 cm at 34 pixels.
TEST(SignMaking, tellsTheHeightOfTheCapitalsOfEachLine) {
  EXPECT_EQ(sim::makeSign(spec({"118", "Dr. Smith"}, SignStyle::dark)).sign.capitals,
            (std::vector<double>{0.042, 0.017}));
  EXPECT_EQ(sim::makeSign(spec({"118", "Dr. Smith"}, SignStyle::white)).sign.capitals,
            (std::vector<double>{0.03, 0.015}));
  EXPECT_EQ(sim::makeSign(spec({"EXIT"}, SignStyle::exit)).sign.capitals, std::vector<double>{0.075});
  const auto narrow = sim::makeSign(spec({"118", "Department of Cybernetics"}, SignStyle::dark)).sign.capitals;
  EXPECT_EQ(narrow[0], 0.042);
  EXPECT_LT(narrow[1], 0.017);
  EXPECT_GE(narrow[1], 0.012);
}

TEST(SignMaking, anExitSignIsGreenWithWhiteCapitals) {
  const auto made = sim::makeSign(spec({"EXIT"}, SignStyle::exit));
  const sim::Texture& picture = *made.body.surfaces[0].material.texture;
  int green = 0, white = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    green += picture.rgb[i] < 60 && picture.rgb[i + 1] > 60 && picture.rgb[i + 2] < picture.rgb[i + 1];
    white += picture.rgb[i] > 200 && picture.rgb[i + 2] > 200;
  }
  const double all = static_cast<double>(picture.rgb.size()) / 3;
  EXPECT_GT(green / all, 0.6);
  EXPECT_GT(white / all, 0.1);
}

TEST(SignMaking, asksForASizeThatHoldsItsText) {
  auto wanted = spec({"118", "Dr. Smith"}, SignStyle::dark);
  wanted.width = 0.25;
  wanted.height = 0.18;
  const auto made = sim::makeSign(wanted);
  EXPECT_DOUBLE_EQ(made.sign.width, 0.25);
  EXPECT_DOUBLE_EQ(made.sign.height, 0.18);
  wanted.lines[1] = "Department of Mechanical Engineering";
  EXPECT_THROW(sim::makeSign(wanted), base::Error);
  wanted.lines = {"118", "a", "b", "c", "d"};
  EXPECT_THROW(sim::makeSign(wanted), base::Error);
  EXPECT_THROW(sim::makeSign(spec({}, SignStyle::white)), base::Error);
}

TEST(PosterMaking, kindsAndSeedsDiffer) {
  for (int kind = 0; kind < 5; ++kind) {
    sim::PosterSpec wanted;
    wanted.name = "poster";
    wanted.kind = static_cast<sim::PosterKind>(kind);
    const sim::Body body = sim::makePoster(wanted), again = sim::makePoster(wanted);
    EXPECT_EQ(body.surfaces[0].kind, sim::SurfaceKind::poster);
    EXPECT_EQ(body.surfaces[0].material.texture->rgb, again.surfaces[0].material.texture->rgb);
    EXPECT_LE(std::max(body.surfaces[0].material.texture->width, body.surfaces[0].material.texture->height), 512);
    wanted.seed = 1;
    if (wanted.kind != sim::PosterKind::extinguisher) {
      EXPECT_NE(body.surfaces[0].material.texture->rgb, sim::makePoster(wanted).surfaces[0].material.texture->rgb);
    }
    wanted.width = 0.4, wanted.height = 0.3;
    const std::vector<Vector3d> outline = sim::makePoster(wanted).surfaces[0].face->outline_in_body;
    EXPECT_TRUE(outline[2].isApprox(Vector3d(0.2, 0.15, 0)));
  }
}

}  // namespace
}  // namespace sign_making_test
