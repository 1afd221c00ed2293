// Runs each frame, from mouse input to pixels, in the order described in src/README.md.
#include "app/editor.h"

#include <imgui.h>

#include <utility>

#include "app/canvas/canvas.h"
#include "app/canvas/navigation.h"
#include "app/canvas/split_line.h"
#include "app/canvas/surface_pane.h"
#include "app/dialogs/keys_window.h"
#include "app/dialogs/palette.h"
#include "app/files.h"
#include "app/last_picture_view.h"
#include "app/look/items.h"
#include "app/panels/comparison_panel.h"
#include "app/panels/first_steps.h"
#include "app/panels/panel_focus.h"
#include "app/panels/panels.h"
#include "app/panels/start_card.h"
#include "app/panels/timeline_panel.h"
#include "app/panels/toasts.h"
#include "app/state_file.h"
#include "core/clock.h"
#include "core/error.h"
#include "edit/content.h"
#include "edit/films.h"
#include "edit/key_focus.h"
#include "edit/picking.h"
#include "edit/tools/layer_drag.h"

namespace holomorph {
namespace {

class Editor {
 public:
  explicit Editor(const EditorOptions& options)
      : preferences_(load_preferences()),
        window_(1280, 800, preferences_.ui_scale, preferences_.theme, preferences_.reduce_motion),
        canvas_([this] { window_.wake(); }),
        comparison_([this] { window_.wake(); }),
        files_(
            workspace_, preferences_, [this] { document_replaced(); }, [this] { window_.wake(); },
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
    workspace_.maps.on_ready([this] { window_.wake(); });
    workspace_.run_in_background = [this](const std::string& title, Job::Work work,
                                          std::function<void()> then) {
      workspace_.messages.complain(files_.jobs().run(title, std::move(work), std::move(then)));
    };
    if (!options.state_file.empty()) state_file_.emplace(options.state_file);
    if (!options.file.empty()) files_.ask_open(options.file);
    const auto is_other = [&](const Recovery& each) {
      return each.origin != absolute_path(options.file);
    };
    if (!options.file.empty() && std::ranges::any_of(files_.recoverable(), is_other))
      workspace_.messages.say(
          "There is unsaved work from an earlier session. Choose File > New to see it.");
  }

  int run() {
    while (!files_.has_quit()) {
      const bool playing =
          workspace_.playback.playing || workspace_.shown.timeline.playing || files_.busy();
      const bool happened = window_.wait(playing ? 0.015 : toasts_.empty() ? 1.0 : 0.25);
      const double start = now_ms();
      if (happened && canvas_.allocate_texture())
        window_.wake();  // the frame is drawn in the next iteration
      else if (happened)
        frame();
      slowest_ms_ = std::max(slowest_ms_, now_ms() - start);
      if (now_ms() - watched_ms_ > 500) {
        watched_ms_ = now_ms();
        files_.watch();
        if (!workspace_.messages.toasts.empty()) window_.wake();
      }
      if (!happened && (playing || toasts_.expire())) window_.wake();
    }
    return 0;
  }

 private:
  void frame() {
    if (std::exchange(restyle_, false)) {
      window_.set_style(preferences_.ui_scale, preferences_.theme, preferences_.reduce_motion);
      fit_ = true;
    }
    window_.begin_frame(navigates_items(window_focus()));
    PanelSizes sizes = PanelSizes::now();
    if (workspace_.shown.timeline.visible) sizes.timeline = timeline_.height(workspace_, sizes);
    layout(sizes);
    const double start = now_ms();
    handle_events();
    Input input = read_input();
    if (input.pressed) slowest_work_ms_ = 0;
    if (input.wheel != 0 && current_tool().scroll(input, workspace_)) input.wheel = 0;
    split_line_.drag(input, workspace_.display);
    navigate(input);
    use_tool(input);
    open_context_menu(input);
    answer(std::exchange(workspace_.request, Request::none));
    if (advance(workspace_.shown.timeline, workspace_.document.scene(), now_ms())) window_.wake();
    show_film_frames(workspace_, [this] { window_.wake(); });
    if (workspace_.update_map(
            {is_heat(workspace_.display.view), workspace_.shown.preview.has_value(),
             workspace_.shown.preview ? std::nullopt : workspace_.playback.iteration}))
      window_.wake();
    if (advance(workspace_.playback, workspace_.map(), now_ms())) window_.wake();
    if (workspace_.shown.timeline.recording) window_.wake();
    last_picture_.update(workspace_);
    show_whole_map();
    update_title();
    files_.autosave();
    slowest_work_ms_ = std::max(slowest_work_ms_, now_ms() - start);
    draw_canvas();
    draw_panels(input, sizes);
    menu_was_open_ = has_popup();
    ImGui::Render();
    window_.end_frame();
    moving_ = take_motion();
    if (moving_ || timeline_.take_growth()) window_.wake();
    if (state_file_) write_state();
  }

  void write_state() {
    PartsState parts{current_tool().busy(), comparison_.rows()};
    parts.on_surface = workspace_.shows_surface() && surface_pane_.has_picture();
    parts.yaw = surface_pane_.camera().yaw;
    parts.exporting = files_.busy();
    parts.settling = fit_;
    parts.pending = window_.has_events();
    parts.taken = window_.taken();
    parts.pointer = {ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y};
    parts.asking = (files_.asking() && !files_.busy()) || palette_.open() || keys_.open();
    parts.question = files_.question();
    parts.in_panel = panel_focus_.held();
    parts.moving = moving_;
    parts.solving = last_picture_.solving();
    parts.last_picture = last_picture_.shows();
    parts.theme = window_.theme();
    parts.scale = window_.scale();
    parts.slowest_ms = slowest_ms_;
    parts.slowest_work_ms = slowest_work_ms_;
    parts.distance = surface_pane_.camera().distance;
    state_file_->write(workspace_, parts);
  }

  void layout(const PanelSizes& sizes) {
    Viewport& view = workspace_.display.viewport;
    const Viewport before = view;
    const bool was_fitted = !workspace_.document.empty() && is_same_view(view, fitted(view));
    view.left = sizes.toolbar;
    view.top = sizes.menu + sizes.options;
    const double room = window_.width() - sizes.toolbar - sizes.inspector;
    const bool halved = workspace_.shows_surface();
    view.width = std::max(1.0, halved ? std::floor(room / 2) : room);
    if (halved != std::exchange(halved_, halved)) fit_ = true;
    const bool timed = workspace_.shown.timeline.visible && !workspace_.document.empty();
    view.height =
        std::max(1.0, window_.height() - view.top - sizes.status - (timed ? sizes.timeline : 0));
    workspace_.display.handle_px = 10 * window_.scale();
    // A view that shows everything still does so after the window was resized or maximized.
    const bool resized = before.width != view.width || before.height != view.height;
    if (std::exchange(fit_, false) || (resized && was_fitted && !current_tool().busy()))
      view = fitted(view);
  }

  /// A view of this size that shows the whole picture, beside the start card if there is one.
  Viewport fitted(Viewport view) const {
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
  static bool is_same_view(const Viewport& a, const Viewport& b) {
    constexpr double kClose = 1e-6;
    return std::abs(a.zoom - b.zoom) < kClose * a.zoom &&
           std::abs(a.center - b.center) * a.zoom < kClose;
  }

  /// Fits the view to the posed picture of a newly opened scene, unless the user has already
  /// started to work. Waits for the map, which determines the picture's extent.
  void show_whole_map() {
    if (workspace_.document.history().can_undo()) opened_ = false;
    if (!opened_ || !workspace_.map().has_map() || workspace_.map().busy()) return;
    opened_ = false;
    Viewport& view = workspace_.display.viewport;
    Box seen;
    seen.include(view.plane_at_px({view.left, view.top}));
    seen.include(view.plane_at_px({view.left + view.width, view.top + view.height}));
    const Box all = content_box(workspace_);
    if (!seen.contains({all.left, all.bottom}) || !seen.contains({all.right, all.top}))
      view.fit(all);
  }

  void handle_events() {
    // While a dialog or question is open, dropped files and requests to close the window wait.
    if (!files_.asking()) {
      for (const Path& path : window_.take_drops()) files_.drop(path);
      if (window_.take_close()) workspace_.request = Request::quit;
    }
    // A panel's preview ends when the user no longer drags any of its items.
    const bool active = ImGui::IsAnyItemActive();
    if (workspace_.shown.preview && !current_tool().busy() && !active && !was_active_)
      workspace_.shown.preview.reset();
    was_active_ = active;
    panel_focus_.look();
    for (const auto& [key, repeats] : window_.take_keys()) {
      const KeyFocus focus = key_focus(window_focus());  // the previous key may have changed it
      if (focus == KeyFocus::assignment && !repeats) keys_.take(key);  // a held key counts once
      if (focus == KeyFocus::panel) handle_panel_key(key);
      if (focus == KeyFocus::canvas) take_key(key);
    }
    const bool holds = key_focus(window_focus()) == KeyFocus::canvas;
    workspace_.display.hide_overlays = holds && is_held("hold.overlays");
    workspace_.display.show_original = holds && is_held("hold.original") && !current_tool().busy();
    window_.set_alt_override(holds && is_held("hold.alt"));
  }

  static bool has_popup() {
    return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  }

  WindowFocus window_focus() const {
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

  void handle_panel_key(const Shortcut& key) {
    if (key == Shortcut(Key::escape)) return panel_focus_.leave();
    const Action* action = workspace_.actions.for_key(key, workspace_);
    if (action && acts_from_panel(key, *action)) holomorph::run(*action, workspace_);
  }

  /// Whether a key of this action is down. Used for actions that last while a key is held.
  bool is_held(const char* id) const {
    const ImGuiIO& io = ImGui::GetIO();
    const Modifiers held{io.KeyCtrl, io.KeyShift, io.KeyAlt && !window_.alt_override()};
    return std::ranges::any_of(workspace_.actions.named(id).keys, [&](const Shortcut& key) {
      return window_.is_down(key) && key.mods == held;
    });
  }

  void take_key(const Shortcut& key) {
    if (key == Shortcut(Key::space)) return;  // navigate() handles Space: a tap plays, a drag pans
    const bool escapes = key.key == static_cast<int>(Key::escape) && current_tool().busy();
    if ((key.mods == Modifiers{} || escapes) && key.key >= 256 &&
        current_tool().key(static_cast<Key>(key.key), workspace_))
      return;
    if (current_tool().busy()) return handle_key_in_gesture(key);
    if (const Action* action = workspace_.actions.for_key(key, workspace_))
      holomorph::run(*action, workspace_);
  }

  /// During a gesture, only actions that allow it can run, such as changes of the view. Undo takes
  /// back part of the gesture.
  void handle_key_in_gesture(const Shortcut& key) {
    const Action* action = workspace_.actions.owner_of(key);
    if (!action) return;
    if (action->id == "edit.undo") current_tool().key(Key::backspace, workspace_);
    if (action->during_gesture) holomorph::run(*action, workspace_);
  }

  Input read_input() {
    const ImGuiIO& io = ImGui::GetIO();
    Input input;
    input.px = {io.MousePos.x, io.MousePos.y};
    input.mods = {io.KeyCtrl, io.KeyShift, io.KeyAlt};
    input.now_ms = now_ms();
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

  void navigate(Input& input) {
    const bool pressed = input.pressed;
    const bool space = window_.is_down(Key::space) && !ImGui::GetIO().WantTextInput;
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

  Tool& current_tool() {
    for (const auto& tool : tools_)
      if (tool->id() == workspace_.tools.active) return *tool;
    return *tools_[0];
  }

  void use_tool(Input input) {
    if (last_tool_ != workspace_.tools.active) {
      for (const auto& tool : tools_)
        if (tool->id() == last_tool_) tool->cancel(workspace_);
      last_tool_ = workspace_.tools.active;
    }
    if (is_before(workspace_.display, input.px) && !current_tool().busy())
      input.pressed = input.double_clicked = input.inside = false;
    if (input.pressed && workspace_.tools.active == ToolId::select &&
        workspace_.tools.drags_layers) {
      leave_closed_layer(workspace_, input.px);
      input.position = workspace_.layer_view().plane_at_px(input.px);
    }
    if (input.pressed && !workspace_.require_open_layer())
      input.pressed = input.double_clicked = input.inside = false;
    if (input.pressed) workspace_.shown.timeline.keys.clear();  // so that Delete removes handles
    current_tool().input(input, workspace_);
  }

  void open_context_menu(const Input& input) {
    if (!input.inside || !ImGui::IsMouseClicked(1)) return;
    if (const auto handle = handle_at(workspace_, input.px);
        handle && !is_before(workspace_.display, input.px) &&
        !workspace_.selection.contains(*handle))
      workspace_.selection = {*handle};
    ImGui::OpenPopup("context");
  }

  void answer(Request request) {
    files_.answer(request);
    if (request == Request::help) keys_.show();
    if (request == Request::context_menu) ImGui::OpenPopup("context");
    if (request == Request::compare) comparison_.start(workspace_.shown.own());
    if (request == Request::palette) palette_.show();
    if (request == Request::menu) goes_to_menu_ = true;
    if (request == Request::rename_layer) layers_.rename(workspace_.document.scene());
    if (request == Request::next_panel) panel_focus_.next();
  }

  void answer(const PanelAnswer& wanted) {
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

  void document_replaced() {
    for (const auto& tool : tools_) tool->cancel(workspace_);
    canvas_.forget();
    last_picture_.opened(workspace_);
    panel_focus_.leave();
    layers_.forget();
    timeline_.forget();
    fit_ = opened_ = true;
    if (!workspace_.document.empty()) samples_.pause();
  }

  void update_title() {
    const Document& document = workspace_.document;
    const std::string title =
        document.empty()
            ? "Holomorph"
            : document.title() + (document.modified() ? " * - Holomorph" : " - Holomorph");
    if (title != title_) window_.set_title(title_ = title);
  }

  void draw_canvas() {
    const CanvasColors colors = canvas_colors();
    canvas_.draw(workspace_,
                 {window_.framebuffer_width(), window_.framebuffer_height(),
                  static_cast<double>(window_.framebuffer_width()) / window_.width(), colors.canvas,
                  colors.page_a, colors.page_b, static_cast<double>(px(8)),
                  has_high_contrast() ? 0 : static_cast<double>(px(12)), is_light() ? 0.2f : 0.4f,
                  last_picture_.shows()});
  }

  void draw_panels(const Input& input, PanelSizes sizes) {
    const double scale = window_.scale();
    const OverlayStyle style{canvas_colors(), scale};
    suppress_tooltips(palette_.open());
    const PanelAnswer menus =
        draw_menu_bar(workspace_, preferences_, thumbnails_,
                      std::exchange(goes_to_menu_, false) ? &panel_focus_ : nullptr);
    StatusLine status;
    if (workspace_.document.empty()) {
      status.hint = "Open or drop a picture, or click a sample. " +
                    workspace_.actions.key_of("help.keys") + " lists keys and mouse gestures.";
      answer(draw_welcome(workspace_, preferences_, samples_, files_.recoverable(), thumbnails_,
                          sizes));
    } else {
      if (last_picture_.shows() || last_picture_.solving()) last_picture_.draw(workspace_);
      draw_overlay(workspace_, current_tool().overlay(), style);
      draw_split_line(workspace_.display, style);
      if (canvas_.edited().heat_values().size() > 0)
        draw_legend(workspace_, canvas_.edited().heat_scale(), canvas_.edited().heat_values(),
                    style);
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
    toasts_.draw(workspace_, style);
    if (workspace_.map().error() && workspace_.map().error()->where())
      draw_marker(workspace_, *workspace_.map().error()->where(), style);
    files_.draw();
    keys_.draw();
    answer(palette_.draw(workspace_, preferences_));
  }

  /// Draws the cards and the inspector, whose lower part cards take if the canvas has no room.
  void draw_cards(const OverlayStyle& style, PanelSizes sizes) {
    const bool starts = start_card_.shows(workspace_) && !current_tool().busy();
    const bool docks = starts && !StartCard::has_room(workspace_);
    if (starts && !docks) start_card_.draw(workspace_, style);
    bool closed = false;
    first_steps_.follow(workspace_, files_.has_exported());
    float docked = 0;
    if (preferences_.hints && first_steps_.done()) closed = true;
    // The start card already suggests the first step.
    if (preferences_.hints && !starts && !closed && !first_steps_.draw(workspace_, closed))
      docked =
          first_steps_.draw_docked(workspace_, static_cast<float>(sizes.inspector),
                                   static_cast<float>(window_.height() - sizes.status), closed);
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

  StatusLine status_of(const Input& input) {
    StatusLine status;
    status.hint = current_tool().hint(workspace_);
    if (workspace_.shows_surface() && surface_pane_.hovered()) status.hint = SurfacePane::hint();
    if (panel_focus_.held())
      status.hint =
          "Press Esc for the canvas; use arrow keys, Tab and Enter in this panel; press " +
          workspace_.actions.key_of("view.next_panel") + " for the next panel";
    if (workspace_.shown.timeline.recording)
      status.hint = recording_hint(workspace_.shown.timeline);
    if (input.inside) status.cursor = input.position;
    if (input.inside && !workspace_.at_rest())
      status.cursor_at_rest = rest_at(workspace_, input.position);
    status.draft = workspace_.shown.preview.has_value() || workspace_.map().busy() ||
                   workspace_.map().error().has_value();
    return status;
  }

  Preferences preferences_;
  Window window_;
  Canvas canvas_;
  Workspace workspace_;
  std::vector<std::unique_ptr<Tool>> tools_;
  ToolId last_tool_ = ToolId::select;
  Samples samples_{[this] { window_.wake(); }};
  Toasts toasts_;
  Thumbnails thumbnails_{[this] { window_.wake(); }};
  StartCard start_card_{[this] { window_.wake(); }};
  FirstSteps first_steps_;
  std::optional<StateFile> state_file_;
  std::string title_;
  bool fit_ = false, opened_ = false, halved_ = false, was_active_ = false, restyle_ = false,
       menu_was_open_ = false, goes_to_menu_ = false, moving_ = false;
  double watched_ms_ = 0, slowest_ms_ = 0, slowest_work_ms_ = 0;
  Navigation navigation_;
  SplitLine split_line_;
  ComparisonPanel comparison_;
  SurfacePane surface_pane_{[this] { window_.wake(); }};
  TimelinePanel timeline_;
  LastPictureView last_picture_{[this] { window_.wake(); }};
  LayerPanel layers_;
  Files files_;
  KeysWindow keys_;
  Palette palette_;
  PanelFocus panel_focus_;
};

}  // namespace

int run_editor(const EditorOptions& options) {
  if (!options.file.empty() && !path_exists(options.file))
    throw Error(ErrorKind::bad_input,
                options.file.string() + ": no such file or command. See 'holomorph --help'");
  if (!has_display())
    throw Error(ErrorKind::failed,
                "cannot open a window: there is no display. 'holomorph render SCENE --out "
                "PICTURE.png' works without one");
  return Editor(options).run();
}

}  // namespace holomorph
