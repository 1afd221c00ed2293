#include "bench/report.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <thread>

#include "core/error.h"
#include "scene/formats/json_tree.h"

#ifndef HOLOMORPH_COMMIT
#define HOLOMORPH_COMMIT "unknown"
#endif

namespace holomorph::bench {
namespace {

/// A text as a JSON string. Names, units and processors contain no control characters.
std::string quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name"))
      if (const size_t colon = line.find(": "); colon != std::string::npos)
        return line.substr(colon + 2);
  return "unknown";
}

/// The member of an object with this key, if there is one.
std::optional<JsonTree::Value> member(const JsonTree::Value& object, std::string_view key) {
  if (object.kind() != JsonTree::Kind::object) return {};
  for (size_t i = object.size(); i-- > 0;)
    if (object.key(i) == key) return object.member(i);
  return {};
}

}  // namespace

Machine this_machine() {
  Machine machine{processor_name(), HOLOMORPH_COMMIT,
                  static_cast<int>(std::thread::hardware_concurrency()), 0};
  double load[1];
  if (getloadavg(load, 1) == 1) machine.load = load[0];
  return machine;
}

std::string line_of(const Row& row) {
  return row.name +
         (row.goal ? "  (goal " + number(*row.goal) + (row.unit.empty() ? "" : " ") + row.unit + ")"
                   : "");
}

std::string line_of(const Result& result) {
  const Row& row = result.row;
  char text[200];
  std::snprintf(text, sizeof text, "%-86s %9.3f %s", row.name.c_str(), result.median,
                row.unit.c_str());
  std::string line = text;
  if (row.goal) {
    std::snprintf(text, sizeof text, "  (goal %g%s)", *row.goal,
                  result.median <= *row.goal ? "" : ", missed");
    line += text;
  }
  if (!result.detail.empty()) line += "  " + result.detail;
  return line;
}

std::string json_head(const Machine& machine) {
  return "{\n  \"machine\": {\"processor\": " + quoted(machine.processor) +
         ", \"cores\": " + std::to_string(machine.cores) + ", \"load\": " + number(machine.load) +
         "},\n  \"commit\": " + quoted(machine.commit) + ",\n  \"rows\": [";
}

std::string json_row(const Result& result, bool is_first) {
  const Row& row = result.row;
  return std::string(is_first ? "\n" : ",\n") + "    {\"name\": " + quoted(row.name) +
         ", \"unit\": " + quoted(row.unit) + ", \"median\": " + number(result.median) +
         ", \"goal\": " + (row.goal ? number(*row.goal) : "null") +
         ", \"runs\": " + std::to_string(result.runs) + ", \"detail\": " + quoted(result.detail) +
         "}";
}

Medians medians_of(const std::string& text, const std::string& name) {
  constexpr int kDeepest = 8;
  const JsonTree tree(text, kDeepest);
  const auto rows = member(tree.root(), "rows");
  if (!rows || rows->kind() != JsonTree::Kind::list)
    throw Error(ErrorKind::bad_input,
                name + " has no benchmarks; write such a file with holomorph bench --json");
  Medians medians;
  for (size_t i = 0; i < rows->size(); ++i) {
    const auto row = member(rows->item(i), "name"), median = member(rows->item(i), "median");
    if (row && row->kind() == JsonTree::Kind::text && median && median->is_number())
      medians[std::string(row->text())] = median->number();
  }
  return medians;
}

std::string change_since(const Medians& before, const Result& result) {
  const auto was = before.find(result.row.name);
  if (was == before.end()) return "";
  char text[120];
  if (was->second > 0)
    std::snprintf(text, sizeof text, "  (was %.6g, now %.2f times as much)", was->second,
                  result.median / was->second);
  else
    std::snprintf(text, sizeof text, "  (was %.6g)", was->second);
  return text;
}

}  // namespace holomorph::bench
