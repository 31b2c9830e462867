#include <map>

#include "ImportArguments.h"

using namespace omnimapper;

namespace {

using source::CarmenOdometry;

const std::map<std::string, CarmenOdometry> kOdometryNames = {
    {"automatic", CarmenOdometry::automatic}, {"lines", CarmenOdometry::lines}, {"scans", CarmenOdometry::scans}};

CLI::App* addCarmen(CLI::App& app, Arguments& arguments) {
  auto* carmen = app.add_subcommand("carmen", "CARMEN log: scans (FLASER, RLASER, ROBOTLASER1, 2) and odometry");
  carmen->add_option("IN", arguments.input, "CARMEN log; may be compressed (.gz, .bz2)")->required();
  carmen->add_option("OUT", arguments.output, "rawlog to write")->required();
  carmen
      ->add_option("--odometry", arguments.odometry,
                   "source of the odometry: automatic means lines if no stamp of the log runs backwards, else scans")
      ->check(CLI::IsMember(kOdometryNames))
      ->capture_default_str()
      ->type_name("NAME");
  return carmen;
}

CLI::App* addTum(CLI::App& app, Arguments& arguments) {
  auto* tum = app.add_subcommand("tum", "folder of depth and colour images: TUM RGB-D, ICL-NUIM, 7-Scenes");
  tum->add_option("DIR", arguments.input, "folder")->required();
  tum->add_option("OUT", arguments.output,
                  "rawlog to write; the ground truth is written beside it: out.rawlog, out.truth.tum")
      ->required();
  tum->add_option("--intrinsics", arguments.rgbd.intrinsics,
                  "freiburg1, freiburg2, freiburg3, icl_nuim, 7_scenes, openni, or a file with fx, fy, cx, cy and the "
                  "lens (k1, k2, p1, p2, k3); default: chosen by the name of the folder");
  tum->add_option("--tolerance", arguments.rgbd.largest_difference,
                  "largest difference between the stamps of depth and colour [s]")
      ->capture_default_str()
      ->check(omnimapper::program::notNegative());
  tum->add_option(
         "--depth-units", arguments.rgbd.depth_units,
         "units of a depth image per metre; 0: 1000 for 7-Scenes and if the colour images are in image/, else 5000")
      ->capture_default_str()
      ->check(omnimapper::program::notNegative());
  tum->add_option("--rate", arguments.rgbd.rate, "rate of images without stamps [1/s]")
      ->check(omnimapper::program::positive())
      ->capture_default_str();
  tum->add_option("--label", arguments.rgbd.label, "sensor label")->capture_default_str();
  tum->add_option("--images", arguments.images, "embedded: images are in the rawlog; external: in files beside it")
      ->check(CLI::IsMember({"embedded", "external"}))
      ->capture_default_str();
  tum->add_flag("--poses", arguments.poses,
                "also write the true poses into the rawlog, as observations that a map can use");
  return tum;
}

// Adds the options for a folder of files with one observation each.
template <class Options>
CLI::App* addFolder(CLI::App& app, const std::string& name, const std::string& what, Arguments& arguments,
                    Options& options) {
  auto* folder = app.add_subcommand(name, what);
  folder->add_option("DIR", arguments.input, "folder")->required();
  folder->add_option("OUT", arguments.output, "rawlog to write")->required();
  folder->add_option("--rate", options.rate, "rate of files whose names are no Unix times [1/s]")
      ->check(omnimapper::program::positive())
      ->capture_default_str();
  folder->add_option("--label", options.label, "sensor label")->capture_default_str();
  return folder;
}

}  // namespace

std::function<base::ExitCode()> addKinds(CLI::App& app, Arguments& arguments) {
  const auto* carmen = addCarmen(app, arguments);
  const auto* tum = addTum(app, arguments);
  const auto* pcd =
      addFolder(app, "pcd", "folder of PCD files: organized clouds become depth images, others remain clouds",
                arguments, arguments.pcd);
  addFolder(app, "images", "folder of JPEG or PNG images of one camera", arguments, arguments.photographs)
      ->add_option("--focal-px", arguments.photographs.focal_px,
                   "focal length [pixels]; 0: the width of an image, which is a view of 53 deg")
      ->check(program::notNegative());
  return [&arguments, carmen, tum, pcd] {
    const std::string &input = arguments.input, &output = arguments.output;
    if (carmen->parsed()) return importCarmen(input, output, kOdometryNames.at(arguments.odometry));
    if (tum->parsed())
      return importRgbd(input, output, arguments.rgbd, arguments.images == "external", arguments.poses);
    if (pcd->parsed()) return importPcd(input, output, arguments.pcd);
    return importImages(input, output, arguments.photographs);
  };
}
