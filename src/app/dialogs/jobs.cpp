// A canceled job no longer blocks the window. It is destroyed once it has ended.
#include "app/dialogs/jobs.h"

#include <imgui.h>

#include <cmath>
#include <utility>

#include "app/look/controls.h"
#include "app/look/surfaces.h"

namespace holomorph {
namespace {

/// Jobs that end within this time, in ms, show no dialog. This avoids flicker.
constexpr double kShortMs = 60;

}  // namespace

std::string Jobs::run(const std::string& title, Job::Work work, std::function<void()> then,
                      bool quietly) {
  if (job_) abandon();
  job_ = std::make_unique<Job>(title, std::move(work), wake_);
  then_ = std::move(then);
  quiet_ = quietly;
  return job_->ended_within(kShortMs) ? finish() : "";
}

void Jobs::cancel() {
  abandon();
  workspace_.messages.say("Canceled.");
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

void Jobs::draw() {
  std::erase_if(abandoned_, [](const auto& job) { return job->ended(); });
  if (!job_) return;
  if (quiet()) {
    if (job_->ended()) workspace_.messages.complain(finish());
    return;
  }
  if (!begin_dialog(job_->title(), "###job", 420)) return;
  const int done = job_->done(), all = job_->all();
  const ThemeColors& c = theme_colors();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, tall = px(4);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + width, at.y + tall}, faded(c.edge), tall / 2);
  float from = 0, to = 0;
  if (all > 0) {
    to = static_cast<float>(done) / static_cast<float>(all);
  } else {
    // The duration is unknown, so a light moves back and forth.
    const float t = static_cast<float>(std::fmod(ImGui::GetTime(), 2.0));
    from = 0.8f * (t < 1 ? t : 2 - t);
    to = from + 0.2f;
  }
  list.AddRectFilled({at.x + from * width, at.y}, {at.x + to * width, at.y + tall},
                     faded(c.accent_fill), tall / 2);
  ImGui::Dummy({width, tall});
  caption(all > 0 ? std::to_string(done) + " of " + std::to_string(all) : "Please wait.");
  begin_dialog_buttons(px(96));
  const bool canceled =
      button("Cancel", ButtonKind::secondary, px(96)) || dialog_key() == DialogKey::escape;
  if (canceled) {
    cancel();
  } else if (job_->ended()) {
    workspace_.messages.complain(finish());
  }
  if (!job_) ImGui::CloseCurrentPopup();
  end_dialog();
}

}  // namespace holomorph
