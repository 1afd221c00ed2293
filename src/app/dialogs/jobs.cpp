// A canceled job no longer blocks the window. It is destroyed once it has ended.
#include "app/dialogs/jobs.h"

#include <imgui.h>

#include <utility>

#include "app/panels/panels.h"

namespace holomorph {
namespace {

/// Jobs that end within this time, in ms, show no dialog. This avoids flicker.
constexpr double kShortMs = 60;

}  // namespace

std::string Jobs::run(const std::string& title, Job::Work work, std::function<void()> then) {
  if (job_) abandon();
  job_ = std::make_unique<Job>(title, std::move(work), wake_);
  then_ = std::move(then);
  return job_->ended_within(kShortMs) ? finish() : "";
}

void Jobs::abandon() {
  job_->cancel();
  abandoned_.push_back(std::move(job_));
  then_ = {};
}

std::string Jobs::finish() {
  const std::unique_ptr<Job> job = std::move(job_);
  const auto then = std::exchange(then_, {});
  if (const auto error = job->error()) return error->what();
  try {
    if (!job->cancelled()) then();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void Jobs::draw(double scale) {
  std::erase_if(abandoned_, [](const auto& job) { return job->ended(); });
  if (!job_) return;
  constexpr const char* kId = "###job";
  const float s = static_cast<float>(scale);
  ImGui::OpenPopup(kId);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  if (!ImGui::BeginPopupModal((job_->title() + kId).c_str(), nullptr,
                              ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove))
    return;
  const int done = job_->done(), all = job_->all();
  if (all > 0) {
    const std::string text = std::to_string(done) + " of " + std::to_string(all);
    ImGui::ProgressBar(static_cast<float>(done) / static_cast<float>(all), {360 * s, 0},
                       text.c_str());
  } else {
    // The duration is unknown, so a light moves back and forth.
    const float t = static_cast<float>(std::fmod(ImGui::GetTime(), 2.0)), at = t < 1 ? t : 2 - t;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::ProgressBar(0, {360 * s, 0}, "");
    const float height = ImGui::GetFrameHeight(), width = 70 * s, left = at * (360 * s - width);
    ImGui::GetWindowDrawList()->AddRectFilled(
        {corner.x + left, corner.y}, {corner.x + left + width, corner.y + height},
        ImGui::GetColorU32(ImGuiCol_PlotHistogram), ImGui::GetStyle().FrameRounding);
  }
  const bool cancel = ImGui::Button("Cancel", {120 * s, 0}) || escape_pressed();
  if (cancel) {
    abandon();
    workspace_.messages.say("Canceled.");
  } else if (job_->ended()) {
    workspace_.messages.complain(finish());
  }
  if (!job_) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace holomorph
