// SPDX-License-Identifier: BSD-3-Clause
#include "tests/window/filled.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace forceshade::window {
namespace {

double cross(Point a, Point b, Point p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

double squared(double value) {
  return value * value;
}

class Filling {
 public:
  Filling(Image& image) : image_(image) {}

  void operator()(const Triangles& triangles) {
    for (std::size_t i = 0; i + 2 < triangles.vertices.size(); i += 3)
      triangle({triangles.vertices[i], triangles.vertices[i + 1], triangles.vertices[i + 2]});
  }
  void operator()(const Line& line) {
    const double half = line.width / 2;
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
      const Point a = line.points[i], b = line.points[i + 1];
      const double length = std::hypot(b.x - a.x, b.y - a.y);
      if (length > 0)
        fill(around({a, b}, half), [&](Point p) -> std::optional<Colour> {
          const double along = ((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / length;
          if (along < 0 || along > length || std::fabs(cross(a, b, p)) > half * length) return std::nullopt;
          return line.colour;
        });
      if (i > 0) (*this)(Ellipse{a, half, half, line.colour});
    }
  }
  void operator()(const Ellipse& ellipse) {
    const Point c = ellipse.centre;
    const double x = ellipse.radius_x, y = ellipse.radius_y;
    fill({c.x - x, c.y - y, c.x + x, c.y + y}, [&](Point p) -> std::optional<Colour> {
      if (squared((p.x - c.x) / x) + squared((p.y - c.y) / y) > 1) return std::nullopt;
      return ellipse.colour;
    });
  }
  void operator()(const Box& box) {
    fill(box.area, [&](Point p) { return is_in(box.area, box.corner, p) ? std::optional(box.fill) : std::nullopt; });
    const double half = box.border_width / 2;
    if (half <= 0) return;
    const auto grown = [&](double by) {
      return Rectangle{box.area.left - by, box.area.top - by, box.area.right + by, box.area.bottom + by};
    };
    const Rectangle outer = grown(half), inner = grown(-half);
    fill(outer, [&](Point p) {
      const bool is_border = is_in(outer, box.corner + half, p) && !is_in(inner, std::max(0.0, box.corner - half), p);
      return is_border ? std::optional(box.border) : std::nullopt;
    });
  }
  void operator()(const Text&) {}

 private:
  static Rectangle around(const std::array<Point, 2>& ends, double by) {
    return {std::min(ends[0].x, ends[1].x) - by, std::min(ends[0].y, ends[1].y) - by, std::max(ends[0].x, ends[1].x) + by,
            std::max(ends[0].y, ends[1].y) + by};
  }

  static bool is_in(const Rectangle& area, double corner, Point p) {
    if (!area.contains(p)) return false;
    const double x = std::max({area.left + corner - p.x, p.x - area.right + corner, 0.0}),
                 y = std::max({area.top + corner - p.y, p.y - area.bottom + corner, 0.0});
    return squared(x) + squared(y) <= squared(corner) || x == 0 || y == 0;
  }

  void triangle(const std::array<Vertex, 3>& v) {
    const double area = cross(v[0].at, v[1].at, v[2].at);
    if (area == 0) return;
    const auto [left, right] = std::minmax({v[0].at.x, v[1].at.x, v[2].at.x});
    const auto [top, bottom] = std::minmax({v[0].at.y, v[1].at.y, v[2].at.y});
    fill({left, top, right, bottom}, [&](Point p) -> std::optional<Colour> {
      std::array<double, 3> share;
      for (std::size_t i = 0; i < 3; ++i) share[i] = cross(v[(i + 1) % 3].at, v[(i + 2) % 3].at, p) / area;
      if (*std::ranges::min_element(share) < 0) return std::nullopt;
      const auto blended = [&](auto member) {
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) sum += share[i] * static_cast<double>(v[i].colour.*member);
        return static_cast<float>(sum);
      };
      return Colour{blended(&Colour::red), blended(&Colour::green), blended(&Colour::blue), blended(&Colour::alpha)};
    });
  }

  // colour_at: nothing where the item is not.
  void fill(const Rectangle& area, auto colour_at) {
    const auto pixel = [](double at, int most) { return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(most))); };
    const int right = pixel(std::ceil(area.right), image_.width), bottom = pixel(std::ceil(area.bottom), image_.height);
    for (int y = pixel(std::floor(area.top), image_.height); y < bottom; ++y)
      for (int x = pixel(std::floor(area.left), image_.width); x < right; ++x)
        if (const std::optional<Colour> colour = colour_at(Point{x + 0.5, y + 0.5})) put(x, y, *colour);
  }

  void put(int x, int y, const Colour& colour) {
    std::uint8_t* bytes =
        &image_.bytes[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) + static_cast<std::size_t>(x))];
    const std::array<float, 3> rgb{colour.red, colour.green, colour.blue};
    for (std::size_t i = 0; i < 3; ++i) {
      const float before = static_cast<float>(bytes[i]);
      bytes[i] = static_cast<std::uint8_t>(std::lround(before + colour.alpha * (255 * rgb[i] - before)));
    }
  }

  Image& image_;
};

}  // namespace

Image filled(const Picture& picture, Size size) {
  Image image{static_cast<int>(size.width), static_cast<int>(size.height), {}};
  image.bytes.resize(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  Filling filling(image);
  filling(Box{{0, 0, size.width, size.height}, 0, picture.background, {}, 0});
  for (const Item& item : picture.items) std::visit(filling, item);
  return image;
}

}  // namespace forceshade::window
