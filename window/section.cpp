// SPDX-License-Identifier: BSD-3-Clause
#include "window/section.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "text/formatted.h"
#include "window/composition.h"

namespace forceshade::window {
namespace {

constexpr Colour kInside{0.443F, 0.525F, 0.596F}, kBorder{0.176F, 0.239F, 0.298F};

double finite(double value, double low, double high) {
  return std::isfinite(value) ? std::clamp(value, low, high) : low;
}

// The part of a window in which a region is shown.
Rectangle room_for_a_section(Size window) {
  const double margin = 0.05 * window.height;
  return {margin, 0.13 * window.height, window.width - margin, 0.76 * window.height};
}

class SectionPicture : private Composition {
 public:
  SectionPicture(const SectionScene& scene, Size window, const Measure& measure)
      : Composition(measure), scene_(scene), window_(window), view_(scene.region, window), body_(text_size(window)) {}

  Picture made() && {
    add(Box{view_.area(), 0, kPanel, {}, 0});
    picture_.scene = view_.area();
    draw_inside();
    for (const auto& [a, b] : scene_.section.border)
      add(Line{{view_.pixel(a.x, a.z), view_.pixel(b.x, b.z)}, kBorder, std::max(1.5, window_.height / 400)});
    draw_felt_shape();
    if (scene_.felt) draw_felt(*scene_.felt);
    draw_scales();
    draw_words();
    return std::move(picture_);
  }

 private:
  // Between two columns that are cut into as many stretches.
  void draw_inside() {
    Triangles inside;
    const auto& columns = scene_.section.columns;
    for (std::size_t i = 1; i < columns.size(); ++i) {
      const Column &a = columns[i - 1], &b = columns[i];
      for (std::size_t k = 0; k < std::min(a.inside.size(), b.inside.size()); ++k) {
        const std::array<Point, 4> corners{view_.pixel(a.x, a.inside[k].low), view_.pixel(b.x, b.inside[k].low),
                                           view_.pixel(b.x, b.inside[k].high), view_.pixel(a.x, a.inside[k].high)};
        for (const std::size_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) inside.vertices.push_back({corners[corner], kInside});
      }
    }
    add(std::move(inside));
  }

  Point pixel_within(const Position& p) const {
    const Region& r = scene_.region;
    return view_.pixel(finite(p.x, r.left, r.right), finite(p.z, r.bottom, r.top));
  }

  // Every other dash, by the length along the shape.
  void draw_felt_shape() {
    const double dash = window_.height / 50;
    double length = 0;
    for (const auto& [a, b] : scene_.section.felt) {
      const Point from = view_.pixel(a.x, a.z), to = view_.pixel(b.x, b.z);
      if (std::fmod(length, 2 * dash) < dash) add(Line{{from, to}, kFeltShape, window_.height / 200});
      length += std::hypot(to.x - from.x, to.y - from.y);
    }
  }

  void draw_intended(const ProfilePoint& place, Point tip, double radius) {
    const Point at = pixel_within({place.x, 0, place.z});
    add(Line{{at, tip}, kIntended, radius / 6});
    for (const double slant : {-1.0, 1.0})
      add(Line{{{at.x - radius, at.y - slant * radius}, {at.x + radius, at.y + slant * radius}}, kIntended, radius / 4});
  }

  void draw_felt(const Felt& felt) {
    const Point tip = pixel_within(felt.tip);
    const double radius = window_.height / 70;
    if (scene_.intended) draw_intended(*scene_.intended, tip, radius);
    if (felt.god_object) {
      const Point rest = pixel_within(*felt.god_object);
      add(Line{{tip, rest}, kWhite, radius / 3});
      add(Ellipse{rest, 1.3 * radius, 1.3 * radius, kGodObject});
      add(Ellipse{rest, 0.9 * radius, 0.9 * radius, kWhite});
    }
    draw_arrow(tip, felt.force[0], felt.force[2]);
    add_tip(tip, radius);
  }

  void draw_arrow(Point from, double x, double z) {
    const double size = std::hypot(x, z), length = std::min(size, kLongestArrow) * arrow_scale(window_);
    const double head = window_.height / 45, width = head / 3;
    if (!(length > head)) return;
    const Point along{x / size, -z / size}, across{-along.y, along.x};
    const auto at = [&](double forward, double aside) {
      return Point{from.x + forward * along.x + aside * across.x, from.y + forward * along.y + aside * across.y};
    };
    add(Line{{from, at(length - head / 2, 0)}, kAccent, width});
    add(Triangles{{{at(length, 0), kAccent}, {at(length - head, head / 2), kAccent}, {at(length - head, -head / 2), kAccent}}});
  }

  // Draws the lengths of 1 N and 10 mm at the top right of the section.
  void draw_scales() {
    const double size = 0.7 * body_, right = view_.area().right - body_;
    double top = view_.area().top + 0.6 * body_;
    for (const auto& [words, length] :
         {std::pair("1 N", arrow_scale(window_)), std::pair("10 mm", 10 * view_.pixels_per_mm())}) {
      const double y = top + line(size) / 2;
      add(Line{{{right - length, y}, {right, y}}, words[2] == 'N' ? kAccent : kInk, std::max(2.0, size / 6)});
      add_line(words, right - length - 0.6 * size, top, size, kInk, Align::right);
      top += line(size);
    }
  }

  void draw_words() {
    const double margin = 0.05 * window_.height, right = window_.width - margin;
    double room = right - margin;
    if (scene_.felt) {
      const auto& [x, y, z] = scene_.felt->force;
      const std::string words = formatted("y = %.1f mm   force %.2f N", scene_.felt->tip.y, std::hypot(x, y, z));
      add_line(words, right, margin, body_, kInk, Align::right);
      room -= measure_.width(words, body_) + body_;
    }
    add_lines(fitted(scene_.title, room, line(1.1 * body_), 1.1 * body_, measure_), margin, margin, kInk);
    double top = view_.area().bottom + 0.5 * body_;
    const double height = window_.height - 0.5 * margin - top;
    for (const std::string& words : scene_.words) {
      const Fitted text =
          fitted(words, right - margin, height / static_cast<double>(scene_.words.size()), 0.85 * body_, measure_);
      add_lines(text, margin, top, kInk);
      top += text.height();
    }
  }

  const SectionScene& scene_;
  const Size window_;
  const SectionView view_;
  const double body_;
};

}  // namespace

SectionView::SectionView(const Region& region, Size window) : region_(region) {
  const Rectangle room = room_for_a_section(window);
  const double width = region.right - region.left, height = region.top - region.bottom;
  scale_ = std::min(room.width() / width, room.height() / height);
  const double left = (room.left + room.right - scale_ * width) / 2, top = (room.top + room.bottom - scale_ * height) / 2;
  area_ = {left, top, left + scale_ * width, top + scale_ * height};
}

double arrow_scale(Size window) {
  return 0.1 * window.height;
}

Picture picture_of(const SectionScene& scene, Size window, const Measure& measure) {
  return SectionPicture(scene, window, measure).made();
}

}  // namespace forceshade::window
