// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A frame of the participant's window, as data: what layout.h makes and a window only draws. Pixels from the top left corner.

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace forceshade::window {

struct Point {
  double x = 0, y = 0;
};

struct Size {
  double width = 0, height = 0;
};

struct Rectangle {
  double left = 0, top = 0, right = 0, bottom = 0;

  double width() const { return right - left; }
  double height() const { return bottom - top; }
  bool contains(Point p) const { return left <= p.x && p.x <= right && top <= p.y && p.y <= bottom; }
};

struct Colour {
  float red = 0, green = 0, blue = 0, alpha = 1;

  bool operator==(const Colour&) const = default;
};

struct Vertex {
  Point at;
  Colour colour;
};

// Three vertices a triangle, the colours blended between them.
struct Triangles {
  std::vector<Vertex> vertices;
};

struct Line {
  std::vector<Point> points;
  Colour colour;
  double width = 1;
};

struct Ellipse {
  Point centre;
  double radius_x = 0, radius_y = 0;
  Colour colour;
};

struct Box {
  Rectangle area;
  double corner = 0;  // radius
  Colour fill;
  Colour border;
  double border_width = 0;
};

// One line of UTF-8.
struct Text {
  Point at;         // the top left corner of its line
  double size = 0;  // the height of the font
  Colour colour;
  std::string words;
};

using Item = std::variant<Triangles, Line, Ellipse, Box, Text>;

struct Picture {
  Colour background;
  std::vector<Item> items;         // drawn in this order
  std::optional<Rectangle> scene;  // the area in which the two bumps are or would be shown
  std::optional<Point> cursor;     // the centre of what is drawn for the tip
};

}  // namespace forceshade::window
