// The table of all methods.
#include <algorithm>

#include "core/error.h"
#include "core/maps/deformer.h"
#include "core/maps/method.h"
#include "core/methods/check_rest.h"
#include "core/methods/rows.h"
#include "core/parallel.h"

namespace holomorph {

const std::vector<Method>& methods() {
  static const std::vector<Method> table = [] {
    std::vector<Method> rows{cage_method(),     pins_method(),     arap_method(),
                             har_arap_method(), outline_method(),  strokes_method(),
                             angles_method(),   harmonic_method(), mean_value_method()};
    rows.push_back(bounded_method(rows, "pins"));
    rows.push_back(puppet_method());
    rows.push_back(sheet_method());
    return rows;
  }();
  return table;
}

const Method& method_named(const std::string& id) {
  std::string known;
  for (const Method& method : methods()) {
    if (method.id == id) return method;
    known += (known.empty() ? "" : ", ") + method.id;
  }
  throw Error(ErrorKind::bad_input,
              "method '" + id + "' is not available in this version; choose one of: " + known);
}

const Method& usual_method(MethodUse use) {
  switch (use) {
    case MethodUse::puppet:
      return method_named("sheet");
    case MethodUse::pins:
      return method_named("pins");
    case MethodUse::strokes:
      return method_named("strokes");
    case MethodUse::outline:
      return method_named("outline");
    case MethodUse::corners:
      return method_named("angles");
    case MethodUse::stiffness:
      return method_named("arap");
    case MethodUse::bounds:
      return method_named("bounded");
    case MethodUse::cage:
      break;
  }
  return method_named("cage");
}

const Method& followed_method(const Method& method, const Parameters& values) {
  return method.follows_others ? method_named(choice(method, values, "reference")) : method;
}

std::unique_ptr<Deformer> Method::prepare(const Rest& rest, const Deformer* previous) const {
  check_rest(*this, rest);
  return make(rest, previous);
}

std::vector<PointMap::Value> values_on_all_cores(const PointMap& map,
                                                 std::span<const Complex> points,
                                                 const std::function<void()>& keep_going) {
  constexpr size_t kBlock = 256;
  const int blocks = static_cast<int>((points.size() + kBlock - 1) / kBlock);
  std::vector<PointMap::Value> values(points.size());
  const auto evaluate = [&](int block) {
    const size_t first = static_cast<size_t>(block) * kBlock;
    const auto some = map.values_at(points.subspan(first, std::min(kBlock, points.size() - first)));
    std::ranges::copy(some, values.begin() + static_cast<long>(first));
  };
  parallel_for(blocks, evaluate, [&](int) { keep_going(); });
  return values;
}

std::vector<PointMap::Value> PointMap::values_at(std::span<const Complex> points) const {
  std::vector<Value> values;
  values.reserve(points.size());
  for (const Complex& z : points) values.push_back(at(z));
  return values;
}

Rest used_by(const Method& method, Rest rest) {
  if (!method.uses_pins) rest.pins.clear();
  if (!method.uses_strokes) rest.strokes.clear();
  if (!method.uses_outline) rest.outline.clear();
  if (!method.uses_corners) rest.corners.clear();
  if (!method.uses_stiffness) rest.stiffness.clear();
  if (!method.uses_frame) rest.frame = Frame::free, rest.held_beyond.reset();
  const bool holds_disks = followed_method(method, rest.parameters).holds_disks;
  for (RestPin& pin : rest.pins)
    if (!holds_disks || !pin.has_frame) pin.radius.reset();
  if (!method.follows_others) rest.other_parameters.clear();
  return rest;
}

Pose used_by(const Method& method, Pose pose) {
  if (!method.uses_pins) pose.pins.clear();
  if (!method.uses_strokes) pose.strokes.clear();
  if (!method.uses_corners) pose.corners.clear();
  return pose;
}

Parameters parameters_of(const Rest& rest, const Method& followed) {
  const auto found = rest.other_parameters.find(followed.id);
  return found == rest.other_parameters.end() ? Parameters{} : found->second;
}

double parameter(const Method& method, const Parameters& values, const std::string& key) {
  if (const auto found = values.find(key); found != values.end()) return found->second;
  for (const ParameterSpec& spec : method.parameters)
    if (spec.key == key) return spec.fallback;
  check(false, "a method asks only for parameters in its row");
  return 0;
}

bool is_used(const Method& method, const Parameters& values, const ParameterSpec& spec) {
  return !spec.used_when || parameter(method, values, spec.used_when->key) == spec.used_when->value;
}

std::string choice(const Method& method, const Parameters& values, const std::string& key) {
  for (const ParameterSpec& spec : method.parameters)
    if (spec.key == key)
      return spec.options[static_cast<size_t>(parameter(method, values, key))].id;
  check(false, "a method asks only for choices in its row");
  return "";
}

}  // namespace holomorph
