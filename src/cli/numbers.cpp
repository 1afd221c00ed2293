// The commands map, inverse, coordinates and info, which print a scene's map as numbers.
#include <cstdio>
#include <iostream>
#include <set>

#include "cli/commands.h"
#include "cli/progress.h"
#include "cli/streams.h"
#include "core/cauchy/cauchy.h"
#include "core/cauchy/inside.h"
#include "core/error.h"
#include "scene/budget.h"
#include "scene/formats/export.h"
#include "scene/loading.h"
#include "scene/report.h"
#include "system/new_file.h"

namespace holomorph {
namespace {

/// The first column of a CSV row, which contains the frame; empty if the moment has no frame.
std::string frame_column(const FrameTime& moment) {
  return moment.frame ? std::to_string(*moment.frame) + "," : "";
}

/// Counts the points inside the cage at which the map is not finite, and remembers the first.
class NonFinitePoints {
 public:
  void add(size_t point) {
    if (count_++ == 0) first_ = point;
  }
  void say() const {
    if (count_ > 0)
      std::cerr << "holomorph: " << count_
                << " of the points inside the cage gave nan because the map or its derivative is "
                   "not finite "
                   "there; the first is point "
                << first_ << "\n";
  }

 private:
  size_t count_ = 0, first_ = 0;
};

/// A line for each preimage, or only for the topmost one, that starts with `columns`. Without a
/// preimage, a line of NaN.
std::string preimage_lines(std::vector<Preimage> found, const std::string& columns, bool all) {
  const size_t count = found.size();
  if (found.empty()) found.push_back({Complex(NAN, NAN), NAN});
  if (!all) found.resize(1);
  std::string lines;
  for (const Preimage& preimage : found)
    lines += columns + csv_line("%.17g,%.17g,%.3g,%zu\n", preimage.z.real(), preimage.z.imag(),
                                preimage.residual, count);
  return lines;
}

}  // namespace

void run(const MapCommand& command) {
  check_out(command.out, command.force, {command.scene, command.points});
  const auto [scene, points] = read_scene_and_points(command, command.points);
  const std::vector<FrameTime> moments = moments_of(command.moments, scene, command.scene);
  Progress progress("map");
  ResultWriter out(command.out);
  out.write(std::string(moments[0].frame ? "frame," : "") + "u,v,fz_re,fz_im,fzbar_re,fzbar_im\n");
  TimedMap timed(scene);
  NonFinitePoints non_finite;
  std::vector<char> inside;
  const Inside cage(scene.deformation().rest);
  for (const Complex& z : points) inside.push_back(cage.contains(z));
  const size_t block = timed.block_size(), blocks = (points.size() + block - 1) / block;
  for (size_t k = 0; k < moments.size(); ++k) {
    const TimedFrame frame = timed.frame(moments[k].time);
    for (size_t b = 0; b < blocks; ++b) {
      progress.step(k * blocks + b, moments.size() * blocks);
      const size_t from = b * block, to = std::min(points.size(), from + block);
      const Points some(points.begin() + static_cast<long>(from),
                        points.begin() + static_cast<long>(to));
      SampledMap map = timed.at(frame, some);
      for (Index i = 0; i < map.f.size(); ++i) {
        if (!inside[from + static_cast<size_t>(i)])
          map.f[i] = map.fz[i] = map.fzbar[i] = Complex(NAN, NAN);
        else if (!is_finite(map.f[i]) || !is_finite(map.fz[i]) || !is_finite(map.fzbar[i]))
          non_finite.add(from + static_cast<size_t>(i));
        out.write(frame_column(moments[k]) + csv_line("%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n",
                                                      map.f[i].real(), map.f[i].imag(),
                                                      map.fz[i].real(), map.fz[i].imag(),
                                                      map.fzbar[i].real(), map.fzbar[i].imag()));
      }
    }
  }
  out.finish();
  non_finite.say();
}

void run(const InverseCommand& command) {
  check_out(command.out, command.force, {command.scene, command.points});
  const auto [scene, points] = read_scene_and_points(command, command.points, true);
  const std::vector<FrameTime> moments = moments_of(command.moments, scene, command.scene);
  Progress progress("inverse", "point");
  ResultWriter out(command.out);
  out.write(std::string(moments[0].frame ? "frame," : "") +
            (command.all ? "point,x,y,residual,count\n" : "x,y,residual,count\n"));
  TimedMap timed(scene);
  for (size_t k = 0; k < moments.size(); ++k) {
    const auto inverse = timed.inverse(timed.frame(moments[k].time));
    if (!inverse)
      throw Error(ErrorKind::bad_input,
                  "method '" + scene.deformation().method + "' has no inverse");
    constexpr size_t kBlock = 8192;  // limits the memory
    for (size_t from = 0; from < points.size(); from += kBlock) {
      const size_t all = points.size(), count = std::min(kBlock, all - from);
      const auto step = [&](size_t searched) {
        progress.step(k * all + from + std::min(searched, count), moments.size() * all);
      };
      step(0);
      const auto found = inverse->at(std::span(points).subspan(from, count), step);
      for (size_t i = 0; i < count; ++i)
        out.write(preimage_lines(
            found[i],
            frame_column(moments[k]) + (command.all ? std::to_string(from + i) + "," : ""),
            command.all));
    }
  }
  out.finish();
}

void run(const CoordinatesCommand& command) {
  check_out(command.out, command.force, {command.scene, command.points});
  const auto [scene, points] = read_scene_and_points(command, command.points);
  if (command.order > 12)
    throw Error(ErrorKind::bad_input, "--order: the order of a derivative is at most 12");
  check_budget(
      &Budget::coordinates,
      static_cast<double>(points.size()) *
          static_cast<double>(
              elevated_to(scene.deformation().rest, scene.deformation().pose).control_count()),
      "the points have");
  const Progress progress("coordinates");
  // There is one column per control point of the pose. The rest cage's degrees are raised to match.
  for (Index i = 0; i < scene.deformation().rest.size(); ++i)
    if (scene.deformation().rest.degree(i) > scene.deformation().pose.degree(i))
      throw Error(ErrorKind::bad_input, shown_name(command.scene) + ": /cage/rest/" +
                                            std::to_string(i) +
                                            ": the rest segment has a higher degree than the "
                                            "posed segment");
  write_result(command.out, npy_of(cauchy_coordinates(
                                elevated_to(scene.deformation().rest, scene.deformation().pose),
                                points, command.order)));
}

void run(const InfoCommand& command) {
  const Scene scene = read_scene(command).scene;
  std::set<std::string> pictures;
  for (const SharedLayer& layer : scene.layers)
    if (layer->image && pictures.insert(layer->image->file).second)
      print_warning(import_report(layer->image->file).text());
  require_cage(scene, command.scene);
  const std::vector<FrameTime> moments = moments_of(command.moments, scene, command.scene);
  std::vector<SceneReport> reports;
  {
    Progress progress("info", "frame");
    TimedMap timed(scene);
    for (size_t k = 0; k < moments.size(); ++k) {
      progress.step(k, moments.size());
      reports.push_back(report_of(timed, timed.frame(moments[k].time)));
      reports.back().frame = moments[k].frame;
      reports.back().time = moments[k].time;
    }
  }
  if (command.json) return write_standard_output(json_of(reports));
  for (const SceneReport& report : reports) write_standard_output(text_of(report));
}

}  // namespace holomorph
