// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/simulators/course.h"

#include <array>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>

namespace forceshade::conformance::simulators {
namespace {

constexpr double kEnd = 1.2;  // m: the ground lies from -kEnd to kEnd
constexpr double kPushed = 10, kSpeed = 1, kDrop = 0.2;
constexpr double kLarge = 0.1, kSmall = 0.02;  // radii in m
constexpr double kBeside = 0.013;              // m: no line between cells is there

const Profile kFlat{{-kEnd, 0}, {kEnd, 0}};
const Profile kSlope{{-kEnd, kEnd * 7 / 24}, {kEnd, -kEnd * 7 / 24}};  // its normal is (7, 0, 24) / 25
const Profile kRidge{{-kEnd, 0}, {-0.05, 0}, {0, 0.01}, {0.05, 0}, {kEnd, 0}};
const Profile kStepUp{{-kEnd, 0}, {0, 0}, {0, 0.002}, {kEnd, 0.002}};
const Profile kStepDown{{-kEnd, 0.01}, {0, 0.01}, {0, 0}, {kEnd, 0}};
const Profile kPlate{{-kEnd, 0}, {kEnd, 0}, {kEnd, -0.002}, {-kEnd, -0.002}, {-kEnd, 0}};

const Tessellation kUsual{};
const Tessellation kCoarse{2, 4};  // of each part of an obstacle

std::string words_of(const Tessellation& its) {
  std::string words = std::to_string(its.along) + " x " + std::to_string(its.across) + " cells";
  if (its.moved > 0) return words + ", irregular";
  if (its.diagonals == Diagonals::falling) return words + ", falling diagonals";
  if (its.diagonals == Diagonals::alternating) return words + ", alternating diagonals";
  return words;
}

// The sphere touches the ground at (x, y).
Course on(const std::string& name, const Profile& profile, double radius, double x, double y) {
  Course course{{name + ", R = " + std::to_string(std::lround(1000 * radius)) + " mm"}, profile};
  course.scene.radius = radius;
  const Eigen::Vector3d normal = course.normal();
  const double height =
      profile[0].y() + (profile[1].y() - profile[0].y()) / (profile[1].x() - profile[0].x()) * (x - profile[0].x());
  course.scene.position = Eigen::Vector3d(x, y, height) + radius * normal;
  return course;
}

Course on_mesh(const std::string& name, const Profile& profile, const Tessellation& tessellation, double radius, double x,
               double y) {
  Course course = on(name + " of " + words_of(tessellation), profile, radius, x, y);
  course.scene.ground = mesh_of(profile, tessellation);
  return course;
}

Course on_box(double radius, double x, double y) {
  constexpr double kHalfHeight = 0.25;
  Course course = on("a box", kFlat, radius, x, y);
  course.scene.ground = GroundBox{{kEnd, kEnd, kHalfHeight}, {0, 0, -kHalfHeight}};
  return course;
}

Course sliding(Course course, const Eigen::Vector3d& direction = {1, 0, 0}) {
  course.scene.velocity = kSpeed * direction;
  course.push = {0, 0, -kPushed};
  return course;
}

Course falling(Course course) {
  course.scene.name += ", from above";
  course.scene.position.z() += kDrop;
  course.steps = 144;
  return course;
}

Course leaving(Course course, double speed, double lift) {
  course.scene.name += lift > 0 ? ", lifted" : ", going up";
  course.scene.velocity = {0, 0, speed};
  course.push = {0, 0, lift};
  course.steps = 40;
  return course;
}

template <class... Some>
Courses joined(Some&&... some) {
  Courses all;
  (all.insert(all.end(), some.begin(), some.end()), ...);
  return all;
}

// A floor from the faces of boxes that touch, or of a book that lies open: below its spine hang further pages.
GroundMesh floor_of_boxes() {
  GroundMesh mesh;
  for (const double from : {-kEnd, 0.0}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::uint32_t corner = 0; corner < 8; ++corner)
      mesh.vertices.emplace_back((corner & 1U) != 0 ? from + kEnd : from, (corner & 2U) != 0 ? kEnd : -kEnd,
                                 (corner & 4U) != 0 ? 0.0 : -0.5);
    for (const auto& [a, b, c, d] : std::initializer_list<std::array<std::uint32_t, 4>>{
             {4, 5, 7, 6}, {0, 2, 3, 1}, {0, 1, 5, 4}, {3, 2, 6, 7}, {2, 0, 4, 6}, {1, 3, 7, 5}}) {
      mesh.triangles.push_back({first + a, first + b, first + c});
      mesh.triangles.push_back({first + a, first + c, first + d});
    }
  }
  return mesh;
}

GroundMesh open_book() {
  GroundMesh mesh{{{0, -kEnd, 0}, {0, kEnd, 0}}, {}};
  for (const auto& [x, z] : {std::pair{kEnd, 0.0}, {-kEnd, 0.0}, {-0.3, -0.4}, {0.0, -0.5}, {0.3, -0.4}}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.emplace_back(x, -kEnd, z);
    mesh.vertices.emplace_back(x, kEnd, z);
    const bool is_left = x < 0;
    mesh.triangles.push_back({0, is_left ? 1 : first, is_left ? first : 1});
    mesh.triangles.push_back({first, is_left ? 1 : first + 1, is_left ? first + 1 : 1});
  }
  return mesh;
}

}  // namespace

Eigen::Vector3d Course::normal() const {
  const Eigen::Vector2d part = (profile[1] - profile[0]).normalized();
  return {-part.y(), 0, part.x()};
}

std::size_t Course::settled() const {
  return static_cast<std::size_t>(std::ceil(kSettlingTime * scene.rate));
}

Course oblique_slide(const Tessellation& tessellation) {
  Course course = sliding(on_mesh("a floor", kFlat, tessellation, kLarge, -0.4, -0.3 + kBeside), {0.8, 0.6, 0});
  course.scene.name += ", obliquely";
  return course;
}

Course resting_on(const Tessellation& tessellation) {
  Course course = on_mesh("a floor", kFlat, tessellation, kLarge, 0.05, 0.03);
  course.steps = 480;
  return course;
}

Courses slides() {
  Courses all{sliding(on_box(kLarge, -0.5, kBeside)), sliding(on_box(kSmall, -0.5, kBeside))};
  const Tessellation usual, fine{64, 64}, irregular{16, 16, Diagonals::rising, 0.3};
  for (const Tessellation& tessellation :
       {Tessellation{1, 1}, Tessellation{4, 4}, usual, Tessellation{16, 16, Diagonals::falling},
        Tessellation{16, 16, Diagonals::alternating}, fine, irregular})
    all.push_back(sliding(on_mesh("a floor", kFlat, tessellation, kLarge, -0.5, kBeside)));
  for (const Tessellation& tessellation : {usual, fine, irregular})
    all.push_back(sliding(on_mesh("a floor", kFlat, tessellation, kSmall, -0.5, kBeside)));
  all.push_back(oblique_slide(usual));
  all.push_back(oblique_slide(fine));
  all.push_back(sliding(on_mesh("a floor", kFlat, usual, kLarge, -0.5, 0)));
  all.back().scene.name += ", along a line between cells";
  all.push_back(on_mesh("a slope", kSlope, usual, kLarge, -0.6, kBeside));
  return all;
}

Courses rests() {
  Courses all{on_box(kLarge, 0.05, 0.03), resting_on(kUsual), on_mesh("a floor", kFlat, kUsual, kSmall, 0.05, 0.03),
              on_mesh("a floor", kFlat, kUsual, kLarge, 0.075, 0), on_mesh("a floor", kFlat, kUsual, kLarge, 0, 0)};
  all[3].scene.name += ", on an edge";
  all[4].scene.name += ", on a vertex";
  for (Course& course : all) course.steps = 480;
  return all;
}

Courses static_at(double rate) {
  Courses all{on_box(kLarge, 0.05, 0.03), on_mesh("a floor", kFlat, kUsual, kLarge, 0.05, 0.03)};
  for (Course& course : all) {
    course.scene.name += ", at rest, " + std::to_string(std::lround(rate)) + " Hz";
    course.scene.rate = rate;
    course.push = {0, 0, -kPushed};
    course.steps = static_cast<std::size_t>(rate);
  }
  return all;
}

Courses drops() {
  return {falling(on_box(kLarge, 0.05, 0.03)), falling(on_mesh("a floor", kFlat, kUsual, kLarge, 0, 0)),
          falling(on_mesh("a floor", kFlat, kUsual, kSmall, 0.05, 0.03)),
          falling(on_mesh("a plate of 2 mm", kPlate, kCoarse, kLarge, 0.05, 0.03)),
          falling(on_mesh("a plate of 2 mm", kPlate, kCoarse, kSmall, 0.05, 0.03))};
}

Courses leaves() {
  const Course floor = on_mesh("a floor", kFlat, kUsual, kLarge, 0.05, 0.03), box = on_box(kLarge, 0.05, 0.03);
  return {leaving(box, kSpeed, 0), leaving(floor, kSpeed, 0), leaving(floor, 0.1 * kSpeed, 0), leaving(floor, 0, 2 * kPushed)};
}

Courses obstacles() {
  Courses all;
  for (const double radius : {kLarge, kSmall})
    for (const auto& [name, profile] :
         {std::pair{"a ridge", &kRidge}, {"a step up", &kStepUp}, {"a step down", &kStepDown}, {"a plate of 2 mm", &kPlate}})
      all.push_back(sliding(on_mesh(name, *profile, kCoarse, radius, -0.3, kBeside)));
  return all;
}

Courses meetings() {
  Courses all;
  const auto add = [&](const std::string& name, double x, double y, const auto& ground) {
    const Course course = on(name, kFlat, kLarge, x, y);
    for (Course one : {sliding(course), course, falling(course)}) {
      if (!one.scene.velocity.isZero(0)) one.scene.position.x() -= 0.3;
      one.scene.name += one.scene.velocity.isZero(0) ? "" : ", across";
      ground(one.scene);
      all.push_back(std::move(one));
    }
  };
  add("a book", 0, kBeside, [](Simulation& scene) { scene.ground = open_book(); });
  add("two boxes side by side", 0, kBeside, [](Simulation& scene) { scene.ground = floor_of_boxes(); });
  add("a floor", 0, kBeside, [](Simulation& scene) {
    scene.ground = mesh_of(kFlat, kUsual);
    scene = doubled(scene);
  });
  add("a floor", 0, 0.075, [](Simulation& scene) {
    scene.ground = mesh_of(kFlat, kUsual);
    scene = split(scene);
  });
  return all;
}

Courses all_courses() {
  return joined(slides(), rests(), drops(), leaves(), obstacles());
}

}  // namespace forceshade::conformance::simulators
