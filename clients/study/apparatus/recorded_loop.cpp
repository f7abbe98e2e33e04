// SPDX-License-Identifier: BSD-3-Clause
#include "study/apparatus/recorded_loop.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "forceshade/error.h"
#include "run/summary.h"
#include "run/words.h"
#include "study/apparatus/certificates.h"
#include "study/experiments/stimulus_list.h"

namespace forceshade::apparatus {
namespace {

namespace fs = std::filesystem;
using experiments::Bump;

// 16 s at 1 kHz: a part lasts a minute and a half, and one is begun while another is closed.
constexpr std::size_t kRing = std::size_t{1} << 14;

// Digits in front, so that the parts are in order by their names.
std::string numbered(int number, const std::string& place) {
  char digits[16];
  std::snprintf(digits, sizeof digits, "%05d-", number);
  return digits + place + ".fsr";
}

recorder::Metadata known_before(const LoopPlan& plan, const device::Capabilities& capabilities) {
  recorder::Metadata metadata = plan.metadata;
  metadata.insert({{"stimuli", "stimuli.jsonl"}, {"certified", plan.certificates.empty() ? "no" : "yes"}});
  metadata.merge(run::metadata_of_run(plan.device, capabilities, plan.servo));
  return metadata;
}

}  // namespace

RecordedLoop::RecordedLoop(device::Device& device, Bumps& bumps, LoopPlan plan, const std::atomic<bool>& stop)
    : device_(device),
      bumps_(bumps),
      plan_(std::move(plan)),
      parts_({.ring = kRing, .waits = !plan_.servo.paced}),
      latest_(stop, stop_) {
  std::error_code error;
  if (!fs::create_directory(plan_.folder, error))
    throw Error(plan_.folder.string() +
                ": cannot make the folder of this run's ticks: " + (error ? error.message() : "it is there already"));
  stimuli_.open(plan_.folder / "stimuli.jsonl");
  if (!stimuli_) throw Error((plan_.folder / "stimuli.jsonl").string() + ": cannot be written");
  plan_.servo.damping = bumps_.damping(plan_.servo.rate_hz);
  plan_.metadata = known_before(plan_, device_.capabilities());
  plan_.servo.sinks.push_back(&parts_);
  plan_.servo.sinks.push_back(&latest_);
}

RecordedLoop::~RecordedLoop() {
  stop_ = true;
  if (loop_.is_joinable()) loop_.join();
}

void RecordedLoop::start() {
  loop_ = system::Thread("servo loop", [this] {
    try {
      result_ = device::run_servo_loop(device_, stage_, plan_.servo, stop_);
    } catch (...) {
      thrown_ = std::current_exception();
    }
    ended_ = true;
  });
}

void RecordedLoop::follow(const experiments::Session& session) {
  // Answers to what was not recorded are worth little, and the disk may take no answer either.
  if (parts_.failing()) throw Error(plan_.folder.string() + ": the disk refuses the ticks; is it full?");
  begin_part(session);
  if (const experiments::Scene scene = session.scene(); scene != offered_) offer(scene);
  stage_.collect();
}

void RecordedLoop::begin_part(const experiments::Session& session) {
  const auto current = session.current();
  std::string place = "between";
  recorder::Metadata metadata = plan_.metadata;
  if (current) {
    place = (current->is_practice ? "practice" : "block-" + std::to_string(current->block)) + "-trial-" +
            std::to_string(current->index) + "-" + std::to_string(current->attempt);
    metadata.insert({{"block", std::to_string(current->block)},
                     {"trial_of_block", std::to_string(current->index)},
                     {"attempt", std::to_string(current->attempt)},
                     {"trial", std::to_string(current->trial.number)},
                     {"practice", current->is_practice ? "yes" : "no"},
                     {"stimulus", current->trial.stimulus},
                     {"radius_mil", std::to_string(current->trial.radius)},
                     {"repetition", std::to_string(current->trial.repetition)}});
  }
  if (place == place_) return;
  parts_.begin(plan_.folder / numbered(part_ + 1, place), std::move(metadata));
  ++part_;
  place_ = place;
}

void RecordedLoop::offer(const experiments::Scene& scene) {
  auto stimulus = std::make_unique<Stimulus>();
  stimulus->number = ++number_;
  stimulus->seam = plan_.origin.x();
  experiments::ListedStimulus listed{.number = number_, .seam = plan_.origin.x(), .left = {}, .right = {}};
  const auto place = [&](const std::optional<Bump>& bump, std::optional<Placed>& placed,
                         std::optional<experiments::ListedBump>& side) {
    if (!bump) return;
    const Rendering& rendering = bumps_.of(*bump);
    placed = Placed{rendering.renderer.open(), Bumps::place_of(*bump, plan_.origin)};
    const std::string name = certificate_name(rendering.identity);
    const auto digest = plan_.certificates.find(name);
    side = {bump->stimulus,
            bump->radius,
            {placed->origin.x(), placed->origin.y(), placed->origin.z()},
            run::summary_of(rendering.identity).dump(),
            name,
            digest == plan_.certificates.end() ? "none" : digest->second};
    if (!plan_.certificates.empty() && digest == plan_.certificates.end())
      throw Error(words_of(*bump) + ": no certificate was checked for it before the session");
  };
  place(scene.left, stimulus->left, listed.left);
  place(scene.right, stimulus->right, listed.right);
  stimuli_ << experiments::line_of(listed) << std::flush;
  if (!stimuli_) throw Error((plan_.folder / "stimuli.jsonl").string() + ": cannot be written");
  stage_.offer(std::move(stimulus));
  offered_ = scene;
  scenes_[number_] = scene;
}

experiments::Scene RecordedLoop::felt(const device::Sample& tick) {
  const auto found = scenes_.find(static_cast<std::uint32_t>(tick.shown & 0xFFFF'FFFF));
  if (found == scenes_.end()) return {};
  scenes_.erase(scenes_.begin(), found);
  return found->second;
}

double RecordedLoop::seconds() {
  const auto sample = latest();
  if (!sample) return 0;
  return plan_.servo.paced ? static_cast<double>(sample->wall_ns) / 1e9 : sample->device_time;
}

device::ServoResult RecordedLoop::stop() {
  stop_ = true;
  return stop_at_the_end();
}

device::ServoResult RecordedLoop::stop_at_the_end() {
  if (loop_.is_joinable()) loop_.join();
  parts_.end(thrown_ ? "not begun" : std::string(name_of(result_.end_reason)));
  if (thrown_) std::rethrow_exception(thrown_);
  return std::move(result_);
}

}  // namespace forceshade::apparatus
