// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A canvas of a simulated world: its display refreshes sixty times a second of the world's clock, and its pictures are kept
// instead of shown. Link drawn_canvas.cpp before forceshade_window, and who opens a window in the test gets this one.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "window/canvas.h"

namespace forceshade::window {

// Somebody in front of the window: what they do at which time, and what they see. A window is for whoever came last.
class Person {
 public:
  Person();
  ~Person();
  Person(const Person&) = delete;
  Person& operator=(const Person&) = delete;

  // Delays what follows until so many seconds after the window was opened; it is done now where that is over.
  Person& at(double seconds);
  Person& key(const std::string& name, bool is_repeat = false);
  Person& point(Point pixel);
  Person& leave();  // with the mouse
  Person& close();

  // Called with each frame once it is seen.
  std::function<void(const Picture&)> sees = [](const Picture&) {};

  // The last frame that was shown, and how many were.
  const Picture& picture() const noexcept { return picture_; }
  int frames() const noexcept { return frames_; }
  Image image() const;

 private:
  friend class Canvas;
  struct Act {
    std::int64_t time;  // ns
    std::function<void(Person&)> does;
  };
  Person& add(std::function<void(Person&)> act);
  // Does all that was due up to now.
  void act(std::int64_t since_the_opening);

  std::vector<Act> acts_;
  std::int64_t time_ = 0;
  std::vector<Key> keys_;
  std::optional<Point> pointer_;
  bool has_closed_ = false;
  Settings settings_;
  Picture picture_;
  int frames_ = 0;
  Person* const before_;
};

}  // namespace forceshade::window
