// One frame, from the mouse to pixels, in the order of src/README.md.
#include "app/editor.h"

#include <imgui.h>

#include <chrono>
#include <utility>

#include "app/file_dialog.h"
#include "app/overlay.h"
#include "app/panels.h"
#include "app/state_file.h"
#include "core/error.h"
#include "raster/picture.h"
#include "render/renderer.h"

namespace holomorph {
namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::vector<Sample> load_samples() {
  const Path folder = std::filesystem::exists(HOLOMORPH_ASSETS) ? Path(HOLOMORPH_ASSETS)
                                                                : Path(HOLOMORPH_INSTALLED_ASSETS);
  struct Row {
    const char *name, *title, *text;
  };
  static constexpr Row kRows[] = {
      {"giraffe", "Giraffe",
       "A cage around the whole animal; its neck is bent by a few cage points."},
      {"gecko", "Gecko", "Pins hold and move feet, head and tail."},
      {"sunflower", "Sunflower", "A cage, and pins that turn leaves and head."}};
  std::vector<Sample> samples;
  for (const Row& row : kRows) {
    Sample sample{folder / (std::string(row.name) + ".json"), row.title, row.text, {}};
    if (!std::filesystem::exists(sample.scene)) continue;
    try {
      const LoadedScene loaded = load_scene(sample.scene);
      PictureOptions options;
      options.scale = 320.0 / std::max({loaded.image->width, loaded.image->height, 1});
      const Image image = picture_of(loaded.scene, loaded.image.get(), options).image;
      sample.thumbnail = Texture(image.width, image.height, image.pixels.data());
    } catch (const Error&) {
      // The tile stays without a picture; opening it will say what is wrong.
    }
    samples.push_back(std::move(sample));
  }
  return samples;
}

class Editor {
 public:
  explicit Editor(const EditorOptions& options)
      : options_(options),
        preferences_(load_preferences()),
        window_(1280, 800, preferences_.ui_scale, preferences_.light_theme) {
    tools_.push_back(select_tool());
    tools_.push_back(pen_tool());
    tools_.push_back(pin_tool());
    workspace_.map.on_ready([this] { window_.wake(); });
    recoverable_ = recoverable(autosave_folder());
    if (!options.file.empty()) open(options.file);
    if (!options.file.empty() && !recoverable_.empty())
      workspace_.say("There is unsaved work from an earlier session: File > New shows it.");
    if (workspace_.document.empty()) samples_ = load_samples();
  }

  int run() {
    while (!quit_) {
      const double longest = shown_toasts_.empty() ? 1.0 : 0.25;
      if (!window_.wait(longest)) {
        forget_old_toasts();
        continue;
      }
      frame();
    }
    return 0;
  }

 private:
  struct ShownToast {
    Toast toast;
    double until;
  };

  // ---- One frame -------------------------------------------------------------------------------

  void frame() {
    if (std::exchange(restyle_, false)) {
      window_.set_style(preferences_.ui_scale, preferences_.light_theme);
      fit_ = true;
    }
    window_.begin_frame();
    const PanelSizes sizes = PanelSizes::at(window_.scale());
    layout(sizes);
    take_events();
    Input input = take_input();
    navigate(input);
    use_tool(input);
    open_context_menu(input);
    handle_request();
    const bool needs_derivatives = is_heat(workspace_.view);
    if (workspace_.map.update(workspace_.scene(), needs_derivatives)) window_.wake();
    update_heat();
    update_title();
    autosave();
    upload();
    draw_canvas();
    draw_panels(input);
    ImGui::Render();
    window_.end_frame();
    if (!options_.state_file.empty())
      write_state_file(options_.state_file, workspace_, current_tool().busy());
  }

  void layout(const PanelSizes& sizes) {
    Viewport& view = workspace_.viewport;
    view.left = sizes.toolbar;
    view.top = sizes.menu;
    view.width = std::max(1.0, window_.width() - sizes.toolbar - sizes.inspector);
    view.height = std::max(1.0, window_.height() - sizes.menu - sizes.status);
    workspace_.handle_px = 10 * window_.scale();
    if (fit_) {
      view.fit(workspace_.content_box());
      fit_ = false;
    }
  }

  void take_events() {
    for (const Path& path : window_.take_drops()) ask_then([this, path] { open(path); });
    if (window_.take_close()) workspace_.request = Request::quit;
    // A number that is being dragged in the inspector takes the keys, too.
    const bool typing = ImGui::GetIO().WantTextInput || ImGui::IsAnyItemActive();
    if (workspace_.preview && !current_tool().busy() && !ImGui::IsAnyItemActive() && !was_active_)
      workspace_.preview.reset();
    was_active_ = ImGui::IsAnyItemActive();
    const bool modal = dialog_.open() || unsaved_question_ || palette_ || help_;
    for (const Shortcut& key : window_.take_keys()) {
      if (typing || modal) continue;
      if (key.mods == Modifiers{} && key.key >= 256 &&
          current_tool().key(static_cast<Key>(key.key), workspace_))
        continue;
      if (current_tool().busy() && !pan_key(key))
        continue;  // a gesture is finished before anything else
      if (const Action* action = action_for(key, workspace_)) holomorph::run(*action, workspace_);
    }
    workspace_.hide_overlays = !typing && window_.is_down('H');
    workspace_.show_original = !typing && window_.is_down('\\');
  }

  /// Keys that only change the view may be pressed during a gesture.
  static bool pan_key(const Shortcut& key) {
    return key.key == 'F' || key.key == '+' || key.key == '-' || key.key == '0';
  }

  Input take_input() {
    const ImGuiIO& io = ImGui::GetIO();
    Input input;
    input.px = {io.MousePos.x, io.MousePos.y};
    input.mods = {io.KeyCtrl, io.KeyShift, io.KeyAlt};
    input.inside = !io.WantCaptureMouse && !workspace_.document.empty() &&
                   workspace_.viewport.contains_px(input.px);
    input.pressed = input.inside && ImGui::IsMouseClicked(0);
    input.double_clicked = input.inside && ImGui::IsMouseDoubleClicked(0);
    input.down = ImGui::IsMouseDown(0);
    input.released = ImGui::IsMouseReleased(0);
    return input;
  }

  void navigate(Input& input) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool space = window_.is_down(Key::space) && !io.WantTextInput;
    if (input.inside && (ImGui::IsMouseClicked(2) || (space && input.pressed))) panning_ = true;
    if (!ImGui::IsMouseDown(2) && !(space && input.down)) panning_ = false;
    if (panning_) workspace_.viewport.pan_px({io.MouseDelta.x, io.MouseDelta.y});
    if (input.inside && io.MouseWheel != 0)
      workspace_.viewport.zoom_at(input.px, std::pow(1.15, io.MouseWheel));
    if (panning_ || space) input.inside = input.pressed = input.double_clicked = false;
    input.position = workspace_.viewport.plane_at_px(input.px);
  }

  Tool& current_tool() {
    for (const auto& tool : tools_)
      if (tool->id() == workspace_.tool) return *tool;
    return *tools_[0];
  }

  void use_tool(const Input& input) {
    if (last_tool_ != workspace_.tool) {
      for (const auto& tool : tools_)
        if (tool->id() == last_tool_) tool->cancel(workspace_);
      last_tool_ = workspace_.tool;
    }
    current_tool().input(input, workspace_);
  }

  void open_context_menu(const Input& input) {
    if (!input.inside || !ImGui::IsMouseClicked(1)) return;
    if (const auto handle = handle_at(workspace_, input.px);
        handle && !workspace_.selection.contains(*handle))
      workspace_.selection = {*handle};
    ImGui::OpenPopup("context");
  }

  // ---- Files -----------------------------------------------------------------------------------

  /// Runs `then` at once, or after the user has decided about unsaved work.
  void ask_then(std::function<void()> then) {
    if (!workspace_.document.modified()) return then();
    after_question_ = std::move(then);
    unsaved_question_ = true;
  }

  void adopt(Document document) {
    workspace_.document.remove_autosave(autosave_folder());
    for (const auto& tool : tools_) tool->cancel(workspace_);
    workspace_.open(std::move(document));
    picture_dirty_ = true;
    fit_ = true;
    export_path_.clear();
  }

  void open(const Path& path) {
    try {
      adopt(Document::open(path));
      remember(preferences_, std::filesystem::absolute(path));
      keep_preferences();
    } catch (const Error& error) {
      workspace_.complain(error);
    }
  }

  void recover(const Path& autosave) {
    try {
      adopt(Document::recover(autosave));
      discard(autosave);
      workspace_.say("Recovered. Save it under a name to keep it.");
    } catch (const Error& error) {
      workspace_.complain(error);
    }
  }

  void discard(const Path& autosave) {
    std::error_code ignored;
    std::filesystem::remove(autosave, ignored);
    std::erase_if(recoverable_, [&](const Recovery& r) { return r.path == autosave; });
  }

  void save_to(const Path& path, std::function<void()> then) {
    try {
      workspace_.document.save(path);
      workspace_.document.remove_autosave(autosave_folder());
      remember(preferences_, workspace_.document.path());
      keep_preferences();
      workspace_.say("Saved " + path.filename().string() + ".");
      if (then) then();
    } catch (const Error& error) {
      workspace_.complain(error);
    }
  }

  void save(bool as, std::function<void()> then = {}) {
    const Document& document = workspace_.document;
    if (!as && !document.path().empty()) return save_to(document.path(), then);
    Path start = document.path();
    if (start.empty() && !document.image_path().empty())
      start = Path(document.image_path()).replace_extension(".json");
    if (start.empty()) start = "scene.json";
    dialog_.ask({FileQuestion::Mode::save, "Save the scene", "Save", {".json"}, start, false},
                [this, then](const Path& path, double) { save_to(path, then); });
  }

  void export_to(const Path& path, double scale) {
    try {
      PictureOptions options;
      options.scale = scale;
      options.view = workspace_.view;
      options.automatic_range = workspace_.automatic_range;
      const RasterResult result =
          picture_of(workspace_.document.scene(), workspace_.document.image(), options);
      write_file(path, encode_png(result.image));
      export_path_ = path;
      export_scale_ = scale;
      char text[64];
      std::snprintf(text, sizeof text, ", %d x %d pixels.", result.image.width,
                    result.image.height);
      workspace_.say("Exported " + path.filename().string() + text);
    } catch (const Error& error) {
      workspace_.complain(error);
    }
  }

  void ask_export() {
    const Document& document = workspace_.document;
    Path start = export_path_;
    if (start.empty()) start = document.path().empty() ? document.image_path() : document.path();
    if (start.empty()) start = "picture";
    // Never offer to replace the source picture itself.
    if (export_path_.empty()) start.replace_filename(start.stem().string() + "-bent.png");
    dialog_.ask({FileQuestion::Mode::save, "Export a picture", "Export", {".png"}, start, true},
                [this](const Path& path, double scale) { export_to(path, scale); });
  }

  void handle_request() {
    switch (std::exchange(workspace_.request, Request::none)) {
      case Request::none:
        break;
      case Request::new_scene:
        ask_then([this] {
          adopt(Document());
          if (samples_.empty()) samples_ = load_samples();
          recoverable_ = recoverable(autosave_folder());
        });
        break;
      case Request::open:
        ask_then([this] {
          dialog_.ask({FileQuestion::Mode::open,
                       "Open a picture or a scene",
                       "Open",
                       {".png", ".jpg", ".jpeg", ".bmp", ".tga", ".gif", ".psd", ".json"},
                       {},
                       false},
                      [this](const Path& path, double) { open(path); });
        });
        break;
      case Request::save:
        save(false);
        break;
      case Request::save_as:
        save(true);
        break;
      case Request::export_picture:
        ask_export();
        break;
      case Request::export_again:
        if (export_path_.empty())
          ask_export();
        else
          export_to(export_path_, export_scale_);
        break;
      case Request::quit:
        ask_then([this] {
          workspace_.document.remove_autosave(autosave_folder());
          quit_ = true;
        });
        break;
      case Request::help:
        help_ = true;
        break;
      case Request::palette:
        palette_ = palette_opening_ = true;
        palette_text_.clear();
        break;
    }
  }

  void autosave() {
    try {
      workspace_.document.autosave(autosave_folder());
    } catch (const std::exception& error) {
      if (!std::exchange(autosave_failed_, true))
        workspace_.complain(
            Error(ErrorKind::failed, std::string("Autosave does not work: ") + error.what()));
    }
  }

  void keep_preferences() {
    try {
      save_preferences(preferences_);
    } catch (const Error& error) {
      workspace_.complain(error);
    }
  }

  void update_title() {
    const Document& document = workspace_.document;
    const std::string title =
        document.empty()
            ? "Holomorph"
            : document.title() + (document.modified() ? " * - Holomorph" : " - Holomorph");
    if (title != title_) window_.set_title(title_ = title);
  }

  // ---- Drawing ---------------------------------------------------------------------------------

  void update_heat() {
    if (!is_heat(workspace_.view) || !workspace_.map.has_map() ||
        workspace_.map.map().fz.size() == 0) {
      heat_values_.resize(0);
      return;
    }
    heat_values_ = heat_values(workspace_.view, distortion_of(workspace_.map.map()));
    heat_scale_ = heat_scale(workspace_.view, heat_values_, workspace_.automatic_range);
  }

  void upload() {
    if (std::exchange(picture_dirty_, false)) {
      const Image* image = workspace_.document.image();
      const int factor =
          image ? renderer_.set_picture(image->width, image->height, image->pixels.data())
                : renderer_.set_picture(0, 0, nullptr);
      if (factor > 1)
        workspace_.say(
            "The picture is larger than this driver's textures: the canvas shows it reduced " +
            std::to_string(factor) + " times. Export uses all pixels.");
    }
    const LiveMap& map = workspace_.map;
    if (!map.has_map()) {
      renderer_.set_mesh(nullptr);
      uploaded_ = 0;
      return;
    }
    if (uploaded_ != map.preparation()) {
      renderer_.set_mesh(map.prepared()->mesh.get());
      // On a processor-driven OpenGL the shader's sum is the slower one.
      by_operator_ = !is_software_driver() &&
                     renderer_.set_operator(map.prepared()->deformer->operator_matrix());
      uploaded_ = map.preparation();
    }
    if (by_operator_ && map.posed())
      renderer_.set_controls(map.prepared()->deformer->controls(pose_of(*map.posed())));
    renderer_.set_positions({map.map().f.data(), static_cast<size_t>(map.map().f.size())});
    if (heat_values_.size() == map.map().f.size()) {
      Eigen::VectorXf shades(heat_values_.size());
      for (Index i = 0; i < shades.size(); ++i)
        shades[i] = static_cast<float>(heat_position(heat_scale_, heat_values_[i]));
      renderer_.set_heat(shades);
    }
  }

  void draw_canvas() {
    const double ratio = static_cast<double>(window_.framebuffer_width()) / window_.width();
    const Viewport& view = workspace_.viewport;
    const CanvasColors colors = canvas_colors(window_.light());
    Frame frame;
    frame.window_width = window_.framebuffer_width();
    frame.window_height = window_.framebuffer_height();
    frame.canvas_left = view.left * ratio;
    frame.canvas_top = view.top * ratio;
    frame.canvas_width = view.width * ratio;
    frame.canvas_height = view.height * ratio;
    frame.center = view.center;
    frame.zoom = view.zoom * ratio;
    frame.view =
        is_heat(workspace_.view) && heat_values_.size() == 0 ? View::image : workspace_.view;
    frame.diverging = heat_scale_.diverging;
    frame.wireframe = workspace_.show_mesh;
    frame.placement = workspace_.at_rest() ? Placement::at_rest
                      : by_operator_       ? Placement::by_operator
                                           : Placement::positions;
    frame.background = colors.canvas;
    frame.backdrop = colors.backdrop;
    renderer_.draw(frame);
  }

  void draw_panels(const Input& input) {
    const double scale = window_.scale();
    const OverlayStyle style{canvas_colors(window_.light()), scale};
    answer(draw_menu_bar(workspace_, preferences_));
    StatusLine status;
    if (workspace_.document.empty()) {
      status.hint = "Open or drop a picture, or click a sample. F1 shows keys and mouse.";
      answer(draw_welcome(workspace_, preferences_, samples_, recoverable_, scale));
    } else {
      draw_overlay(workspace_, current_tool().overlay(), style);
      if (heat_values_.size() > 0) draw_legend(workspace_, heat_scale_, heat_values_, style);
      draw_toolbar(workspace_, scale);
      draw_inspector(workspace_, heat_scale_, scale);
      draw_cage_offer(workspace_, scale);
      draw_context_menu();
      status.hint = current_tool().hint(workspace_);
      if (input.inside) status.cursor = input.position;
      status.draft = workspace_.preview.has_value() || workspace_.map.busy() ||
                     workspace_.map.error().has_value();
      status.by_operator = by_operator_;
    }
    draw_status_bar(workspace_, status, scale);
    draw_toasts(style);
    if (workspace_.map.error() && workspace_.map.error()->where())
      draw_marker(workspace_, *workspace_.map.error()->where(), style);
    dialog_.draw(scale);
    draw_unsaved_question();
    if (help_) help_ = draw_help(scale);
    if (palette_)
      palette_ =
          draw_palette(workspace_, palette_text_, std::exchange(palette_opening_, false), scale);
  }

  void answer(const PanelAnswer& wanted) {
    if (wanted.open) ask_then([this, path = *wanted.open] { open(path); });
    if (wanted.recover) ask_then([this, path = *wanted.recover] { recover(path); });
    if (wanted.discard) discard(*wanted.discard);
    if (wanted.style_changed) {
      keep_preferences();
      restyle_ = true;
    }
  }

  void draw_context_menu() {
    if (!ImGui::BeginPopup("context")) return;
    for (const char* id : {"edit.delete", "edit.reset", "edit.free_angle", "edit.select_all",
                           "view.frame", "view.fit", "cage.rest"}) {
      const Action& action = action_named(id);
      if (ImGui::MenuItem(action.label.c_str(),
                          action.keys.empty() ? "" : text_of(action.keys[0]).c_str(), false,
                          action.enabled(workspace_)))
        holomorph::run(action, workspace_);
    }
    ImGui::EndPopup();
  }

  void draw_unsaved_question() {
    if (unsaved_question_) ImGui::OpenPopup("Unsaved changes");
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal("Unsaved changes", nullptr,
                                ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove))
      return;
    ImGui::TextUnformatted("There are changes that are not saved.");
    ImGui::Dummy({0, 6});
    const float width = 130 * static_cast<float>(window_.scale());
    const auto close = [&] {
      unsaved_question_ = false;
      ImGui::CloseCurrentPopup();
    };
    if (ImGui::Button("Save", {width, 0}) ||
        ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter))) {
      close();
      save(false, std::exchange(after_question_, {}));
    }
    ImGui::SameLine();
    if (ImGui::Button("Do not save", {width, 0})) {
      close();
      if (const auto then = std::exchange(after_question_, {})) then();
    }
    ImGui::SameLine();
    if (ImGui::Button("Cancel", {width, 0}) ||
        ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
      close();
      after_question_ = {};
    }
    ImGui::EndPopup();
  }

  void draw_toasts(const OverlayStyle& style) {
    for (Toast& toast : std::exchange(workspace_.toasts, {})) {
      const double duration = toast.problem ? 9 : 4.5;
      shown_toasts_.push_back({std::move(toast), seconds() + duration});
    }
    const float s = static_cast<float>(style.scale);
    const Viewport& view = workspace_.viewport;
    float y = static_cast<float>(view.top) + 14 * s;
    for (const ShownToast& shown : shown_toasts_) {
      ImDrawList& list = *ImGui::GetForegroundDrawList();
      const float wrap = static_cast<float>(std::min(620.0 * s, view.width - 40 * s));
      const ImVec2 size = ImGui::CalcTextSize(shown.toast.text.c_str(), nullptr, false, wrap);
      const float x = static_cast<float>(view.left + view.width / 2) - size.x / 2;
      list.AddRectFilled({x - 14 * s, y - 8 * s}, {x + size.x + 14 * s, y + size.y + 8 * s},
                         style.colors.panel, 6 * s);
      list.AddRect({x - 14 * s, y - 8 * s}, {x + size.x + 14 * s, y + size.y + 8 * s},
                   shown.toast.problem ? style.colors.warning : style.colors.accent, 6 * s, 0,
                   1.5f * s);
      list.AddText(nullptr, 0, {x, y}, style.colors.text, shown.toast.text.c_str(), nullptr, wrap);
      if (shown.toast.where) draw_marker(workspace_, *shown.toast.where, style);
      y += size.y + 24 * s;
    }
  }

  void forget_old_toasts() {
    const size_t before = shown_toasts_.size();
    std::erase_if(shown_toasts_, [](const ShownToast& shown) { return shown.until < seconds(); });
    if (shown_toasts_.size() != before) window_.wake();
  }

  EditorOptions options_;
  Preferences preferences_;
  Window window_;
  Renderer renderer_;
  Workspace workspace_;
  std::vector<std::unique_ptr<Tool>> tools_;
  ToolId last_tool_ = ToolId::select;
  FileDialog dialog_;
  std::vector<Sample> samples_;
  std::vector<Recovery> recoverable_;
  std::vector<ShownToast> shown_toasts_;
  std::function<void()> after_question_;
  std::string title_, palette_text_;
  Path export_path_;
  double export_scale_ = 1;
  Eigen::VectorXd heat_values_;
  HeatScale heat_scale_;
  unsigned uploaded_ = 0;
  bool picture_dirty_ = false, fit_ = false, panning_ = false, by_operator_ = false,
       unsaved_question_ = false;
  bool help_ = false, palette_ = false, palette_opening_ = false, autosave_failed_ = false,
       was_active_ = false, quit_ = false;
  bool restyle_ = false;
};

}  // namespace

int run_editor(const EditorOptions& options) {
  if (!options.file.empty() && !std::filesystem::exists(options.file))
    throw Error(ErrorKind::bad_input,
                options.file.string() +
                    ": there is no such file, and no such command; see 'holomorph --help'");
  if (!has_display())
    throw Error(ErrorKind::failed,
                "no window can be opened here: there is no display. 'holomorph render SCENE --out "
                "PICTURE.png' works without one");
  return Editor(options).run();
}

}  // namespace holomorph
