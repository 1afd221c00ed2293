// The differences between the versions of ImGui that distributions have: 1.86 (Debian 12) and 1.90
// (Debian 13). Up to 1.86, programs write the state of keys and mouse; later versions take events.
#pragma once

#ifndef GLFW_INCLUDE_NONE
#define GLFW_INCLUDE_NONE
#endif
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <utility>

namespace holomorph {

/// Keys are given by GLFW's codes. The pointer is in window px.
struct HeldModifiers {
  bool ctrl = false, shift = false, alt = false, super = false;
};

struct PointerState {
  float x = 0, y = 0;
  bool down[3] = {false, false, false};
};

#if IMGUI_VERSION_NUM >= 18700 && IMGUI_VERSION_NUM < 18900
#error "ImGui 1.87 and 1.88 are not supported, because their modifiers are not keys"
#endif

#if IMGUI_VERSION_NUM < 18700

inline void set_up_input(ImGuiIO& io) {
  for (const auto& [key, code] : {std::pair{ImGuiKey_Tab, GLFW_KEY_TAB},
                                  {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                  {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                  {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                  {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                  {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
                                  {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
                                  {ImGuiKey_Home, GLFW_KEY_HOME},
                                  {ImGuiKey_End, GLFW_KEY_END},
                                  {ImGuiKey_Insert, GLFW_KEY_INSERT},
                                  {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                  {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                  {ImGuiKey_Space, GLFW_KEY_SPACE},
                                  {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                  {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                  {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
                                  {ImGuiKey_A, GLFW_KEY_A},
                                  {ImGuiKey_C, GLFW_KEY_C},
                                  {ImGuiKey_V, GLFW_KEY_V},
                                  {ImGuiKey_X, GLFW_KEY_X},
                                  {ImGuiKey_Y, GLFW_KEY_Y},
                                  {ImGuiKey_Z, GLFW_KEY_Z}})
    io.KeyMap[key] = code;
}

inline void send_key(ImGuiIO& io, int code, bool down) {
  if (code >= 0 && code < IM_ARRAYSIZE(io.KeysDown)) io.KeysDown[code] = down;
}

inline void send_modifiers(ImGuiIO& io, const HeldModifiers& held) {
  io.KeyCtrl = held.ctrl;
  io.KeyShift = held.shift;
  io.KeyAlt = held.alt;
  io.KeySuper = held.super;
}

inline void send_pointer(ImGuiIO& io, const PointerState& pointer) {
  io.MousePos = {pointer.x, pointer.y};
  for (int button = 0; button < 3; ++button) io.MouseDown[button] = pointer.down[button];
}

inline void send_wheel(ImGuiIO& io, double x, double y) {
  io.MouseWheelH += static_cast<float>(x);
  io.MouseWheel += static_cast<float>(y);
}

/// Enter activates the item that has the keyboard focus. Later versions do this by themselves.
inline void activate_item(ImGuiIO& io) {
  io.NavInputs[ImGuiNavInput_Activate] = 1;
}

/// Items on top of the next item get the pointer. Also call the other function after that item.
inline void allow_overlap_of_next_item() {}
inline void allow_overlap_of_last_item() {
  ImGui::SetItemAllowOverlap();
}

inline bool is_hoverable(const ImRect& box, ImGuiID id) {
  return ImGui::ItemHoverable(box, id);
}
/// Whether the keyboard has just activated the item, to press it or to type into it.
inline bool is_activated(const ImGuiContext& imgui, ImGuiID id) {
  return imgui.NavActivateId == id || imgui.NavActivateInputId == id;
}

#else

inline ImGuiKey imgui_key(int code) {
  if (code >= GLFW_KEY_A && code <= GLFW_KEY_Z)
    return static_cast<ImGuiKey>(ImGuiKey_A + code - GLFW_KEY_A);
  if (code >= GLFW_KEY_0 && code <= GLFW_KEY_9)
    return static_cast<ImGuiKey>(ImGuiKey_0 + code - GLFW_KEY_0);
  if (code >= GLFW_KEY_F1 && code <= GLFW_KEY_F12)
    return static_cast<ImGuiKey>(ImGuiKey_F1 + code - GLFW_KEY_F1);
  switch (code) {
    case GLFW_KEY_TAB:
      return ImGuiKey_Tab;
    case GLFW_KEY_LEFT:
      return ImGuiKey_LeftArrow;
    case GLFW_KEY_RIGHT:
      return ImGuiKey_RightArrow;
    case GLFW_KEY_UP:
      return ImGuiKey_UpArrow;
    case GLFW_KEY_DOWN:
      return ImGuiKey_DownArrow;
    case GLFW_KEY_PAGE_UP:
      return ImGuiKey_PageUp;
    case GLFW_KEY_PAGE_DOWN:
      return ImGuiKey_PageDown;
    case GLFW_KEY_HOME:
      return ImGuiKey_Home;
    case GLFW_KEY_END:
      return ImGuiKey_End;
    case GLFW_KEY_INSERT:
      return ImGuiKey_Insert;
    case GLFW_KEY_DELETE:
      return ImGuiKey_Delete;
    case GLFW_KEY_BACKSPACE:
      return ImGuiKey_Backspace;
    case GLFW_KEY_SPACE:
      return ImGuiKey_Space;
    case GLFW_KEY_ENTER:
      return ImGuiKey_Enter;
    case GLFW_KEY_KP_ENTER:
      return ImGuiKey_KeypadEnter;
    case GLFW_KEY_ESCAPE:
      return ImGuiKey_Escape;
    default:
      return ImGuiKey_None;
  }
}

inline void set_up_input(ImGuiIO& io) {
  // Screen::pump_events already passes one press or release of a button at a time.
  io.ConfigInputTrickleEventQueue = false;
}

inline void send_key(ImGuiIO& io, int code, bool down) {
  if (const ImGuiKey key = imgui_key(code); key != ImGuiKey_None) io.AddKeyEvent(key, down);
}

inline void send_modifiers(ImGuiIO& io, const HeldModifiers& held) {
  io.AddKeyEvent(ImGuiMod_Ctrl, held.ctrl);
  io.AddKeyEvent(ImGuiMod_Shift, held.shift);
  io.AddKeyEvent(ImGuiMod_Alt, held.alt);
  io.AddKeyEvent(ImGuiMod_Super, held.super);
}

inline void send_pointer(ImGuiIO& io, const PointerState& pointer) {
  io.AddMousePosEvent(pointer.x, pointer.y);
  for (int button = 0; button < 3; ++button) io.AddMouseButtonEvent(button, pointer.down[button]);
}

inline void send_wheel(ImGuiIO& io, double x, double y) {
  io.AddMouseWheelEvent(static_cast<float>(x), static_cast<float>(y));
}

inline void activate_item(ImGuiIO&) {}

inline void allow_overlap_of_next_item() {
  ImGui::SetNextItemAllowOverlap();
}
inline void allow_overlap_of_last_item() {}

inline bool is_hoverable(const ImRect& box, ImGuiID id) {
#if IMGUI_VERSION_NUM < 19200
  return ImGui::ItemHoverable(box, id, ImGui::GetCurrentContext()->LastItemData.InFlags);
#else
  return ImGui::ItemHoverable(box, id, ImGui::GetCurrentContext()->LastItemData.ItemFlags);
#endif
}
inline bool is_activated(const ImGuiContext& imgui, ImGuiID id) {
  return imgui.NavActivateId == id;
}

#endif

}  // namespace holomorph
