// The flat picture is drawn into one texture. The surface, covered with this texture, is drawn into
// a second texture, which ImGui shows.
#include "app/canvas/surface_pane.h"

#include <imgui.h>

#include "app/look/controls.h"
#include "app/panels/panels.h"
#include "core/error.h"
#include "core/mesh/flatten.h"
#include "edit/actions/icons.h"
#include "scene/formats/outline_import.h"

namespace holomorph {
namespace {

constexpr const char* kFlattenings[] = {"Free boundary", "Onto a circle"};

/// Whether the user must agree before the surface may be read.
bool is_withheld(const Workspace& workspace) {
  return workspace.document.pictures().withheld().contains(
      workspace.shown.deformation().surface->file);
}

/// Reads and flattens the surface again, fits its boundary into the outline's box, and makes the
/// fitted boundary the new outline.
void fit_to_outline(Workspace& workspace, const std::string& label, Flattening how) {
  const Deformation& deformation = workspace.shown.own();
  if (is_withheld(workspace)) return;
  SurfaceReference surface = *deformation.surface;
  surface.flattening = how;
  const auto outline = std::make_shared<Points>();
  workspace.run_in_background(
      "Flattening " + Path(surface.file).filename().string(), false,
      [outline, surface, how, onto = box_of(deformation.outline)](Job::Progress&) {
        *outline = outline_of_file(surface.file, 0, onto, how);
      },
      [&workspace, label, outline, surface] {
        set_outline(workspace, label, std::move(*outline), surface);
      });
}

/// The time of a file's last change, or a fixed value if the file is missing.
std::filesystem::file_time_type time_of(const Path& file) {
  std::error_code error;
  const auto time = std::filesystem::last_write_time(file, error);
  return error ? std::filesystem::file_time_type::min() : time;
}

}  // namespace

/// Reads the file on another thread. There is no surface until that thread has finished.
void SurfacePane::read(const Workspace& workspace) {
  const Deformation& deformation = workspace.shown.deformation();
  const bool withheld = is_withheld(workspace);
  const auto time =
      withheld ? std::filesystem::file_time_type::max() : time_of(deformation.surface->file);
  if (shown_ != deformation.surface || time != read_) {
    shown_ = deformation.surface;
    read_ = time;
    flat_.reset();
    fitted_surface_.reset();
    problem_.clear();
    fitted_ = 0;
    outline_.clear();
    if (reading_) {  // does not wait for it to end
      reading_->cancel();
      abandoned_.push_back(std::move(reading_));
    }
    read_surface_ = std::make_shared<FlattenedSurface>();
    if (withheld) {
      problem_ = shown_->file +
                 " is not in the scene's folder, so it was not read. The outline still works.";
      return;
    }
    reading_ = std::make_unique<Job>(
        "Reading a surface",
        [found = read_surface_, reference = *shown_](Job::Progress&) {
          found->surface = surface_of_obj(read_file(reference.file), reference.file).surface;
          found->plane = flattened(found->surface, reference.flattening);
        },
        wake_);
  }
  std::erase_if(abandoned_, [](const auto& job) { return job->ended(); });
  if (!reading_ || !reading_->ended()) return;
  if (const auto error = reading_->error())
    problem_ = std::string(about(shown_->file, *error).what()) + ". The outline still works.";
  else
    flat_ = std::move(*read_surface_);
  reading_.reset();
  if (flat_) drawing_->renderer.set_surface(flat_->surface);
}

void SurfacePane::follow(const Workspace& workspace) {
  read(workspace);
  const Deformation& deformation = workspace.shown.deformation();
  if (!flat_ || outline_ == deformation.outline) return;
  outline_ = deformation.outline;
  fitted_surface_.reset();
  problem_.clear();
  try {
    fitted_surface_ = aligned_with_outline(*flat_, outline_);
    box_ = Canvas::whole_pixels(box_of(fitted_surface_->plane));
    Points coordinates;
    for (const Complex& z : fitted_surface_->plane)
      coordinates.push_back(
          {(z.real() - box_.left) / box_.width(), (z.imag() - box_.bottom) / box_.height()});
    drawing_->renderer.set_coordinates(coordinates);
  } catch (const Error&) {
    problem_ = "The outline no longer matches the surface's boundary: one of them was changed.";
  }
}

void SurfacePane::draw(Workspace& workspace, Canvas& canvas, const OverlayStyle& style) {
  const Viewport& view = workspace.display.viewport;
  const float s = static_cast<float>(style.scale);
  const PanelSizes sizes = PanelSizes::now();
  const float left = static_cast<float>(view.left + view.width),
              right = ImGui::GetIO().DisplaySize.x - static_cast<float>(sizes.inspector);
  ImGui::SetNextWindowPos({left, static_cast<float>(view.top)});
  ImGui::SetNextWindowSize({right - left, static_cast<float>(view.height)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8 * s, 8 * s});
  ImGui::Begin("Surface", nullptr, kPanel | ImGuiWindowFlags_NoScrollbar);
  hovered_ = false;
  try {
    if (!drawing_) drawing_ = std::make_unique<Drawing>();
    follow(workspace);
    draw_header(workspace, s);
    if (flat_) draw_surface(workspace, canvas, style);
  } catch (const Error& error) {  // an error of the driver; the rest of the window still works
    ImGui::TextWrapped("%s", error.what());
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

void SurfacePane::draw_header(Workspace& workspace, float scale) {
  const std::string name = Path(shown_->file).filename().string();
  const float side = ImGui::GetFrameHeight(), combo = 140 * scale, gap = 8 * scale,
              right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - side;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(name.c_str());
  tooltip(shown_->file);
  // In a narrow pane, the choice of flattening is on a row of its own.
  const bool one_row = ImGui::CalcTextSize(name.c_str()).x + combo + 2 * gap < right;
  if (one_row) {
    ImGui::SameLine(right - combo - gap);
    choose_flattening(workspace, combo);
  }
  ImGui::SameLine(right);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, ImGui::GetStyle().FramePadding.y});
  if (icon_button("close", icon_named("close"), "Close this view")) run("view.surface", workspace);
  ImGui::PopStyleVar();
  tooltip("Close. View > Surface in space opens it again.");
  if (!one_row) choose_flattening(workspace, ImGui::GetContentRegionAvail().x);
  if (reading_) colored_text(theme_colors().muted, "Reading the surface...");
  if (problem_.empty()) return;
  ImGui::TextWrapped("%s", problem_.c_str());
  if (is_withheld(workspace) && button("Show it...")) workspace.request = Request::show_withheld;
  if (flat_ && button("Restore the outline"))
    fit_to_outline(workspace, "Restore outline", shown_->flattening);
}

void SurfacePane::choose_flattening(Workspace& workspace, float width) {
  if (begin_dropdown("##flattening", kFlattenings[static_cast<size_t>(shown_->flattening)],
                     width)) {
    for (const Flattening how : {Flattening::lscm, Flattening::circle})
      if (dropdown_row(kFlattenings[static_cast<size_t>(how)], how == shown_->flattening) &&
          how != shown_->flattening)
        fit_to_outline(workspace, "Flatten surface", how);
    end_dropdown();
  }
  tooltip("How to flatten the surface: with a free boundary, or onto a circle");
}

void SurfacePane::draw_surface(const Workspace& workspace, Canvas& canvas,
                               const OverlayStyle& style) {
  const ImVec2 room = ImGui::GetContentRegionAvail();
  if (room.x < 1 || room.y < 1) return;
  const double aspect = room.x / room.y;
  if (fitted_ == 0 || (fitted_ != aspect && !moved_)) {
    camera_ = OrbitCamera::around(flat_->surface, aspect);
    fitted_ = aspect;
    moved_ = false;
  }
  const Color clay{0.72f, 0.70f, 0.67f};
  if (fitted_surface_) canvas.draw_map(workspace, box_, drawing_->flat, clay);
  // Render at twice the resolution in each direction. The display averages the pixels.
  const int width = 2 * static_cast<int>(room.x), height = 2 * static_cast<int>(room.y);
  drawing_->space.bind(width, height);
  drawing_->renderer.draw(
      {width, height, camera_.to_view(), camera_.to_clip(aspect),
       fitted_surface_ && workspace.map().has_map() ? drawing_->flat.texture() : 0,
       style.colors.canvas, clay});
  drawing_->space.release();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("space", room,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  ImGui::GetWindowDrawList()->AddImage(
      reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(drawing_->space.texture())), corner,
      {corner.x + room.x, corner.y + room.y}, {0, 1}, {1, 0});
  hovered_ = ImGui::IsItemHovered() || ImGui::IsItemActive();
  navigate(room.y);
}

void SurfacePane::navigate(float height) {
  const ImGuiIO& io = ImGui::GetIO();
  const Complex delta(io.MouseDelta.x, io.MouseDelta.y);
  const OrbitCamera before = camera_;
  if (ImGui::IsItemActive()) {
    if (ImGui::IsMouseDown(0) && !io.KeyShift)
      camera_.turn_px(delta, height);
    else
      camera_.pan_px(delta, height);
  }
  if (ImGui::IsItemHovered() && io.MouseWheel != 0) camera_.zoom(std::pow(1.15, io.MouseWheel));
  moved_ = moved_ || camera_ != before;
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) fitted_ = 0;
}

}  // namespace holomorph
