// SPDX-License-Identifier: BSD-3-Clause
#include "report/mesh_picture.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "report/panels.h"
#include "report/pictures.h"
#include "text/number_text.h"

namespace forceshade::properties {
namespace {

constexpr int kWidth = 620, kTallest = 560, kMargin = 10,
              kFoot = 34;  // px: of the picture, of the mesh, around it, of the foot
constexpr int kPerPixel =
    4;  // samples along a px: PNG files have two of their own, and each of these is a mean of four samples
constexpr std::size_t kForces = 40;
constexpr double kForceShare = 0.12;  // of the picture's width: the longest force

// The colours of samples that have been drawn without values.
constexpr const char* kBrightness =
    "set palette defined (-1 '#ffffff', -0.9 '#f6dcc4', -0.3 '#a3703f', 0 '#3a2410', 0 '#16283a', 0.3 '#5c7f9e', 0.9 "
    "'#dce7f1', 1 "
    "'#ffffff')\nset cbrange [-1:1]\n";

constexpr const char *kDevice = "#d55e00", *kGodObject = "#111111", *kForce = "#009e73";

// A force, from the god-object.
struct Arrow {
  Eigen::Vector3d from, by;  // turned, mm
  double newtons;
};

bool is_touching(const Ticked& ticked) {
  return finished(ticked.tick.status) == Status::contact;
}

class Box {
 public:
  void add(const Eigen::Vector3d& point) {
    low_ = low_.cwiseMin(point);
    high_ = high_.cwiseMax(point);
  }
  Eigen::Vector3d low() const { return low_; }
  Eigen::Vector3d size() const { return high_ - low_; }

 private:
  Eigen::Vector3d low_ = Eigen::Vector3d::Constant(INFINITY), high_ = Eigen::Vector3d::Constant(-INFINITY);
};

// Lines of points, turned; empty where a line is interrupted.
using Line = std::vector<std::optional<Eigen::Vector3d>>;

// The visible and the hidden parts of lines, as two blocks for gnuplot. A line is divided into pieces of half a px.
class Drawing {
 public:
  Drawing(const DepthBuffer& buffer, double pixel) : buffer_(buffer), piece_(pixel / 2) {}

  void add(const Line& line) {
    const Eigen::Vector3d* last = nullptr;  // the one that has been drawn to
    for (const auto& point : line) {
      if (!point) {
        last = nullptr;
        end_line();
      } else if (last == nullptr) {
        last = &*point;
      } else if ((*point - *last).head<2>().norm() >= piece_) {
        const int pieces = static_cast<int>(std::ceil((*point - *last).head<2>().norm() / piece_));
        for (int i = 0; i < pieces; ++i)
          add(*last + i * (*point - *last) / pieces, *last + (i + 1) * (*point - *last) / pieces);
        last = &*point;
      }
    }
    end_line();
  }

  std::string seen() const { return closed(seen_); }
  std::string hidden() const { return closed(hidden_); }

 private:
  static std::string row(const Eigen::Vector3d& point) { return plotted(point.x()) + ' ' + plotted(point.y()) + '\n'; }
  static std::string closed(const std::string& block) { return block.empty() ? "NaN NaN\n" : block; }

  void add(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const bool is_hidden = buffer_.hides((from + to) / 2);
    std::string& block = is_hidden ? hidden_ : seen_;
    if (is_hidden != is_hidden_) end_line();
    is_hidden_ = is_hidden;
    block += row(from) + row(to);
  }
  void end_line() {
    if (is_hidden_) (*is_hidden_ ? hidden_ : seen_) += '\n';
    is_hidden_.reset();
  }

  const DepthBuffer& buffer_;
  double piece_;
  std::optional<bool> is_hidden_;
  std::string seen_, hidden_;
};

// The colours of values from 0 to `most`, and a bar in the foot that says them.
std::string colour_commands(double most, int height) {
  const auto place = [height](double x, double y) { return plotted(x / kWidth) + ',' + plotted(y / height); };
  return "set palette defined (0 '#fdf6e3', 0.25 '#f3c677', 0.5 '#e8854a', 0.75 '#b6335e', 1 '#4a1168')\nset cbrange [0:" +
         plotted(most) + "]\nset colorbox user horizontal origin screen " + place(290, 32) + " size screen " + place(120, 8) +
         " front noborder\nset cbtics ('0' 0, '" + digits(most, 3) + "' " + plotted(most) +
         ") scale 0 offset 0,0.6 font ',10' textcolor rgb '#333333'\n";
}

// One value for each 2 x 2 samples, NaN on the paper. The samples at a border are not mixed.
std::string values_of(const DepthBuffer& buffer, int columns, int rows) {
  std::string text;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      text += buffer.is_covered(2 * column, 2 * row) ? plotted(static_cast<double>(buffer.shade(2 * column, 2 * row))) : "NaN";
      text += column + 1 < columns ? ' ' : '\n';
    }
  return text;
}

// One number for each 2 x 2 samples. Where a back is in front at one of them, backs and paper alone are mixed, because the
// scale of brightness goes from one to the other over black.
std::string pixels_of(const DepthBuffer& buffer, int columns, int rows) {
  std::string text;
  text.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) * 5);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      std::array<float, 4> shades{};
      for (int i = 0; i < 4; ++i) shades[static_cast<std::size_t>(i)] = buffer.shade(2 * column + i % 2, 2 * row + i / 2);
      const bool has_back = *std::min_element(shades.begin(), shades.end()) < 0;
      double sum = 0;
      int count = 0;
      for (const float shade : shades) {
        if (has_back && shade > 0 && shade < 1) continue;
        sum += std::fabs(static_cast<double>(shade));
        ++count;
      }
      text += digits((has_back ? -sum : sum) / count, 3);
      text += column + 1 < columns ? ' ' : '\n';
    }
  return text;
}

double round_length(double most) {
  const double power = std::pow(10, std::floor(std::log10(most)));
  for (const double multiple : {5.0, 2.0})
    if (multiple * power <= most) return multiple * power;
  return power;
}

std::vector<Arrow> forces_of(const mesh::TriangleMesh& mesh, std::span<const Ticked> path, const ViewDirection& direction,
                             double longest) {
  std::vector<const Ticked*> pushing;
  for (const Ticked& ticked : path)
    if (is_touching(ticked) && vector_of(ticked.tick.force).norm() > 0) pushing.push_back(&ticked);
  std::vector<Arrow> arrows;
  double most = 0;
  const std::size_t count = std::min(kForces, pushing.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Ticked& ticked = *pushing[i * pushing.size() / count];
    const Eigen::Vector3d force = vector_of(ticked.tick.force);
    arrows.push_back({direction.turned(point_of(mesh, ticked.tick.after)), direction.turned(force), force.norm()});
    most = std::max(most, force.norm());
  }
  for (Arrow& arrow : arrows) arrow.by *= longest / most;
  return arrows;
}

// The counts of the path's ticks by status, in words; nothing without a path.
std::string counts_of(std::span<const Ticked> path) {
  std::array<std::size_t, mesh::kTickStatusNames.size()> count{};
  for (const Ticked& ticked : path) ++count[static_cast<std::size_t>(ticked.tick.status)];
  std::string words;
  for (const Status status : {Status::free, Status::contact, Status::unfinished, Status::invalid})
    if (const auto i = static_cast<std::size_t>(status); count[i] > 0)
      words += (words.empty() ? "ticks: " : ", ") + std::to_string(count[i]) + ' ' + std::string(mesh::kTickStatusNames[i]);
  return words;
}

// The axes' directions, words and a length, below the mesh.
std::string foot(const ViewDirection& direction, std::span<const Ticked> path, double pixel, double left, double bottom) {
  const auto at = [&](double x, double y) { return plotted(left + x * pixel) + ',' + plotted(bottom + y * pixel); };
  std::string text;
  const double length = round_length(150 * pixel), begin = kWidth - 2 * kMargin - length / pixel;
  text += "set arrow 201 from " + at(begin, 8) + " rto " + plotted(length) + ",0 nohead front lw 2 lc rgb '#333333'\n";
  text += "set label 201 " + quoted(plotted(length) + " mm") + " at " + at(begin + length / pixel / 2, 17) +
          " center front font ',10' textcolor rgb '#333333'\n";
  const auto words = [&](int tag, double y, const std::string& what) {
    text += "set label " + std::to_string(tag) + ' ' + quoted(what) + " noenhanced at " + at(60, y) +
            " left front font ',10' textcolor rgb '#333333'\n";
  };
  words(211, 25, counts_of(path));
  words(212, 10, "azimuth " + plotted(direction.azimuth) + "°, elevation " + plotted(direction.elevation) + "°");
  int tag = 202;
  for (const char* name : {"x", "y", "z"}) {
    const Eigen::Vector3d axis = direction.turned(Eigen::Vector3d::Unit(tag - 202));
    const double x = 22, y = 22, ahead = 20;
    text += "set arrow " + std::to_string(tag) + " from " + at(x, y) + " rto " + plotted(ahead * axis.x() * pixel) + ',' +
            plotted(ahead * axis.y() * pixel) + " head size " + plotted(5 * pixel) + ",20 filled front lc rgb '#333333'\n";
    text += "set label " + std::to_string(tag) + " '{/:Italic " + name + "}' at " +
            at(x + (ahead + 9) * axis.x(), y + (ahead + 9) * axis.y()) + " center front font ',10' textcolor rgb '#333333'\n";
    ++tag;
  }
  return text;
}

}  // namespace

Picture mesh_picture(const mesh::TriangleMesh& mesh, std::span<const Ticked> path, const ViewDirection& direction,
                     const std::string& name, const Heading& heading, std::span<const double> values) {
  std::vector<Eigen::Vector3d> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const mesh::Vertex& vertex : mesh.vertices) vertices.push_back(direction.turned(vector_of(vertex)));
  Box box;
  for (const mesh::Triangle& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) box.add(vertices[v]);
  Line device, god_object;
  for (const Ticked& ticked : path) {
    const bool is_valid = ticked.tick.status != Status::invalid;
    device.push_back(is_valid ? std::optional(direction.turned(vector_of(ticked.position))) : std::nullopt);
    god_object.push_back(is_valid ? std::optional(direction.turned(point_of(mesh, ticked.tick.after))) : std::nullopt);
    if (is_valid) box.add(*device.back());
    if (is_valid) box.add(*god_object.back());
  }
  const std::vector<Arrow> arrows = forces_of(mesh, path, direction, kForceShare * box.size().head<2>().maxCoeff());
  for (const Arrow& arrow : arrows) box.add(arrow.from + arrow.by);

  // mm in a px, and the rectangle of whole px around everything.
  const double across = std::max(box.size().x(), 1e-6), up = box.size().y();
  const double pixel = std::max(across / (kWidth - 2 * kMargin), up / kTallest);
  const int above = heading.title.empty() ? 0 : kHeadingHeight;
  const int columns = kWidth - 2 * kMargin, rows = std::max(1, static_cast<int>(std::ceil(up / pixel)));
  const double left = box.low().x() - (columns * pixel - across) / 2, bottom = box.low().y();
  DepthBuffer buffer({left, bottom, pixel / kPerPixel, kPerPixel * columns, kPerPixel * rows});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const mesh::Triangle& triangle = mesh.triangles[t];
    const std::array corners{vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]};
    if (!values.empty())
      buffer.draw(corners, static_cast<float>(values[t]));
    else
      buffer.draw(corners);
  }

  Drawing by_device(buffer, pixel), by_god_object(buffer, pixel);
  by_device.add(device);
  by_god_object.add(god_object);
  std::string arrow_block;
  double most = 0;
  for (const Arrow& arrow : arrows) {
    arrow_block += plotted(arrow.from.x()) + ' ' + plotted(arrow.from.y()) + ' ' + plotted(arrow.by.x()) + ' ' +
                   plotted(arrow.by.y()) + '\n';
    most = std::max(most, arrow.newtons);
  }

  const int height = above + 2 * kMargin + rows + kFoot;
  const double drawn_bottom = bottom - kFoot * pixel, image_pixel = pixel / 2;
  const auto line = [](const char* block, const char* colour, const char* width, const std::string& dash,
                       const std::string& title) {
    return std::string(", $") + block + " with lines lw " + width + dash + " lc rgb '" + colour + "' " +
           (title.empty() ? "notitle" : "title '" + title + "'");
  };
  std::string script = "$pixels << EOD\n" + (values.empty() ? pixels_of : values_of)(buffer, 2 * columns, 2 * rows) +
                       "EOD\n$device << EOD\n" + by_device.seen() + "EOD\n$device_hidden << EOD\n" + by_device.hidden() +
                       "EOD\n$god_object << EOD\n" + by_god_object.seen() + "EOD\n$god_object_hidden << EOD\n" +
                       by_god_object.hidden() + "EOD\n$forces << EOD\n" +
                       (arrow_block.empty() ? "NaN NaN NaN NaN\n" : arrow_block) + "EOD\n" +
                       "unset border\nunset tics\nunset key\nunset colorbox\n" + range("x", left, left + columns * pixel) +
                       range("y", drawn_bottom, bottom + rows * pixel) +
                       margins(kMargin / double(kWidth), 1 - kMargin / double(kWidth), 1 - (above + kMargin) / double(height),
                               kMargin / double(height)) +
                       (values.empty() ? std::string(kBrightness) : colour_commands(std::ranges::max(values), height)) +
                       foot(direction, path, pixel, left, drawn_bottom);
  // Each entry of the legend has the place of the longest, which gnuplot takes for longer than it is.
  script += heading_commands(heading, kWidth, height) + (path.empty()                         ? "unset key\n"
                                                         : heading.title.empty() || most == 0 ? ""
                                                                                              : "set key width -5\n");
  // The image has axes of its own, in its pixels: gnuplot takes seconds to compute a place for each.
  script += range("x2", -0.5, 2 * columns - 0.5) + range("y2", (drawn_bottom - bottom) / image_pixel - 0.5, 2 * rows - 0.5) +
            "plot $pixels matrix with image axes x2y2 notitle";
  if (!path.empty())
    script += line("device_hidden", kDevice, "1", " dt (2,3)", "") +
              line("god_object_hidden", kGodObject, "1", " dt (2,3)", "") + line("device", kDevice, "1.4", "", "device") +
              line("god_object", kGodObject, "1.4", "", "god-object") + ", $forces with vectors head size " +
              plotted(7 * pixel) + ",20 filled lw 1.2 lc rgb '" + kForce + "' title '" +
              (most > 0 ? "force, at most " + digits(most, 3) + " N" : "force") + "'";
  return {{kWidth, height, "mesh-" + name,
           "The mesh " + name + ", seen from azimuth " + plotted(direction.azimuth) + " and elevation " +
               plotted(direction.elevation) + " degrees" +
               (path.empty() ? "" : ", with the paths of the device and of the god-object")},
          script + '\n'};
}

}  // namespace forceshade::properties
