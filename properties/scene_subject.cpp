// SPDX-License-Identifier: BSD-3-Clause
#include "properties/scene_subject.h"

#include <algorithm>
#include <utility>

#include "properties/binary32.h"
#include "properties/built_or_throw.h"
#include "properties/positions.h"
#include "properties/rendered.h"
#include "properties/world_step.h"

namespace forceshade::properties {
namespace {

class ReferenceOfScene final : public ReferenceSession {
 public:
  explicit ReferenceOfScene(const std::vector<MovingSubject>& objects) : scene_(sessions_of(objects)) {
    for (const MovingSubject& one : objects) motions_.push_back(one.motion);
  }

  reference::Rounded step(const Eigen::Vector3f& position) override {
    std::vector<scene::Pose> poses;
    for (const auto& motion : motions_) poses.push_back(motion->at(tick_));
    ++tick_;
    return scene_.step(position, poses);
  }

 private:
  static std::vector<reference::SceneSession::Object> sessions_of(const std::vector<MovingSubject>& objects) {
    std::vector<reference::SceneSession::Object> sessions;
    for (const MovingSubject& one : objects)
      sessions.emplace_back([its = std::shared_ptr(one.subject->open_reference())](const Eigen::Vector3f& position) {
        return its->step(position);
      });
    return sessions;
  }

  reference::SceneSession scene_;
  std::vector<std::shared_ptr<const scene::Motion>> motions_;
  std::uint64_t tick_ = 0;
};

class ScenePositions final : public Positions, private Draws {
 public:
  ScenePositions(const std::vector<MovingSubject>& objects, std::uint64_t seed) : Draws(seed), objects_(objects) {
    for (const MovingSubject& one : objects) streams_.push_back(one.subject->positions(bits()));
  }

  Aimed next() override {
    if (left_ == 0) {
      object_ = static_cast<std::size_t>(bits() % objects_.size());
      left_ = 1 + bits() % 64;
    }
    --left_;
    Aimed aimed = streams_[object_]->next();
    aimed.position = in_world(objects_[object_].motion->at(tick_++), aimed.position);
    return aimed;
  }

 private:
  const std::vector<MovingSubject>& objects_;
  std::vector<std::unique_ptr<Positions>> streams_;
  std::size_t object_ = 0;
  std::uint64_t left_ = 0, tick_ = 0;
};

scene::Motion from_tick(const scene::Motion& motion, std::uint64_t first) {
  scene::Motion moved = motion;
  const auto begin = moved.poses.begin();
  if (motion.repeats)
    std::rotate(begin, begin + static_cast<std::ptrdiff_t>(first % motion.poses.size()), moved.poses.end());
  else
    moved.poses.erase(begin, begin + static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(first, motion.poses.size() - 1)));
  return moved;
}

Renderer renderer_of_all(const std::vector<MovingSubject>& objects) {
  std::vector<MovingRenderer> renderers;
  for (const MovingSubject& one : objects) renderers.push_back({one.subject->renderer(), one.motion});
  return built_or_throw(renderer_of(std::move(renderers)));
}

bool are_rendered_by_library(const std::vector<MovingSubject>& objects) {
  return std::ranges::all_of(objects, [](const MovingSubject& one) { return is_rendered_by_library(*one.subject); });
}

}  // namespace

SceneSubject::SceneSubject(Identity identity, std::vector<MovingSubject> objects, double rate_hz)
    : KindOfLibrary(are_rendered_by_library(objects)),
      objects_(std::move(objects)),
      rendering_{std::move(identity), renderer_of_all(objects_), rate_hz} {}

std::vector<std::string> SceneSubject::parts() const {
  std::vector<std::string> words;
  for (const auto& [name, subject, motion] : objects_) {
    const Identity& its = subject->identity();
    const std::size_t count = motion->poses.size();
    const std::string poses =
        count == 1 ? "at rest" : std::to_string(count) + (motion->repeats ? " poses, repeated" : " poses");
    words.push_back(name + ": " + its.kind + ' ' + its.name + ", " + parameters_in_words(its) +
                    (its.digest.empty() ? "" : ", digest " + its.digest.substr(0, 12)) + "; " + poses);
  }
  return words;
}

std::unique_ptr<ReferenceSession> SceneSubject::open_reference() const {
  return std::make_unique<ReferenceOfScene>(objects_);
}

std::unique_ptr<Positions> SceneSubject::positions(std::uint64_t seed) const {
  return std::make_unique<ScenePositions>(objects_, seed);
}

const MovingSubject& SceneSubject::drawn_object(Chooser& choose) const {
  return objects_[static_cast<std::size_t>(choose(integers(0, static_cast<int>(objects_.size()) - 1)))];
}

std::vector<Eigen::Vector3f> SceneSubject::draw_path(Chooser& choose) const {
  const MovingSubject& object = drawn_object(choose);
  std::vector<Eigen::Vector3f> path = object.subject->draw_path(choose);
  for (std::size_t tick = 0; tick < path.size(); ++tick) path[tick] = in_world(object.motion->at(tick), path[tick]);
  return path;
}

Violation SceneSubject::check_continuity(Chooser& choose) const {
  return drawn_object(choose).subject->check_continuity(choose);
}
Violation SceneSubject::check_unit_normals(Chooser& choose) const {
  return drawn_object(choose).subject->check_unit_normals(choose);
}
Violation SceneSubject::check_passivity(Chooser& choose) const {
  return drawn_object(choose).subject->check_passivity(choose);
}

std::vector<std::function<Violation()>> SceneSubject::fixed_loops() const {
  std::vector<std::function<Violation()>> loops;
  for (const MovingSubject& one : objects_)
    for (auto& loop : one.subject->fixed_loops()) loops.push_back(std::move(loop));
  return loops;
}

std::vector<FurtherProperty> SceneSubject::further_properties() const {
  return {{"work of motion", [this](Chooser& choose) { return check_work_of_motion(choose); }}};
}

Violation SceneSubject::check_work_of_motion(Chooser& choose) const {
  std::vector<Eigen::Vector3f> path = draw_path(choose);
  std::erase_if(path, [](const Eigen::Vector3f& position) { return !is_valid(position); });
  const auto session = rendering_.renderer.open();
  std::vector<std::unique_ptr<fast::Session>> alone;
  for (const MovingSubject& one : objects_) alone.push_back(one.subject->renderer().open());
  for (std::size_t tick = 0; tick + 1 < path.size(); ++tick) {
    const Rendered answer = answer_of(*session, path[tick]);
    WorkOfTick work(path[tick], path[tick + 1]);
    bool is_seen = true;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      const scene::Pose &now = objects_[i].motion->at(tick), &next = objects_[i].motion->at(tick + 1);
      const auto seen = reference::seen_from(now, path[tick]), seen_next = reference::seen_from(next, path[tick + 1]);
      is_seen = is_seen && seen && seen_next;
      if (!is_seen) break;
      const Rendered its = answer_of(*alone[i], *seen);
      if (finished(its.status) == Status::contact) work.add({now, next, *seen, *seen_next, its.force});
    }
    // If an object does not see the hand, the scene's answer is invalid and has no force.
    if (!is_seen) return std::nullopt;
    if (answer.status == Status::invalid) continue;
    if (auto violation = work.difference_from(answer.force))
      return "tick " + std::to_string(tick) + " at " + show(path[tick]) + " mm: " + *violation;
  }
  return std::nullopt;
}

Expected SceneSubject::expected() const {
  Expected all{{"where the pose of an object jumps from one tick to the next"}, objects_.size() == 1};
  for (const MovingSubject& one : objects_) {
    const Expected its = one.subject->expected();
    for (const std::string& jump : its.jumps)
      if (std::ranges::find(all.jumps, jump) == all.jumps.end()) all.jumps.push_back(jump);
    all.has_unit_directions &= its.has_unit_directions;
  }
  return all;
}

DrawnSubject SceneSubject::with_drawn_parameters(std::uint64_t seed) const {
  Draws draws(seed);
  std::size_t longest = 1;
  for (const MovingSubject& one : objects_) longest = std::max(longest, one.motion->poses.size());
  const std::uint64_t first = draws.bits() % longest;
  std::vector<MovingSubject> drawn;
  std::string words = "from tick " + std::to_string(first) + " on: ";
  for (const auto& [name, subject, motion] : objects_) {
    DrawnSubject its = subject->with_drawn_parameters(draws.bits());
    words += name + ": " + its.parameters;
    drawn.push_back(
        {name, std::shared_ptr(std::move(its.subject)), std::make_shared<const scene::Motion>(from_tick(*motion, first))});
  }
  return {std::make_unique<SceneSubject>(identity(), std::move(drawn), *rendering_.rate_hz), words};
}

std::unique_ptr<Subject> scene_subject(const std::string& name, const DescribedScene& scene) {
  std::vector<MovingSubject> objects;
  for (const MovingObject& one : scene.objects)
    objects.push_back({one.name, std::shared_ptr(subject_of(one.what)), std::make_shared<const scene::Motion>(one.motion)});
  return std::make_unique<SceneSubject>(identity_of(name, scene), std::move(objects), static_cast<double>(scene.rate));
}

}  // namespace forceshade::properties
