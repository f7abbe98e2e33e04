// SPDX-License-Identifier: BSD-3-Clause
#include "apps/drive_window.h"

#include <cstdio>
#include <exception>
#include <memory>
#include <utility>

#include "apps/tell.h"
#include "device/latest_tick.h"
#include "device/triple_buffer.h"
#include "files/printable.h"
#include "system/system.h"

namespace forceshade::apps {
namespace {

constexpr double kStep = 1;  // mm, of a key that moves the plane

using GodObjectMailbox = device::TripleBuffer<mesh::GodObject>;

// A god-object that also shows where it is. Its answers are the session's.
class ShownGodObject final : public fast::Session {
 public:
  ShownGodObject(std::unique_ptr<fast::Session> session, fast::TickSession& its, GodObjectMailbox& mailbox)
      : session_(std::move(session)), its_(its), mailbox_(mailbox) {}

  fast::Evaluation step(const Eigen::Vector3f& position) noexcept override {
    const mesh::Tick tick = its_.tick({position.x(), position.y(), position.z()});
    mailbox_.publish(tick.after);
    return fast::evaluation_of(tick, its_.stage());
  }
  void look_ahead() noexcept override { its_.look_ahead(); }
  std::uint64_t shown() const noexcept override { return its_.shown(); }

 private:
  std::unique_ptr<fast::Session> session_;
  fast::TickSession& its_;
  GodObjectMailbox& mailbox_;
};

Rendering shown_in(GodObjectMailbox& mailbox, const Rendering& what) {
  Rendering shown = what;
  shown.renderer.open = [&mailbox, open = what.renderer.open]() -> std::unique_ptr<fast::Session> {
    std::unique_ptr<fast::Session> session = open();
    auto* its = dynamic_cast<fast::TickSession*>(session.get());
    return its == nullptr ? std::move(session) : std::make_unique<ShownGodObject>(std::move(session), *its, mailbox);
  };
  return shown;
}

}  // namespace

DriveWindow::DriveWindow(const Description& what, SurfaceCut& cut, const device::Placement& placement,
                         device::Steering& steering, const std::string& certified)
    : what_(what), cut_(cut), placement_(placement), steering_(steering), y_(cut.middle_y()), canvas_(window::Settings{}) {
  if (!canvas_.note().empty()) tell(canvas_.note());
  scene_.region = cut.region();
  scene_.words = {
      files::printable(certified),
      std::string("The mouse moves a hand that means to be at the cross, and the surface pushes the tip away from it. ") +
          (cut.at(y_).felt.empty() ? "" : "Dashed: the shape that is felt. ") +
          "Up and down arrow: y by 1 mm. Escape or S: end."};
}

run::Outcome DriveWindow::run(device::Device& device, const Rendering& what, run::Plan plan, const std::atomic<bool>& asked) {
  scene_.title = files::printable(what.identity.name) + ": " + parameters_in_words(what.identity);
  std::atomic<bool> stop = asked.load(), has_ended = false;
  device::LatestTick latest(asked, stop);
  GodObjectMailbox god_object;
  plan.servo.sinks.push_back(&latest);
  run::Outcome outcome;
  std::exception_ptr thrown;
  system::Thread loop("servo loop", [&] {
    try {
      outcome = run::run(device, shown_in(god_object, what), plan, stop);
    } catch (...) {
      thrown = std::current_exception();
    }
    has_ended = true;
  });
  try {
    while (!has_ended && show(latest.latest(), god_object.latest())) continue;
  } catch (...) {
    thrown = std::current_exception();
  }
  stop = true;
  loop.join();
  if (thrown) std::rethrow_exception(thrown);
  return outcome;
}

bool DriveWindow::show(const std::optional<device::Sample>& latest, const mesh::GodObject& god_object) {
  const auto wide = [](const std::array<float, 3>& v) {
    return std::array{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
  };
  if (latest) {
    const auto [x, y, z] = wide(latest->position);
    scene_.felt = {{x, y, z}, std::nullopt, wide(latest->force)};
    if (const auto* mesh = std::get_if<MeshRendering>(&what_.what))
      scene_.felt->god_object = place_on(mesh->mesh(), god_object);
  }
  scene_.section = cut_.at(scene_.felt ? scene_.felt->tip.y : y_);
  const bool is_open = canvas_.draw(
      [scene = scene_](window::Size size, const window::Measure& measure) { return picture_of(scene, size, measure); });
  for (const window::Key& key : canvas_.keys()) {
    if (key.name == "escape" || key.name == "s" || key.name == "S") return false;
    if (key.name == "up") y_ += kStep;
    if (key.name == "down") y_ -= kStep;
  }
  if (const auto pixel = canvas_.pointer()) {
    const auto [x, z] = window::SectionView(scene_.region, canvas_.size()).position(*pixel);
    scene_.intended = {x, z};
    const Eigen::Vector3f aim = placement_.origin() + placement_.turned_to_device(Eigen::Vector3d(x, y_, z).cast<float>());
    steering_.aim(aim.cast<double>());
  }
  return is_open;
}

}  // namespace forceshade::apps
