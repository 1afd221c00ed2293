// A screen without a display: events are calls, time is a counter, and nothing is drawn.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>

#include "app/screen.h"

namespace holomorph {

class RecordedScreen final : public Screen {
 public:
  RecordedScreen(int width, int height, const Preferences& preferences)
      : width_(width), height_(height) {
    // As OpenGL's does, which draws more than 65536 vertices.
    ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    set_style(preferences.ui_scale, preferences.theme, preferences.reduce_motion);
  }

  /// Input, in window px and with GLFW's codes.
  void move(double x, double y) {
    x_ = x;
    y_ = y;
    add({Event::Type::move, x, y});
  }
  void button(int button, bool down) { add({Event::Type::button, x_, y_, button, 0, down}); }
  void scroll(double lines) { add({Event::Type::scroll, 0, lines}); }
  void key(int code, int action, int mods) { add({Event::Type::key, 0, 0, code, 0, action, mods}); }
  void character(int code) { add({Event::Type::character, 0, 0, code}); }
  void drop(const Path& path) { add_drop(path); }
  void close() { ask_to_close(); }

  /// Lets this much time pass while the editor waits.
  void let_pass(double seconds) {
    remaining_ms_ = 1000 * seconds;
    idle_ = false;
    frames_ = 0;
  }
  /// Whether no time is left to pass, and the editor waits for input, or has settled but keeps
  /// drawing, as while something plays.
  bool idle() const {
    constexpr int kSettled = 8;  // frames
    return idle_ || (remaining_ms_ <= 0 && !has_events() && frames_ >= kSettled);
  }

  double now_ms() const override { return now_ms_; }
  void set_title(const std::string& title) override { title_ = title; }
  const std::string& title() const { return title_; }
  int width() const override { return width_; }
  int height() const override { return height_; }
  int framebuffer_width() const override { return width_; }
  int framebuffer_height() const override { return height_; }

 private:
  static constexpr double kFrameMs = 1000.0 / 60;

  /// While time is left, it passes in steps of a frame. Each step also gives threads a moment.
  void poll(double longest) override {
    if (longest <= 0) return;
    std::unique_lock lock(mutex_);
    constexpr auto kMoment = std::chrono::milliseconds(2);
    if (!interrupted_ && remaining_ms_ <= 0) {
      idle_ = !has_events();
      if (!idle_) wakes_.wait_for(lock, kMoment, [&] { return interrupted_; });
      return;
    }
    if (!interrupted_) {
      wakes_.wait_for(lock, kMoment, [&] { return interrupted_; });
      const double step = std::min({1000 * longest, remaining_ms_, kFrameMs});
      remaining_ms_ -= step;
      now_ms_ += step;
    }
    interrupted_ = false;
  }
  void interrupt() override {
    const std::lock_guard lock(mutex_);
    interrupted_ = true;
    wakes_.notify_all();
  }
  void begin_drawing() override {
    now_ms_ += kFrameMs;
    remaining_ms_ = std::max(0.0, remaining_ms_ - kFrameMs);
    frames_ = remaining_ms_ > 0 || has_events() ? 0 : frames_ + 1;
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(width_), static_cast<float>(height_)};
    io.DeltaTime = static_cast<float>((now_ms_ - drawn_ms_) / 1000);
    drawn_ms_ = now_ms_;
  }
  void present() override {}
  double display_scale() const override { return 1; }
  void upload_fonts() override { ImGui::GetIO().Fonts->Build(); }
  char character_on(int key, int) const override {
    return key > ' ' && key < 127 ? static_cast<char>(key) : '\0';
  }

  int width_, height_;
  double x_ = -1e9, y_ = -1e9;
  double now_ms_ = 0, drawn_ms_ = 0, remaining_ms_ = 0;
  int frames_ = 0;  ///< since the last event
  bool idle_ = false, interrupted_ = false;
  std::mutex mutex_;
  std::condition_variable wakes_;
  std::string title_;
};

}  // namespace holomorph
