// SPDX-License-Identifier: BSD-3-Clause
#include "device/haply/haply_socket.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <optional>
#include <stdexcept>

#include "text/number_text.h"

namespace forceshade::device::haply {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;
using boost::system::error_code;
using Clock = std::chrono::steady_clock;
using Done = std::optional<error_code>;

constexpr std::size_t kLongestMessage = 1 << 20;
constexpr std::chrono::milliseconds kToEnd{100};

void set(Done& done, const error_code& error) {
  done = error;
}

// Runs what was begun until it is done or the time is up. True if it is done.
bool run_until(asio::io_context& io, const Done& done, Clock::time_point deadline) {
  io.restart();
  while (!done && Clock::now() < deadline) {
    if (io.stopped()) io.restart();
    io.run_one_until(deadline);
  }
  return done.has_value();
}

// Throws where the step failed or took too long.
void expect_done(asio::io_context& io, const Done& done, Clock::time_point deadline, const std::string& step) {
  if (!run_until(io, done, deadline)) throw std::runtime_error(step + ": no answer in time");
  if (*done) throw std::runtime_error(step + ": " + done->message());
}

void connect(asio::io_context& io, tcp::socket& socket, const Address& address, Clock::time_point deadline) {
  error_code error;
  tcp::resolver resolver(io);
  const auto ends = resolver.resolve(address.host, std::to_string(address.port), error);
  if (error) throw std::runtime_error("finding " + address.words() + ": " + error.message());
  Done done;
  asio::async_connect(socket, ends, [&](const error_code& e, const tcp::endpoint&) { set(done, e); });
  try {
    expect_done(io, done, deadline, "connecting to " + address.words());
  } catch (const std::runtime_error&) {
    socket.close(error);
    if (!done) run_until(io, done, Clock::time_point::max());  // ends what was begun, since the socket is closed
    throw;
  }
  socket.set_option(tcp::no_delay(true), error);
}

}  // namespace

Address address_of(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  Address address;
  if (colon != std::string::npos) {
    address.host = text.substr(0, colon);
    if (address.host.starts_with('[') && address.host.ends_with(']')) address.host = address.host.substr(1, colon - 2);
    address.port = number_in<decltype(address.port)>(std::string_view(text).substr(colon + 1)).value_or(0);
  }
  if (address.host.empty() || address.port < 1 || address.port > 65535)
    throw std::invalid_argument("expected HOST:PORT, for instance localhost:10001, got \"" + text + '"');
  return address;
}

struct Socket::Implementation {
  asio::io_context io{1};
  beast::websocket::stream<tcp::socket, false> stream{io};  // without compression, which it never offers
  beast::flat_buffer buffer;
  bool is_reading = false, is_closing = false, has_happened = false;
  std::string sent;
  Done ended;

  std::string words_of(const error_code& error) const {
    const bool has_reason = error == beast::websocket::error::closed && !stream.reason().reason.empty();
    return error.message() + (has_reason ? std::string(": ") + stream.reason().reason.c_str() : "");
  }
};

Socket::Socket(const Address& address, Time timeout) : it_(std::make_unique<Implementation>()) {
  const Clock::time_point deadline = Clock::now() + timeout;
  connect(it_->io, it_->stream.next_layer(), address, deadline);
  it_->stream.read_message_max(kLongestMessage);
  it_->stream.text(true);
  Done done;
  it_->stream.async_handshake(address.words(), "/", [&](const error_code& error) { set(done, error); });
  try {
    expect_done(it_->io, done, deadline, "opening a WebSocket at " + address.words());
  } catch (const std::runtime_error&) {
    error_code ignored;
    it_->stream.next_layer().close(ignored);
    if (!done) run_until(it_->io, done, Clock::time_point::max());
    throw;
  }
}

Socket::~Socket() {
  Socket::close(kToEnd);
  // Ends what was begun, so that nothing is written to what is gone.
  error_code ignored;
  it_->stream.next_layer().close(ignored);
  it_->io.restart();
  it_->io.run_for(kToEnd);
}

void Socket::send(std::string_view text) {
  it_->sent = text;
  it_->stream.async_write(asio::buffer(it_->sent), [this](const error_code& error, std::size_t) {
    it_->has_happened = true;
    error ? was_closed(it_->words_of(error)) : was_sent();
  });
}

void Socket::wait(std::int64_t until) {
  if (is_closed()) return;
  if (!it_->is_reading && !keeps_message()) {
    it_->is_reading = true;
    it_->buffer.consume(it_->buffer.size());
    it_->stream.async_read(it_->buffer, [this](const error_code& error, std::size_t) {
      it_->has_happened = true;
      it_->is_reading = false;
      if (error) return was_closed(it_->words_of(error));
      came({static_cast<const char*>(it_->buffer.data().data()), it_->buffer.size()});
    });
  }
  const Clock::time_point deadline{std::chrono::nanoseconds(until)};  // one clock: system::now() is steady_clock's
  it_->has_happened = false;
  it_->io.restart();
  it_->io.poll();
  while (!it_->has_happened && Clock::now() < deadline) {
    if (it_->io.stopped()) it_->io.restart();
    it_->io.run_one_until(deadline);
  }
}

void Socket::close(Time timeout) noexcept {
  try {
    if (it_->is_closing || !it_->stream.is_open()) return;
    it_->is_closing = true;
    const Clock::time_point deadline = Clock::now() + timeout;
    it_->stream.async_close(beast::websocket::close_code::normal, [this](const error_code& error) { set(it_->ended, error); });
    run_until(it_->io, it_->ended, deadline);
  } catch (const std::exception&) {
  }
}

std::string http_get(const Address& address, const std::string& target, Socket::Time timeout) {
  namespace http = beast::http;
  const Clock::time_point deadline = Clock::now() + timeout;
  asio::io_context io{1};
  tcp::socket socket(io);
  connect(io, socket, address, deadline);
  http::request<http::empty_body> request{http::verb::get, target, 11};
  request.set(http::field::host, address.words());
  request.set(http::field::connection, "close");
  Done written, read;
  beast::flat_buffer buffer(kLongestMessage);
  http::response<http::string_body> response;
  const auto step = [&](const Done& done) {
    if (run_until(io, done, deadline) && !*done) return;
    const std::string why = done ? done->message() : "no answer in time";
    error_code ignored;
    socket.close(ignored);
    if (!done) run_until(io, done, Clock::time_point::max());
    throw std::runtime_error("GET " + target + " at " + address.words() + ": " + why);
  };
  http::async_write(socket, request, [&](const error_code& error, std::size_t) { set(written, error); });
  step(written);
  http::async_read(socket, buffer, response, [&](const error_code& error, std::size_t) { set(read, error); });
  step(read);
  if (response.result() != http::status::ok)
    throw std::runtime_error("GET " + target + " at " + address.words() + ": status " + std::to_string(response.result_int()));
  return response.body();
}

}  // namespace forceshade::device::haply
