// A worker thread fills the rows. The window shows those that are ready.
#include "app/panels/comparison_panel.h"

#include "app/look/controls.h"
#include "app/look/surfaces.h"
#include "app/panels/panels.h"
#include "core/compared/isometric_comparison.h"
#include "core/mesh/mesher.h"
#include "edit/actions/groups.h"
#include "edit/actions/icons.h"

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
    const auto add = [&](const ComparedMap& row) {
      const std::lock_guard lock(mutex_);
      rows_.push_back(row);
      wake_();
    };
    if (method_named(deformation.method).follows_others)
      compare(rest, pose_of(deformation), add, stop);
    else
      compare_isometric(rest, pose_of(deformation), add, stop);
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
  const float width = std::min(770 * s, display.x - 20);
  const double middle = workspace.display.viewport.left + workspace.display.viewport.width / 2;
  const float left =
      std::clamp(static_cast<float>(middle) - width / 2, 10.0f, display.x - width - 10);
  ImGui::SetNextWindowSize({width, 0});
  begin_floating("Compare methods", {left, display.y - 50 * s}, {0, 1});
  const ImVec2 at = ImGui::GetCursorPos();
  {
    const ScopedFont title(Type::title);
    ImGui::TextUnformatted("Compare methods");
  }
  ImGui::SameLine(ImGui::GetContentRegionAvail().x - px(20));
  if (icon_button("Close comparison", icon_named("close"), "Close", false, px(28))) open_ = false;
  ImGui::SetCursorPos({at.x, at.y + px(40)});
  draw_table(style.scale);
  if (!failure_.empty()) wrapped_text(failure_);
  caption(computing_ ? "Computing. Some methods take several seconds..."
                     : "Click a row to see its map over the picture. The figures are those of a "
                       "coarse mesh.");
  bool again = false;
  if (workspace.shown.deformation() != *deformation_) {
    ImGui::BeginDisabled(!can_be_compared(workspace.shown.deformation()));
    again = button("Compare again");
    ImGui::EndDisabled();
    ImGui::SameLine();
    colored_text(theme_colors().muted, "The scene has changed since.");
  }
  end_card();
  draw_map(workspace, style);
  return again;
}

void ComparisonPanel::draw_table(double scale) {
  const float s = static_cast<float>(scale);
  // Projections start with the map that they follow. It needs no solve, so it has no time.
  const bool pinned = !rows_.empty() && rows_[0].energy;
  const int columns = pinned ? 8 : 7;
  if (!ImGui::BeginTable("rows", columns, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit))
    return;
  ImGui::TableSetupColumn("Map", ImGuiTableColumnFlags_WidthFixed, 190 * s);
  const char* const kColumns[][2] = {
      {"Map", "Click a row to see its map over the picture"},
      {"Shear", "The largest shear: 0 keeps all angles, 1 flattens a circle to a line"},
      {"Stretch", "The largest factor by which a length grows or shrinks"},
      {"Flipped", "Number of flipped triangles"},
      {pinned ? "Energy" : "Turns",
       pinned
           ? "Half the sum of squared stretches and of their inverses, on average: 2 if rigid"
           : "How many times the outline turns: 1 unless the picture overlaps itself at a point"},
      {"Time", "Time of the solve in milliseconds, without preparation"},
      {"Iterations", "'not settled': stopped at the iteration limit"},
      {"Pins", "The largest distance of a pin from its target, in pixels"}};
  for (int c = 1; c < columns; ++c)
    ImGui::TableSetupColumn(kColumns[c][0], ImGuiTableColumnFlags_WidthFixed,
                            (c == 6 ? 110 : 64) * s);
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  for (int c = 0; c < columns; ++c) {
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
    cell(pinned ? "%.3f" : "%.2f", pinned ? row.energy.value_or(0) : row.turning_number);
    if (i == 0 && !pinned) continue;
    cell("%.0f", row.milliseconds);
    ImGui::TableNextColumn();
    ImGui::Text(row.settled ? "%d" : "%d, not settled", row.iterations);
    if (pinned) cell("%.2f", row.miss);
  }
  ImGui::EndTable();
}

void ComparisonPanel::draw_map(const Workspace& workspace, const OverlayStyle& style) const {
  if (workspace.at_rest() || chosen_ < 0 || chosen_ >= static_cast<int>(rows_.size()) || !mesh_)
    return;
  const VectorXc& f = rows_[static_cast<size_t>(chosen_)].f;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const auto px = [&](int vertex) {
    const Complex at = workspace.layer_view().px_at_plane(f[vertex]);
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
