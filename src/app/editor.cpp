// The order of a frame is described in src/README.md.
#include "app/editor.h"

#include <imgui.h>

#include <utility>

#include "app/look/items.h"
#include "edit/content.h"
#include "edit/films.h"
#include "edit/picking.h"
#include "edit/tools/layer_drag.h"

namespace holomorph {

Editor::Editor(Screen& screen, Preferences preferences, const EditorOptions& options)
    : preferences_(std::move(preferences)),
      screen_(screen),
      canvas_([this] { screen_.wake(); }),
      comparison_([this] { screen_.wake(); }),
      files_(
          workspace_, preferences_, [this] { document_replaced(); }, [this] { screen_.wake(); },
          options.allow_outside),
      keys_(workspace_, files_.chooser(), [this] {
        preferences_.keys = workspace_.actions.changed_keys();
        files_.keep_preferences();
      }) {
  workspace_.actions.use_keys(preferences_.keys);
  files_.chooser().use_native(preferences_.native_dialogs);
  tools_.push_back(select_tool());
  tools_.push_back(pen_tool());
  tools_.push_back(pin_tool());
  tools_.push_back(stroke_tool());
  tools_.push_back(outline_tool());
  tools_.push_back(angle_tool());
  tools_.push_back(brush_tool());
  tools_.push_back(attach_tool());
  workspace_.maps.on_ready([this] { screen_.wake(); });
  workspace_.run_in_background = [this](const std::string& title, bool quietly, Job::Work work,
                                        std::function<void()> then) {
    workspace_.messages.complain(
        files_.jobs().run(title, std::move(work), std::move(then), quietly));
  };
  if (!options.file.empty()) files_.ask_open(options.file);
  const auto is_other = [&](const Recovery& each) {
    return each.origin != absolute_path(options.file);
  };
  if (!options.file.empty() && std::ranges::any_of(files_.recoverable(), is_other))
    workspace_.messages.say(
        "There is unsaved work from an earlier session. Choose File > New to see it.");
}

bool Editor::step() {
  const bool playing =
      workspace_.playback.playing || workspace_.shown.timeline.playing || files_.busy();
  const bool happened = screen_.wait(playing ? 0.015 : toasts_.empty() ? 1.0 : 0.25);
  if (happened && canvas_.allocate_texture())
    screen_.wake();  // the frame is drawn in the next iteration
  else if (happened)
    frame();
  if (screen_.now_ms() - watched_ms_ > 500) {
    watched_ms_ = screen_.now_ms();
    files_.watch();
    if (!workspace_.messages.toasts.empty()) screen_.wake();
  }
  if (!happened && (playing || toasts_.expire(screen_.now_ms()))) screen_.wake();
  return !files_.has_quit();
}

void Editor::frame() {
  if (std::exchange(restyle_, false)) {
    screen_.set_style(preferences_.ui_scale, preferences_.theme, preferences_.reduce_motion);
    fit_ = true;
  }
  if (screen_.holds_escape()) {
    if (files_.jobs().quiet()) files_.jobs().cancel();
    screen_.discard_held();
  }
  screen_.hold(files_.jobs().quiet(), [this](Complex px) { return press_waits(px); });
  screen_.begin_frame(navigates_items(window_focus()));
  PanelSizes sizes = PanelSizes::now();
  if (workspace_.shown.timeline.visible) sizes.timeline = timeline_.height(workspace_, sizes);
  layout(sizes);
  handle_events();
  Input input = read_input();
  if (input.wheel != 0 && current_tool().scroll(input, workspace_)) input.wheel = 0;
  split_line_.drag(input, workspace_.display);
  navigate(input);
  use_tool(input);
  open_context_menu(input);
  answer(std::exchange(workspace_.request, Request::none));
  if (advance(workspace_.shown.timeline, workspace_.document.scene(), screen_.now_ms()))
    screen_.wake();
  show_film_frames(workspace_, [this] { screen_.wake(); });
  if (workspace_.update_map(
          {is_heat(workspace_.display.view), workspace_.shown.preview.has_value(),
           workspace_.shown.preview ? std::nullopt : workspace_.playback.iteration}))
    screen_.wake();
  if (advance(workspace_.playback, workspace_.map(), screen_.now_ms())) screen_.wake();
  if (workspace_.shown.timeline.recording) screen_.wake();
  last_picture_.update(workspace_);
  show_whole_map();
  update_title();
  files_.autosave();
  draw_canvas();
  draw_panels(input, sizes);
  menu_was_open_ = has_popup();
  screen_.end_frame();
  moving_ = take_motion();
  if (moving_ || timeline_.take_growth()) screen_.wake();
}

void Editor::layout(const PanelSizes& sizes) {
  Viewport& view = workspace_.display.viewport;
  const Viewport before = view;
  const bool was_fitted = !workspace_.document.empty() && is_same_view(view, fitted(view));
  view.left = sizes.toolbar;
  view.top = sizes.menu + sizes.options;
  const double room = screen_.width() - sizes.toolbar - sizes.inspector;
  const bool halved = workspace_.shows_surface();
  view.width = std::max(1.0, halved ? std::floor(room / 2) : room);
  if (halved != std::exchange(halved_, halved)) fit_ = true;
  const bool timed = workspace_.shown.timeline.visible && !workspace_.document.empty();
  view.height =
      std::max(1.0, screen_.height() - view.top - sizes.status - (timed ? sizes.timeline : 0));
  workspace_.display.handle_px = 10 * screen_.scale();
  // A view that shows everything still does so after the window was resized or maximized.
  const bool resized = before.width != view.width || before.height != view.height;
  if (std::exchange(fit_, false) || (resized && was_fitted && !current_tool().busy()))
    view = fitted(view);
}

Viewport Editor::fitted(Viewport view) const {
  const Box content = content_box(workspace_);
  if (!start_card_.shows(workspace_) || !StartCard::has_room(workspace_)) {
    view.fit(content);
    return view;
  }
  const double card = static_cast<double>(StartCard::width());
  Viewport part = view;
  part.width -= card;
  part.fit(content);
  view.zoom = part.zoom;
  view.center = part.center + Complex(card / 2 / part.zoom, 0);
  return view;
}

bool Editor::is_same_view(const Viewport& a, const Viewport& b) {
  constexpr double kClose = 1e-6;
  return std::abs(a.zoom - b.zoom) < kClose * a.zoom &&
         std::abs(a.center - b.center) * a.zoom < kClose;
}

void Editor::show_whole_map() {
  if (workspace_.document.history().can_undo()) opened_ = false;
  if (!opened_ || !workspace_.map().has_map() || workspace_.map().busy()) return;
  opened_ = false;
  Viewport& view = workspace_.display.viewport;
  Box seen;
  seen.include(view.plane_at_px({view.left, view.top}));
  seen.include(view.plane_at_px({view.left + view.width, view.top + view.height}));
  const Box all = content_box(workspace_);
  if (!seen.contains({all.left, all.bottom}) || !seen.contains({all.right, all.top})) view.fit(all);
}

void Editor::handle_events() {
  // While a dialog or question is open, dropped files and requests to close the window wait.
  if (!files_.asking()) {
    for (const Path& path : screen_.take_drops()) files_.drop(path);
    if (screen_.take_close()) workspace_.request = Request::quit;
  }
  // A panel's preview ends when the user no longer drags any of its items.
  const bool active = ImGui::IsAnyItemActive();
  if (workspace_.shown.preview && !current_tool().busy() && !active && !was_active_)
    workspace_.shown.preview.reset();
  was_active_ = active;
  panel_focus_.look();
  for (const auto& [key, repeats] : screen_.take_keys()) {
    const KeyFocus focus = key_focus(window_focus());  // the previous key may have changed it
    if (focus == KeyFocus::assignment && !repeats) keys_.take(key);  // a held key counts once
    if (focus == KeyFocus::panel) handle_panel_key(key);
    if (focus == KeyFocus::canvas) take_key(key);
  }
  const bool holds = key_focus(window_focus()) == KeyFocus::canvas;
  workspace_.display.hide_overlays = holds && is_held("hold.overlays");
  workspace_.display.show_original = holds && is_held("hold.original") && !current_tool().busy();
  screen_.set_alt_override(holds && is_held("hold.alt"));
}

bool Editor::has_popup() {
  return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

WindowFocus Editor::window_focus() const {
  WindowFocus focus;
  focus.assigns_key = keys_.waits_for_key();
  focus.edits_field = ImGui::GetIO().WantTextInput || ImGui::IsAnyItemActive();
  focus.palette = palette_.open();
  focus.dialog = files_.asking() || keys_.open();
  focus.menu = has_popup();
  focus.menu_was_open = menu_was_open_;
  focus.panel = panel_focus_.held();
  return focus;
}

void Editor::handle_panel_key(const Shortcut& key) {
  if (key == Shortcut(Key::escape)) return panel_focus_.leave();
  const Action* action = workspace_.actions.for_key(key, workspace_);
  if (action && acts_from_panel(key, *action)) holomorph::run(*action, workspace_);
}

bool Editor::is_held(const char* id) const {
  const ImGuiIO& io = ImGui::GetIO();
  const Modifiers held{io.KeyCtrl, io.KeyShift, io.KeyAlt && !screen_.alt_override()};
  return std::ranges::any_of(workspace_.actions.named(id).keys, [&](const Shortcut& key) {
    return screen_.is_down(key) && key.mods == held;
  });
}

void Editor::take_key(const Shortcut& key) {
  if (key == Shortcut(Key::space)) return;  // navigate() handles Space: a tap plays, a drag pans
  const bool escapes = key.key == static_cast<int>(Key::escape) && current_tool().busy();
  if ((key.mods == Modifiers{} || escapes) && key.key >= 256 &&
      current_tool().key(static_cast<Key>(key.key), workspace_))
    return;
  if (current_tool().busy()) return handle_key_in_gesture(key);
  if (const Action* action = workspace_.actions.for_key(key, workspace_))
    holomorph::run(*action, workspace_);
}

void Editor::handle_key_in_gesture(const Shortcut& key) {
  const Action* action = workspace_.actions.owner_of(key);
  if (!action) return;
  if (action->id == "edit.undo") current_tool().key(Key::backspace, workspace_);
  if (action->during_gesture) holomorph::run(*action, workspace_);
}

Input Editor::read_input() {
  const ImGuiIO& io = ImGui::GetIO();
  Input input;
  input.px = {io.MousePos.x, io.MousePos.y};
  input.mods = {io.KeyCtrl, io.KeyShift, io.KeyAlt};
  input.now_ms = screen_.now_ms();
  input.inside = !io.WantCaptureMouse && !workspace_.document.empty() &&
                 workspace_.display.viewport.contains_px(input.px);
  input.pressed = input.inside && ImGui::IsMouseClicked(0);
  input.double_clicked = input.inside && ImGui::IsMouseDoubleClicked(0);
  input.down = ImGui::IsMouseDown(0);
  input.released = ImGui::IsMouseReleased(0);
  input.wheel = input.inside ? io.MouseWheel : 0;
  input.position = workspace_.display.viewport.plane_at_px(input.px);
  return input;
}

/// Whether a press at a position waits until the map is known. Presses that are not for the tool do
/// not, as far as the last frame tells.
bool Editor::press_waits(Complex px) const {
  const ImGuiIO& io = ImGui::GetIO();
  constexpr double kSame = 0.5;  // px; ImGui rounds positions
  const bool over_panel =
      io.WantCaptureMouse && std::abs(Complex(io.MousePos.x, io.MousePos.y) - px) < kSame;
  if (over_panel || !workspace_.display.viewport.contains_px(px) || has_popup() ||
      files_.asking() || keys_.open() || palette_.open() || screen_.is_down(Key::space) ||
      is_before(workspace_.display, px))
    return false;
  Input input;
  input.px = px;
  input.inside = true;
  input.position = workspace_.layer_view().plane_at_px(px);
  return current_tool().waits(input, workspace_);
}

/// What the tool draws. Pins whose clicks still wait are there, too.
ToolOverlay Editor::gesture() {
  ToolOverlay overlay = current_tool().overlay();
  const bool first = files_.jobs().quiet();
  if (!first) overlay.coming_pins.clear();
  if (workspace_.tools.active != ToolId::pin) return overlay;
  for (const Complex& px : screen_.held_presses())
    if (first ? workspace_.display.viewport.contains_px(px) : press_waits(px))
      overlay.coming_pins.push_back(px);
  return overlay;
}

void Editor::navigate(Input& input) {
  const bool pressed = input.pressed;
  const bool space = screen_.is_down(Key::space) && !ImGui::GetIO().WantTextInput;
  const bool for_canvas = key_focus(window_focus()) == KeyFocus::canvas;
  const Navigation::Outcome outcome =
      navigation_.navigate(input, space, for_canvas, workspace_.display.viewport);
  if (outcome.tapped && !current_tool().busy())
    if (const Action* action = workspace_.actions.for_key(Key::space, workspace_))
      holomorph::run(*action, workspace_);
  if (outcome.moved || pressed) opened_ = false;
  if (pressed) panel_focus_.leave();
  input.position = workspace_.layer_view().plane_at_px(input.px);  // tools work on the layer
}

Tool& Editor::current_tool() const {
  for (const auto& tool : tools_)
    if (tool->id() == workspace_.tools.active) return *tool;
  return *tools_[0];
}

void Editor::use_tool(Input input) {
  if (last_tool_ != workspace_.tools.active) {
    for (const auto& tool : tools_)
      if (tool->id() == last_tool_) tool->cancel(workspace_);
    last_tool_ = workspace_.tools.active;
  }
  if (is_before(workspace_.display, input.px) && !current_tool().busy())
    input.pressed = input.double_clicked = input.inside = false;
  if (input.pressed && workspace_.tools.active == ToolId::select && workspace_.tools.drags_layers) {
    leave_closed_layer(workspace_, input.px);
    input.position = workspace_.layer_view().plane_at_px(input.px);
  }
  if (input.pressed && !workspace_.require_open_layer())
    input.pressed = input.double_clicked = input.inside = false;
  if (input.pressed) {
    workspace_.shown.timeline.keys.clear();     // so that Delete removes handles
    workspace_.shown.timeline.playing = false;  // a drag starts at the pose of this moment
  }
  current_tool().input(input, workspace_);
}

void Editor::open_context_menu(const Input& input) {
  if (!input.inside || !ImGui::IsMouseClicked(1)) return;
  if (const auto handle = handle_at(workspace_, input.px);
      handle && !is_before(workspace_.display, input.px) && !workspace_.selection.contains(*handle))
    workspace_.selection = {*handle};
  ImGui::OpenPopup("context");
}

void Editor::answer(Request request) {
  files_.answer(request);
  if (request == Request::help) keys_.show();
  if (request == Request::context_menu) ImGui::OpenPopup("context");
  if (request == Request::compare) comparison_.start(workspace_.shown.own());
  if (request == Request::palette) palette_.show();
  if (request == Request::menu) goes_to_menu_ = true;
  if (request == Request::rename_layer) layers_.rename(workspace_.document.scene());
  if (request == Request::next_panel) panel_focus_.next();
}

void Editor::answer(const PanelAnswer& wanted) {
  if (wanted.open) files_.ask_open(*wanted.open);
  if (wanted.sample) files_.ask_sample(*wanted.sample);
  if (wanted.recover) files_.ask_recover(*wanted.recover);
  if (wanted.discard) files_.discard(*wanted.discard);
  if (wanted.preferences_changed) {
    files_.keep_preferences();
    files_.chooser().use_native(preferences_.native_dialogs);
  }
  if (wanted.style_changed) {
    files_.keep_preferences();
    restyle_ = true;
  }
}

void Editor::document_replaced() {
  screen_.discard_held();
  for (const auto& tool : tools_) tool->cancel(workspace_);
  canvas_.forget();
  last_picture_.opened(workspace_);
  panel_focus_.leave();
  layers_.forget();
  timeline_.forget();
  fit_ = opened_ = true;
  if (!workspace_.document.empty()) samples_.pause();
}

void Editor::update_title() {
  const Document& document = workspace_.document;
  const std::string title =
      document.empty()
          ? "Holomorph"
          : document.title() + (document.modified() ? " * - Holomorph" : " - Holomorph");
  if (title != title_) screen_.set_title(title_ = title);
}

void Editor::draw_canvas() {
  const CanvasColors colors = canvas_colors();
  canvas_.draw(workspace_, {screen_.framebuffer_width(), screen_.framebuffer_height(),
                            static_cast<double>(screen_.framebuffer_width()) / screen_.width(),
                            colors.canvas, colors.page_a, colors.page_b, static_cast<double>(px(8)),
                            has_high_contrast() ? 0 : static_cast<double>(px(12)),
                            is_light() ? 0.2f : 0.4f, last_picture_.shows()});
}

void Editor::draw_panels(const Input& input, PanelSizes sizes) {
  const double scale = screen_.scale();
  const OverlayStyle style{canvas_colors(), scale};
  suppress_tooltips(palette_.open());
  const PanelAnswer menus =
      draw_menu_bar(workspace_, preferences_, thumbnails_,
                    std::exchange(goes_to_menu_, false) ? &panel_focus_ : nullptr);
  StatusLine status;
  if (workspace_.document.empty()) {
    status.hint = "Open or drop a picture, or click a sample. " +
                  workspace_.actions.key_of("help.keys") + " lists keys and mouse gestures.";
    answer(
        draw_welcome(workspace_, preferences_, samples_, files_.recoverable(), thumbnails_, sizes));
  } else {
    if (last_picture_.shows() || last_picture_.solving()) last_picture_.draw(workspace_);
    draw_overlay(workspace_, gesture(), style);
    draw_split_line(workspace_.display, style);
    if (canvas_.edited().heat_values().size() > 0)
      draw_legend(workspace_, canvas_.edited().heat_scale(), canvas_.edited().heat_values(), style);
    draw_tool_bar(workspace_, sizes);
    draw_options_bar(workspace_, sizes);
    if (workspace_.shows_surface()) surface_pane_.draw(workspace_, canvas_, style);
    draw_cards(style, sizes);
    if (workspace_.shown.timeline.visible) timeline_.draw(workspace_, thumbnails_, sizes);
    const PanelAnswer context = draw_context_menu(workspace_, preferences_, thumbnails_);
    comparison_.draw(workspace_, style);
    status = status_of(input);
    if (!context.hint.empty()) status.hint = context.hint;
    if (workspace_.shown.timeline.visible && !timeline_.hint().empty())
      status.hint = timeline_.hint();
  }
  if (!menus.hint.empty()) status.hint = menus.hint;
  answer(menus);
  draw_status_bar(workspace_, status, sizes);
  toasts_.draw(workspace_, style, screen_.now_ms());
  if (workspace_.map().error() && workspace_.map().error()->where())
    draw_marker(workspace_, *workspace_.map().error()->where(), style);
  files_.draw(thumbnails_);
  keys_.draw();
  answer(palette_.draw(workspace_, preferences_));
}

void Editor::draw_cards(const OverlayStyle& style, PanelSizes sizes) {
  const bool starts = start_card_.shows(workspace_) && !current_tool().busy();
  const bool docks = starts && !StartCard::has_room(workspace_);
  if (starts && !docks) start_card_.draw(workspace_, style);
  bool closed = false;
  first_steps_.follow(workspace_, files_.has_exported());
  float docked = 0;
  if (preferences_.hints && first_steps_.done()) closed = true;
  // The start card already suggests the first step.
  if (preferences_.hints && !starts && !closed && !first_steps_.draw(workspace_, closed))
    docked = first_steps_.draw_docked(workspace_, static_cast<float>(sizes.inspector),
                                      static_cast<float>(screen_.height() - sizes.status), closed);
  if (closed) {
    preferences_.hints = false;
    files_.keep_preferences();
  }
  const InspectorParts parts{layers_,
                             thumbnails_,
                             preferences_,
                             canvas_.edited().heat_scale(),
                             docks ? &start_card_ : nullptr,
                             style};
  sizes.status += static_cast<double>(docked);
  answer(draw_inspector(workspace_, parts, sizes));
  draw_missing_picture(workspace_);
}

StatusLine Editor::status_of(const Input& input) {
  StatusLine status;
  status.hint = current_tool().hint(workspace_);
  if (screen_.holds())
    status.hint = (files_.jobs().quiet() ? files_.jobs().title() : "Finding the map") +
                  ". What you do waits for it; Esc cancels";
  if (workspace_.shows_surface() && surface_pane_.hovered()) status.hint = SurfacePane::hint();
  if (panel_focus_.held())
    status.hint = "Press Esc for the canvas; use arrow keys, Tab and Enter in this panel; press " +
                  workspace_.actions.key_of("view.next_panel") + " for the next panel";
  if (workspace_.shown.timeline.recording) status.hint = recording_hint(workspace_.shown.timeline);
  if (input.inside) status.cursor = input.position;
  if (input.inside && !workspace_.at_rest())
    status.cursor_at_rest = rest_at(workspace_, input.position);
  status.draft = workspace_.shown.preview.has_value() || workspace_.map().busy() ||
                 workspace_.map().error().has_value();
  return status;
}

}  // namespace holomorph
