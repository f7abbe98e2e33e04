// SPDX-License-Identifier: BSD-3-Clause
#include "study/window/layout.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "study/window/view.h"
#include "window/composition.h"

namespace forceshade::window {
namespace {

constexpr Colour kShadow{0.10F, 0.14F, 0.18F, 0.35F};

constexpr double kTipRadius = 1.3;  // mm

// In which the lines of longer texts are: some 70 characters, in sizes of the body.
constexpr double kColumn = 36;

class Layout : private Composition {
 public:
  Layout(const Screen& screen, const Scene& scene, const Look& look, Size window, const Measure& measure)
      : Composition(measure),
        screen_(screen),
        scene_(scene),
        look_(look),
        window_(window),
        body_(text_size(window) * look.text_scale),
        label_(std::min({body_, window.height / 26, window.width / 34})),
        margin_(0.05 * window.height) {}

  Picture made() && {
    switch (screen_.kind) {
      case ScreenKind::text:
      case ScreenKind::end: draw_text_page(); break;
      case ScreenKind::matching: draw_matching(); break;
      case ScreenKind::satisfaction: draw_satisfaction(); break;
      case ScreenKind::classification: draw_classification(); break;
      case ScreenKind::question: draw_question(); break;
    }
    return std::move(picture_);
  }

 private:
  // The number of the trial at the right; the title in the rest.
  void draw_header() {
    double right = window_.width - margin_;
    if (screen_.trials > 0) {
      const std::string which =
          look_.labels.trial + " " + std::to_string(screen_.trial) + " / " + std::to_string(screen_.trials);
      add_line(which, right, margin_, label_, kMuted, Align::right);
      right -= measure_.width(which, label_) + label_;
    }
    if (screen_.is_practice) {
      const double size = 0.85 * label_, width = measure_.width(look_.labels.practice, size) + 1.2 * size;
      const double top = margin_ + (line(label_) - line(size)) / 2;
      add(Box{{right - width, top - 0.1 * size, right, top + line(size)}, 0.4 * size, kAccent, {}, 0});
      add_line(look_.labels.practice, right - width / 2, top, size, kWhite, Align::centre);
      right -= width + label_;
    }
    const double bottom = scene_area(window_).top - 0.3 * label_;
    const Fitted title = fitted(screen_.title, right - margin_, bottom - margin_, 1.25 * label_, measure_);
    add_lines(title, margin_, margin_ - 0.15 * title.size, kInk);
  }

  double bottom_of_text() const { return window_.height - margin_; }

  void draw_text_page() {
    const double width = std::min(window_.width - 2 * margin_, kColumn * body_), left = (window_.width - width) / 2;
    const double title_room = 0.25 * window_.height;
    const Fitted title = screen_.title.empty() ? Fitted{} : fitted(screen_.title, width, title_room, 1.5 * body_, measure_);
    const double gap = screen_.title.empty() ? 0 : 0.8 * body_;
    const Fitted text = fitted(screen_.text, width, bottom_of_text() - margin_ - title.height() - gap, body_, measure_);
    const double height = title.height() + gap + text.height();
    const double top = std::max(margin_, (bottom_of_text() - height) * 0.42);
    add_lines(title, left, top, kInk);
    add_lines(text, left, top + title.height() + gap, kInk);
  }

  // Between a picture and what is at the bottom, in the middle.
  void draw_text_between(double above, double bottom) {
    if (screen_.text.empty()) return;
    const double top = above + 0.5 * label_;
    const double width = std::min(window_.width - 2 * margin_, kColumn * body_);
    const Fitted text = fitted(screen_.text, width, bottom - top, body_, measure_);
    add_lines(text, window_.width / 2, top + (bottom - top - text.height()) * 0.4, kInk, Align::centre);
  }

  void draw_matching() {
    draw_header();
    const Rectangle area = scene_area(window_);
    picture_.scene = area;
    add(Box{area, 0, kPanel, {}, 0});
    if (screen_.shows_scene) draw_bumps(area);
    draw_text_between(area.bottom, bottom_of_text());
  }

  void draw_bumps(const Rectangle& area) {
    const View view(scene_, area);
    std::vector<ProfilePoint> both{{-view.extent(), 0}};
    const auto bump = profile(Shape::cylinder, scene_.width, drawn_radius(scene_.width), scene_.width);
    for (const double centre : {-scene_.separation / 2, scene_.separation / 2})
      for (std::size_t i = 1; i + 1 < bump.size(); ++i) both.push_back({centre + bump[i].x, bump[i].z});
    both.push_back({view.extent(), 0});
    const Solid solid{.depth = kSceneDepth,
                      .thickness = kSlabThickness,
                      .edge = std::max(1.0, view.pixels_per_mm() / 8),
                      .pixel = [&](const Position& p) { return view.pixel(p); }};
    for (Item& item : drawn_out(both, solid)) add(std::move(item));
    const double size = std::min(0.9 * label_, 3.4 * view.pixels_per_mm()),
                 room = 0.9 * scene_.separation * view.pixels_per_mm();
    const double top = view.pixel({0, -kSceneDepth / 2, -kSlabThickness}).y + 0.35 * size;
    const auto name = [&](const std::string& words, double x) {
      add_lines(fitted(words, room, line(size), size, measure_), view.pixel({x, 0, 0}).x, top, kInk, Align::centre);
    };
    name(look_.labels.reference, -scene_.separation / 2);
    name(look_.labels.matching, scene_.separation / 2);
    if (scene_.tip) draw_tip(view, area);
  }

  // A ball that rests on its point of the surface, with its shadow there. Beyond the drawn part of the plane it stays at its
  // rim.
  void draw_tip(const View& view, const Rectangle& area) {
    const auto within = [](double value, double limit) { return std::isfinite(value) ? std::clamp(value, -limit, limit) : 0; };
    Position tip = *scene_.tip;
    tip.x = within(tip.x, view.extent() - kTipRadius);
    tip.y = within(tip.y, kSceneDepth / 2);
    if (std::isnan(tip.z)) tip.z = 0;
    const double ground = drawn_height(scene_, tip.x);
    const Position drawn = drawn_cursor(tip, scene_.felt_height, ground);
    const double radius = kTipRadius * view.pixels_per_mm();
    const double above = std::clamp((drawn.z - ground) / 20, 0.0, 1.0);  // a shadow widens and fades with height
    Colour shadow = kShadow;
    shadow.alpha *= static_cast<float>(1 - 0.75 * above);
    add(Ellipse{view.pixel({drawn.x, drawn.y, ground}), radius * (1 + above), 0.45 * radius * (1 + above), shadow});
    Point centre = view.pixel(drawn);
    centre.y = std::max(area.top + radius, centre.y - radius);
    add_tip(centre, radius);
  }

  // Draws the typed text in the middle, above the keys.
  void draw_entry() {
    const double size = 1.3 * label_, width = 4 * size, bottom = bottom_of_text(), top = bottom - line(size) - 0.5 * size;
    const double x = window_.width / 2;
    add(Box{{x - width / 2, top, x + width / 2, bottom}, 0.25 * size, kWhite, kAccent, std::max(1.5, size / 14)});
    const Fitted entry = fitted(screen_.entry, 0.9 * width, line(size), size, measure_);
    add_line(entry.lines[0], x, top + 0.25 * size + (line(size) - line(entry.size)) / 2, entry.size, kInk, Align::centre);
    if (entry.lines[0].empty()) draw_caret(x, top + 0.25 * size, size);
  }

  void draw_caret(double x, double top, double size) {
    add(Line{{{x, top + 0.15 * size}, {x, top + 1.2 * size}}, kAccent, std::max(1.5, size / 12)});
  }

  double top_of_entry() const { return bottom_of_text() - 1.3 * label_ * (kLineHeight + 0.5) - 0.5 * label_; }

  // Smaller than a scene, for the entry is under it.
  Rectangle area_of_answers() const {
    Rectangle area = scene_area(window_);
    area.bottom = 0.64 * window_.height;
    return area;
  }

  void draw_satisfaction() {
    draw_header();
    const Rectangle area = area_of_answers();
    const double side = std::min(area.width() / 14, area.height() / 4), gap = side / 4, all = 10 * side + 9 * gap;
    const double left = (window_.width - all) / 2, top = area.top + (area.height() - side) * 0.45;
    const double size = std::min(1.2 * label_, 0.5 * side);
    for (int i = 0; i < 10; ++i) {
      const std::string number = std::to_string(i + 1);
      const bool is_chosen = screen_.entry == number;
      const double x = left + i * (side + gap);
      add(Box{{x, top, x + side, top + side},
              side / 8,
              is_chosen ? kAccent : kWhite,
              is_chosen ? kAccent : kMuted,
              std::max(1.0, side / 40)});
      add_line(number, x + side / 2, top + (side - line(size)) / 2, size, is_chosen ? kWhite : kInk, Align::centre);
    }
    const double words_top = top + side + 0.5 * label_, room = area.bottom - words_top;
    add_lines(fitted(look_.labels.different, 0.48 * all, room, 0.9 * label_, measure_), left, words_top, kMuted);
    add_lines(fitted(look_.labels.same, 0.48 * all, room, 0.9 * label_, measure_), left + all, words_top, kMuted, Align::right);
    draw_text_between(area.bottom, top_of_entry());
    draw_entry();
  }

  void draw_classification() {
    draw_header();
    const Rectangle area = area_of_answers();
    const double gap = area.width() / 50, width = (area.width() - 3 * gap) / 4;
    const double height = std::min(area.height(), 1.15 * width), top = area.top + (area.height() - height) / 2;
    for (std::size_t i = 0; i < kShapes.size(); ++i) {
      const double left = area.left + static_cast<double>(i) * (width + gap);
      draw_card(kShapes[i], std::to_string(i + 1), {left, top, left + width, top + height});
    }
    if (scene_.shows_tip_alone && scene_.tip)
      draw_tip_alone({area.left, area.bottom, area.right, top_of_entry()});
    else
      draw_text_between(area.bottom, top_of_entry());
    draw_entry();
  }

  // Draws the tip over the line z = 0, in a strip that is as wide as the scene. The text of the screen gives way to it.
  void draw_tip_alone(const Rectangle& strip) {
    const View view(scene_, window_);
    const double radius = 0.8 * kTipRadius * view.pixels_per_mm(), inset = 0.5 * label_;
    const Rectangle area{strip.left, strip.top + inset, strip.right, strip.bottom - inset};
    add(Box{area, 0, kPanel, {}, 0});
    const double plane = area.bottom - 0.25 * area.height();
    add(Line{{{area.left, plane}, {area.right, plane}}, kRule, 1.5});
    const auto finite = [](double value) { return std::isfinite(value) ? value : 0; };
    const Point at = view.pixel({finite(scene_.tip->x), 0, 0});
    const Point centre{
        std::clamp(at.x, area.left + radius, area.right - radius),
        std::clamp(plane - finite(scene_.tip->z) * view.pixels_per_mm(), area.top + radius, area.bottom - radius)};
    add(Ellipse{centre, radius, radius, kCursor});
    picture_.cursor = centre;
  }

  // The bumps of the pictures are steeper than those of the scene, so that their faces can be distinguished at once.
  void draw_card(Shape shape, const std::string& number, const Rectangle& card) {
    const bool is_chosen = screen_.entry == number;
    add(Box{card, card.width() / 24, kWhite, is_chosen ? kAccent : kRule,
            is_chosen ? card.width() / 48 : std::max(1.0, card.width() / 160)});
    constexpr double kWidth = 25.4, kRadius = 15.24, kExtent = 20, kDepth = 22, kSine = 0.4067366430758002;
    const double scale = 0.88 * card.width() / (2 * kExtent), x = (card.left + card.right) / 2,
                 y = card.top + 0.50 * card.height();
    const Solid solid{.depth = kDepth,
                      .thickness = kSlabThickness,
                      .edge = std::max(1.0, scale / 5),
                      .has_ridges = shape != Shape::cylinder && shape != Shape::plane,
                      .pixel = [&](const Position& p) {
                        return Point{x + scale * p.x, y - scale * (p.z + kSine * p.y)};
                      }};
    for (Item& item : drawn_out(profile(shape, kWidth, kRadius, kExtent), solid)) add(std::move(item));
    const double size = std::min(1.4 * label_, 0.16 * card.height());
    add_line(number, x, card.bottom - 1.35 * line(size) + 0.2 * size, size, is_chosen ? kAccent : kInk, Align::centre);
  }

  void draw_question() {
    const double width = std::min(window_.width - 2 * margin_, kColumn * body_), left = (window_.width - width) / 2;
    const Fitted title =
        screen_.title.empty() ? Fitted{} : fitted(screen_.title, width, 0.2 * window_.height, 1.25 * body_, measure_);
    const double gap = 0.6 * body_;
    const double question_top = margin_ + title.height() + (screen_.title.empty() ? 0 : gap);
    const Fitted question = fitted(screen_.text, width, 0.55 * window_.height - question_top, body_, measure_);
    add_lines(title, left, margin_, kInk);
    add_lines(question, left, question_top, kInk);
    const Rectangle box{left, question_top + question.height() + gap, left + width, bottom_of_text()};
    add(Box{box, 0.25 * body_, kWhite, kAccent, std::max(1.5, body_ / 14)});
    draw_answer(box);
  }

  // The last lines of a long answer: those that are being written.
  void draw_answer(const Rectangle& box) {
    const double size = std::min(body_, box.height() / 5), inset = 0.5 * size;
    std::vector<std::string> lines = wrapped(screen_.entry, box.width() - 2 * inset, size, measure_);
    const auto room = static_cast<std::size_t>(std::max(1.0, std::floor((box.height() - 2 * inset) / line(size))));
    if (lines.size() > room) lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(room));
    double top = box.top + inset;
    for (const std::string& words : lines) {
      add_line(words, box.left + inset, top, size, kInk);
      top += line(size);
    }
    draw_caret(box.left + inset + measure_.width(lines.back(), size) + 2, top - line(size), size);
  }

  const Screen& screen_;
  const Scene& scene_;
  const Look& look_;
  const Size window_;
  const double body_, label_;  // of running text; of labels, which have a place of limited size
  const double margin_;
};

constexpr Colour kLit{0.867F, 0.894F, 0.914F}, kShade{0.357F, 0.435F, 0.506F};
constexpr Colour kCut{0.443F, 0.525F, 0.596F};
constexpr Colour kFrontEdge{0.176F, 0.239F, 0.298F}, kBackEdge{0.541F, 0.612F, 0.671F}, kRidge{0.318F, 0.396F, 0.463F};

Colour blend(Colour from, Colour to, double share) {
  const auto between = [&](float a, float b) { return static_cast<float>(a + share * (b - a)); };
  return {between(from.red, to.red), between(from.green, to.green), between(from.blue, to.blue)};
}

// The colour of a face that climbs by `rise` over `run`. Light comes from 50 degrees to the left of the vertical, so that a
// plane is of a middle shade, the left flank of a bump brighter and its right flank darker.
Colour shade(double rise, double run) {
  const double light = std::cos(std::atan2(rise, run) - 0.87);
  return blend(kShade, kLit, std::fmin(1, std::fmax(0, light)));
}

void add_quadrangle(Triangles& triangles, const std::array<Vertex, 4>& corners) {
  for (const int i : {0, 1, 2, 0, 2, 3}) triangles.vertices.push_back(corners[static_cast<std::size_t>(i)]);
}

}  // namespace

Picture picture_of(const Screen& screen, const Scene& scene, const Look& look, Size window, const Measure& measure) {
  return Layout(screen, scene, look, window, measure).made();
}

std::vector<Item> drawn_out(std::span<const ProfilePoint> profile, const Solid& solid) {
  const double front = -solid.depth / 2, back = solid.depth / 2;
  Triangles faces;
  Line near{{}, kFrontEdge, 1.5 * solid.edge}, far{{}, kBackEdge, solid.edge};
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const ProfilePoint b = profile[i];
    const Point near_b = solid.pixel({b.x, front, b.z}), far_b = solid.pixel({b.x, back, b.z});
    near.points.push_back(near_b);
    far.points.push_back(far_b);
    if (i == 0) continue;
    const ProfilePoint a = profile[i - 1];
    const Point near_a = near.points[i - 1], far_a = far.points[i - 1];
    const Colour colour = shade(b.z - a.z, b.x - a.x);
    add_quadrangle(faces, {{{near_a, colour}, {far_a, colour}, {far_b, colour}, {near_b, colour}}});
    add_quadrangle(faces, {{{near_a, kCut},
                            {near_b, kCut},
                            {solid.pixel({b.x, front, -solid.thickness}), kCut},
                            {solid.pixel({a.x, front, -solid.thickness}), kCut}}});
  }
  std::vector<Item> items{faces};
  for (std::size_t i = 1; solid.has_ridges && i + 1 < profile.size(); ++i)
    items.emplace_back(Line{{near.points[i], far.points[i]}, kRidge, solid.edge});
  items.emplace_back(far);
  items.emplace_back(near);
  return items;
}

}  // namespace forceshade::window
