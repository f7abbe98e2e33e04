// SPDX-License-Identifier: BSD-3-Clause
#include "tests/window/drawn_canvas.h"

#include <algorithm>
#include <utility>

#include "system/system.h"
#include "tests/window/even_font.h"
#include "tests/window/filled.h"

namespace forceshade::window {
namespace {

constexpr std::int64_t kFrame = system::kSecond / 60;

Person* the_person = nullptr;

Size size_of(const Settings& settings) {
  return {static_cast<double>(settings.width), static_cast<double>(settings.height)};
}

}  // namespace

Person::Person() : before_(std::exchange(the_person, this)) {}

Person::~Person() {
  the_person = before_;
}

Person& Person::at(double seconds) {
  time_ = static_cast<std::int64_t>(seconds * static_cast<double>(system::kSecond));
  return *this;
}

Person& Person::add(std::function<void(Person&)> act) {
  const auto later = std::ranges::find_if(acts_, [&](const Act& other) { return other.time > time_; });
  acts_.insert(later, {time_, std::move(act)});
  return *this;
}

Person& Person::key(const std::string& name, bool is_repeat) {
  return add([name, is_repeat](Person& self) { self.keys_.push_back({name, is_repeat}); });
}

Person& Person::point(Point pixel) {
  return add([pixel](Person& self) { self.pointer_ = pixel; });
}

Person& Person::leave() {
  return add([](Person& self) { self.pointer_.reset(); });
}

Person& Person::close() {
  return add([](Person& self) { self.has_closed_ = true; });
}

void Person::act(std::int64_t since_the_opening) {
  while (!acts_.empty() && acts_.front().time <= since_the_opening) {
    acts_.front().does(*this);
    acts_.erase(acts_.begin());
  }
}

Image Person::image() const {
  return filled(picture_, size_of(settings_));
}

class Canvas::Display {
 public:
  std::int64_t opened = system::now(), next = opened;
  std::string note;
};

Canvas::Canvas(const Settings& settings) {
  if (the_person == nullptr) throw Error("no person is in front of the window");
  the_person->settings_ = settings;
  the_person->has_closed_ = false;
  display_ = std::make_unique<Display>();
}

Canvas::~Canvas() = default;

bool Canvas::draw(Drawing drawing) {
  the_person->act(system::now() - display_->opened);
  if (the_person->has_closed_) return false;
  the_person->picture_ = drawing(size(), EvenFont());
  display_->next = std::max(display_->next + kFrame, system::now());
  system::sleep_until(display_->next);
  ++the_person->frames_;
  the_person->sees(the_person->picture_);
  return true;
}

std::vector<Key> Canvas::keys() {
  return std::exchange(the_person->keys_, {});
}

std::optional<Point> Canvas::pointer() const {
  return the_person->pointer_;
}

Size Canvas::size() const {
  return size_of(the_person->settings_);
}

Image Canvas::pixels() {
  return the_person->image();
}

const std::string& Canvas::note() const {
  return display_->note;
}

bool Canvas::is_available() noexcept {
  return true;
}

}  // namespace forceshade::window
