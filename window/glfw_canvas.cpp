// SPDX-License-Identifier: BSD-3-Clause
// The canvas by GLFW and OpenGL 3.3 core. Dear ImGui draws: its list of triangles with smooth edges, its font atlas, and its
// renderer; none of its widgets.

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_opengl3.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "window/canvas.h"
#include "window/font.h"

namespace forceshade::window {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kFrame = std::chrono::nanoseconds(std::chrono::seconds(1)) / 60;

// The few functions of OpenGL that are called here, from the driver that GLFW has loaded.
class OpenGl {
 public:
  void load() {
    get(viewport, "glViewport");
    get(clear_colour, "glClearColor");
    get(clear, "glClear");
    get(pixel_store, "glPixelStorei");
    get(read_pixels, "glReadPixels");
  }

  void (*viewport)(int x, int y, int width, int height) = nullptr;
  void (*clear_colour)(float red, float green, float blue, float alpha) = nullptr;
  void (*clear)(unsigned mask) = nullptr;
  void (*pixel_store)(unsigned name, int value) = nullptr;
  void (*read_pixels)(int x, int y, int width, int height, unsigned format, unsigned type, void* data) = nullptr;

  static constexpr unsigned kColourBuffer = 0x4000, kPackAlignment = 0x0D05, kRgb = 0x1907, kUnsignedByte = 0x1401;

 private:
  template <class Function>
  static void get(Function& function, const char* name) {
    function = reinterpret_cast<Function>(glfwGetProcAddress(name));
    if (function == nullptr) throw Error(std::string("the graphics driver lacks ") + name + " of OpenGL 3.3");
  }
};

// The names of keys that type nothing. The others come as characters, as the keyboard's layout types them.
std::string name_of(int key) {
  if (key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER) return "return";
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return std::string(1, 'f').append(std::to_string(key - GLFW_KEY_F1 + 1));
  constexpr std::pair<int, const char*> kNames[]{{GLFW_KEY_BACKSPACE, "backspace"},
                                                 {GLFW_KEY_DELETE, "delete"},
                                                 {GLFW_KEY_TAB, "tab"},
                                                 {GLFW_KEY_ESCAPE, "escape"},
                                                 {GLFW_KEY_INSERT, "insert"},
                                                 {GLFW_KEY_LEFT, "left"},
                                                 {GLFW_KEY_RIGHT, "right"},
                                                 {GLFW_KEY_UP, "up"},
                                                 {GLFW_KEY_DOWN, "down"},
                                                 {GLFW_KEY_PAGE_UP, "page-up"},
                                                 {GLFW_KEY_PAGE_DOWN, "page-down"},
                                                 {GLFW_KEY_HOME, "home"},
                                                 {GLFW_KEY_END, "end"}};
  for (const auto& [code, name] : kNames)
    if (code == key) return name;
  return {};
}

ImVec2 vec(Point p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y)};
}
ImU32 packed(Colour c) {
  return ImGui::ColorConvertFloat4ToU32({c.red, c.green, c.blue, c.alpha});
}

// Into a list of Dear ImGui.
class Painter {
 public:
  Painter(ImDrawList& list, const Font& font) : list_(list), font_(font) {}

  void operator()(const Triangles& triangles) {
    const int count = static_cast<int>(triangles.vertices.size());
    list_.PrimReserve(count, count);
    for (const Vertex& vertex : triangles.vertices)
      list_.PrimVtx(vec(vertex.at), ImGui::GetFontTexUvWhitePixel(), packed(vertex.colour));
  }
  void operator()(const Line& line) {
    std::vector<ImVec2> points;
    for (const Point point : line.points) points.push_back(vec(point));
    list_.AddPolyline(points.data(), static_cast<int>(points.size()), packed(line.colour), 0, static_cast<float>(line.width));
  }
  void operator()(const Ellipse& ellipse) {
    constexpr int kCorners = 48;
    std::vector<ImVec2> corners;
    for (int i = 0; i < kCorners; ++i) {
      const double angle = 2 * 3.14159265358979323846 * i / kCorners;
      corners.push_back(
          vec({ellipse.centre.x + ellipse.radius_x * std::cos(angle), ellipse.centre.y + ellipse.radius_y * std::sin(angle)}));
    }
    list_.AddConvexPolyFilled(corners.data(), kCorners, packed(ellipse.colour));
  }
  void operator()(const Box& box) {
    const ImVec2 from = vec({box.area.left, box.area.top}), to = vec({box.area.right, box.area.bottom});
    const auto corner = static_cast<float>(box.corner);
    list_.AddRectFilled(from, to, packed(box.fill), corner);
    if (box.border_width > 0) list_.AddRect(from, to, packed(box.border), corner, 0, static_cast<float>(box.border_width));
  }
  // On whole pixels, where the glyphs were rendered for.
  void operator()(const Text& text) {
    ImFont* font = font_.at(text.size);
    const double centred = text.at.y + (kLineHeight - 1) / 2 * text.size;
    list_.AddText(font, font->FontSize, {std::round(static_cast<float>(text.at.x)), std::round(static_cast<float>(centred))},
                  packed(text.colour), text.words.data(), text.words.data() + text.words.size());
  }

 private:
  ImDrawList& list_;
  const Font& font_;
};

std::string last_glfw_error() {
  const char* words = nullptr;
  glfwGetError(&words);
  return words == nullptr ? "no reason is given" : words;
}

bool is_open_anywhere = false;

}  // namespace

// Undoes what the constructor did, also where it threw half way.
class Canvas::Display {
 public:
  explicit Display(const Settings& settings) : settings_(settings) {
    if (is_open_anywhere) throw Error("a window is open already; expected one at a time");
    if (glfwInit() != GLFW_TRUE) throw Error("no window can be opened: " + last_glfw_error() + " (is there a display?)");
    is_open_anywhere = true;
    try {
      open();
    } catch (...) {
      close();
      throw;
    }
  }
  ~Display() { close(); }
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

  bool draw(Drawing drawing) {
    glfwPollEvents();
    if (glfwWindowShouldClose(window_) == GLFW_TRUE) return false;
    drawing_ = std::move(drawing);
    render();
    glfwSwapBuffers(window_);
    wait();
    return true;
  }

  std::vector<Key> keys() { return std::exchange(keys_, {}); }

  std::optional<Point> pointer() const {
    int width = 0, height = 0;
    glfwGetWindowSize(window_, &width, &height);
    Point at;
    glfwGetCursorPos(window_, &at.x, &at.y);
    if (glfwGetWindowAttrib(window_, GLFW_HOVERED) != GLFW_TRUE || width <= 0 || height <= 0) return std::nullopt;
    const Size size = this->size();
    return Point{at.x * size.width / width, at.y * size.height / height};
  }

  Image pixels() {
    render();
    const Size size = this->size();
    Image image{static_cast<int>(size.width), static_cast<int>(size.height), {}};
    const std::size_t row = 3 * static_cast<std::size_t>(image.width), rows = static_cast<std::size_t>(image.height);
    image.bytes.resize(row * rows);
    gl_.pixel_store(OpenGl::kPackAlignment, 1);
    gl_.read_pixels(0, 0, image.width, image.height, OpenGl::kRgb, OpenGl::kUnsignedByte, image.bytes.data());
    for (std::size_t i = 0; i < rows / 2; ++i)  // OpenGL counts from the bottom
      std::swap_ranges(&image.bytes[i * row], &image.bytes[i * row] + row, &image.bytes[(rows - 1 - i) * row]);
    return image;
  }

  Size size() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {static_cast<double>(width), static_cast<double>(height)};
  }

  const std::string& note() const { return note_; }

 private:
  void open() {
    int monitors = 0;
    GLFWmonitor** all = glfwGetMonitors(&monitors);
    if (settings_.monitor > monitors)
      throw Error("there is no monitor " + std::to_string(settings_.monitor) + "; expected 1 to " + std::to_string(monitors));
    GLFWmonitor* monitor = all[settings_.monitor - 1];
    const GLFWvidmode* mode = glfwGetVideoMode(monitor);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    if (settings_.is_fullscreen) {
      glfwWindowHint(GLFW_REFRESH_RATE, mode->refreshRate);
      glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
      window_ = glfwCreateWindow(mode->width, mode->height, "forceshade", monitor, nullptr);
    } else {
      glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
      window_ = glfwCreateWindow(settings_.width, settings_.height, "forceshade", nullptr, nullptr);
    }
    if (window_ == nullptr) throw Error("no window with OpenGL 3.3 can be opened: " + last_glfw_error());
    if (!settings_.is_fullscreen) {
      int x = 0, y = 0;
      glfwGetMonitorPos(monitor, &x, &y);
      glfwSetWindowPos(window_, x + std::max(0, (mode->width - settings_.width) / 2),
                       y + std::max(0, (mode->height - settings_.height) / 2));
      glfwShowWindow(window_);
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    glfwSetInputMode(window_, GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, &Display::on_key);
    glfwSetCharCallback(window_, &Display::on_character);
    gl_.load();

    context_ = ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    FontFile file = find_font(settings_.font);
    note_ = file.note;
    font_.emplace(std::move(file));
    if (!ImGui_ImplOpenGL3_Init("#version 330 core")) throw Error("the graphics driver does not draw with OpenGL 3.3");
    has_renderer_ = true;
  }

  void close() noexcept {
    if (has_renderer_) ImGui_ImplOpenGL3_Shutdown();
    font_.reset();
    if (context_ != nullptr) ImGui::DestroyContext(context_);
    glfwTerminate();
    is_open_anywhere = false;
  }

  static void on_key(GLFWwindow* window, int key, int, int action, int) {
    auto& self = *static_cast<Display*>(glfwGetWindowUserPointer(window));
    self.is_repeat_ = action == GLFW_REPEAT;  // of a character that follows, too
    if (action == GLFW_RELEASE) return;
    if (std::string name = name_of(key); !name.empty()) self.keys_.push_back({std::move(name), self.is_repeat_});
  }
  static void on_character(GLFWwindow* window, unsigned code_point) {
    auto& self = *static_cast<Display*>(glfwGetWindowUserPointer(window));
    self.keys_.push_back({utf8(code_point), self.is_repeat_});
  }

  void render() {
    const Size size = this->size();
    if (size.width < 1 || size.height < 1) return;  // minimised
    const Picture picture = drawing_ ? drawing_(size, *font_) : Picture{};
    if (font_->prepare(picture)) ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(size.width), static_cast<float>(size.height)};
    io.DeltaTime = 1.0F / 60;
    ImGui_ImplOpenGL3_NewFrame();
    if (io.Fonts->TexID == nullptr) ImGui_ImplOpenGL3_CreateFontsTexture();
    ImGui::NewFrame();
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.Flags |= ImDrawListFlags_AntiAliasedLines | ImDrawListFlags_AntiAliasedFill;
    Painter painter(list, *font_);
    for (const Item& item : picture.items) std::visit(painter, item);
    ImGui::Render();
    gl_.viewport(0, 0, static_cast<int>(size.width), static_cast<int>(size.height));
    gl_.clear_colour(picture.background.red, picture.background.green, picture.background.blue, 1);
    gl_.clear(OpenGl::kColourBuffer);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  }

  // Waits for nothing where swapping has waited for a display of 60 Hz.
  void wait() {
    next_ = std::max(next_ + kFrame, Clock::now());  // a late frame delays those after it
    std::this_thread::sleep_until(next_);
  }

  const Settings settings_;
  OpenGl gl_;
  GLFWwindow* window_ = nullptr;
  ImGuiContext* context_ = nullptr;
  std::optional<Font> font_;
  bool has_renderer_ = false;
  std::string note_;
  Drawing drawing_;
  std::vector<Key> keys_;
  bool is_repeat_ = false;
  Clock::time_point next_ = Clock::now();
};

Canvas::Canvas(const Settings& settings) : display_(std::make_unique<Display>(settings)) {}
Canvas::~Canvas() = default;

bool Canvas::draw(Drawing drawing) {
  return display_->draw(std::move(drawing));
}
std::vector<Key> Canvas::keys() {
  return display_->keys();
}
std::optional<Point> Canvas::pointer() const {
  return display_->pointer();
}
Size Canvas::size() const {
  return display_->size();
}
Image Canvas::pixels() {
  return display_->pixels();
}
const std::string& Canvas::note() const {
  return display_->note();
}
bool Canvas::is_available() noexcept {
  return true;
}

}  // namespace forceshade::window
