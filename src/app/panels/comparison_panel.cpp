// A worker thread fills the rows. The window shows those that are ready.
#include "app/panels/comparison_panel.h"

#include "app/panels/panels.h"
#include "core/mesh/mesher.h"

namespace holomorph {
namespace {

constexpr int kVertices = 800;  ///< mesh size; some methods take seconds even at this size

void cell(const char* format, double value) {
  ImGui::TableNextColumn();
  if (std::isfinite(value))
    ImGui::Text(format, value);
  else
    ImGui::TextUnformatted("infinite");
}

}  // namespace

void ComparisonPanel::start(const Deformation& deformation) {
  worker_ = {};  // stops the previous worker and waits for it
  open_ = true;
  chosen_ = -1;
  deformation_ = deformation;
  rows_.clear();
  failure_.clear();
  computing_ = true;
  mesh_ = nullptr;
  worker_ = std::jthread(
      [this, deformation](std::stop_token stop) { work(deformation, std::move(stop)); });
}

void ComparisonPanel::work(const Deformation& deformation, std::stop_token stop) {
  std::string failure;
  try {
    Rest rest = rest_of(deformation, Precision::full);
    rest.mesh = std::make_shared<const Mesh>(domain_mesh(deformation.rest, {kVertices}));
    {
      const std::lock_guard lock(mutex_);
      mesh_ = rest.mesh;
    }
    compare(
        rest, pose_of(deformation),
        [&](const ComparedMap& row) {
          const std::lock_guard lock(mutex_);
          rows_.push_back(row);
          wake_();
        },
        stop);
  } catch (const std::exception& error) {
    failure = error.what();
  }
  const std::lock_guard lock(mutex_);
  computing_ = false;
  failure_ = std::move(failure);
  wake_();
}

void ComparisonPanel::draw(const Workspace& workspace, const OverlayStyle& style) {
  if (!open_) return;
  if (draw_window(workspace, style)) start(workspace.shown.deformation());
  if (!open_) worker_.request_stop();
}

bool ComparisonPanel::draw_window(const Workspace& workspace, const OverlayStyle& style) {
  const std::lock_guard lock(mutex_);
  const float s = static_cast<float>(style.scale);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float width = std::min(690 * s, display.x - 20);
  const double middle = workspace.display.viewport.left + workspace.display.viewport.width / 2;
  const float left =
      std::clamp(static_cast<float>(middle) - width / 2, 10.0f, display.x - width - 10);
  ImGui::SetNextWindowPos({left, display.y - 50 * s}, ImGuiCond_Appearing, {0, 1});
  ImGui::SetNextWindowSize({width, 10 * ImGui::GetTextLineHeightWithSpacing() + 24 * s},
                           ImGuiCond_Appearing);
  ImGui::Begin("Compare projections", &open_,
               ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
  draw_table(style.scale);
  if (!failure_.empty()) ImGui::TextWrapped("%s", failure_.c_str());
  ImGui::TextDisabled("%s", computing_ ? "Computing. Some methods take several seconds..."
                                       : "Click a row to see its map over the picture.");
  bool again = false;
  if (workspace.shown.deformation() != *deformation_) {
    ImGui::BeginDisabled(!method_named(workspace.shown.deformation().method).follows_others);
    again = ImGui::Button("Compare again");
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::TextDisabled("The scene has changed since.");
  }
  ImGui::End();
  draw_map(workspace, style);
  return again;
}

void ComparisonPanel::draw_table(double scale) {
  const float s = static_cast<float>(scale);
  if (!ImGui::BeginTable("rows", 7, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) return;
  ImGui::TableSetupColumn("Map", ImGuiTableColumnFlags_WidthFixed, 190 * s);
  static constexpr const char* kColumns[][2] = {
      {"Map", "Click a row to see its map over the picture"},
      {"Shear", "The largest shear: 0 keeps all angles, 1 flattens a circle to a line"},
      {"Stretch", "The largest factor by which a length grows or shrinks"},
      {"Flipped", "Number of flipped triangles"},
      {"Turns",
       "How many times the outline turns: 1 unless the picture overlaps itself at a point"},
      {"Time", "Time of the solve in milliseconds, without preparation"},
      {"Iterations", "'not settled': stopped at the iteration limit"}};
  for (int c = 1; c < 7; ++c)
    ImGui::TableSetupColumn(kColumns[c][0], ImGuiTableColumnFlags_WidthFixed,
                            (c < 6 ? 64 : 110) * s);
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  for (int c = 0; c < 7; ++c) {
    ImGui::TableNextColumn();
    ImGui::TableHeader(kColumns[c][0]);
    tooltip(kColumns[c][1]);
  }
  for (size_t i = 0; i < rows_.size(); ++i) {
    const ComparedMap& row = rows_[i];
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const bool is_chosen = chosen_ == static_cast<int>(i);
    if (ImGui::Selectable(row.label.c_str(), is_chosen, ImGuiSelectableFlags_SpanAllColumns))
      chosen_ = is_chosen ? -1 : static_cast<int>(i);
    tooltip(row.hint);
    cell("%.3f", row.max_k);
    cell("%.3f", row.max_tau);
    cell("%.0f", row.flipped_triangles);
    cell("%.2f", row.turning_number);
    if (i == 0) continue;  // the reference map needs no solve, so it has no time
    cell("%.0f", row.milliseconds);
    ImGui::TableNextColumn();
    ImGui::Text(row.settled ? "%d" : "%d, not settled", row.iterations);
  }
  ImGui::EndTable();
}

void ComparisonPanel::draw_map(const Workspace& workspace, const OverlayStyle& style) const {
  if (workspace.at_rest() || chosen_ < 0 || chosen_ >= static_cast<int>(rows_.size()) || !mesh_)
    return;
  const VectorXc& f = rows_[static_cast<size_t>(chosen_)].f;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const auto px = [&](int vertex) {
    const Complex at = workspace.display.viewport.px_at_plane(f[vertex]);
    return ImVec2(static_cast<float>(at.real()), static_cast<float>(at.imag()));
  };
  const float width = static_cast<float>(style.scale);
  for (const auto& [a, b, c] : mesh_->triangles) {
    const bool flipped = cross(f[b] - f[a], f[c] - f[a]) <= 0;
    if (flipped) list.AddTriangleFilled(px(a), px(b), px(c), style.colors.warning);
    list.AddTriangle(px(a), px(b), px(c), (style.colors.accent & 0x00ffffff) | 0x90000000, width);
  }
}

}  // namespace holomorph
