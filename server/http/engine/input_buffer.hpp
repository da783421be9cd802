#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>

#include "http/engine/request_head.hpp"
#include "http/request.hpp"

namespace fitgauge::http {

/// The bytes read from a connection, in one piece: the request in work (its head is viewed by a
/// RequestHead), then what has not been parsed yet. Small while idle, grows with a long head.
class InputBuffer {
 public:
  static constexpr std::size_t kSmall = 4096;

  std::string_view unread() const { return {data_.get() + parsed_, end_ - parsed_}; }
  void advance(std::size_t count) { parsed_ += count; }
  void added(std::size_t count) { end_ += count; }

  /// The request in work is done: what follows begins the next one.
  void next_request() { begin_ = parsed_; }

  /// Room to read into for the head of a request. What was read may move; `head` follows.
  std::span<char> room_for_head(RequestHead& head) {
    if (begin_ == end_) {
      begin_ = parsed_ = end_ = 0;
      if (capacity_ != kSmall) resize(kSmall);
    } else if (end_ == capacity_) {
      make_room(head, 1);
    }
    return {data_.get() + end_, capacity_ - end_};
  }

  /// Room to read `size` bytes of a body into; the parsed part of the body gives way.
  std::span<char> room_for_body(RequestHead& head, std::size_t head_size, std::size_t size) {
    const std::size_t body = begin_ + head_size;
    if (parsed_ > body) {
      std::memmove(data_.get() + body, data_.get() + parsed_, end_ - parsed_);
      end_ -= parsed_ - body;
      parsed_ = body;
    }
    if (capacity_ - end_ < size) make_room(head, size);
    return {data_.get() + end_, capacity_ - end_};
  }

  /// The size of what was parsed of the request in work.
  std::size_t parsed_size() const { return parsed_ - begin_; }

  /// Forgets everything: what is read from now on is thrown away.
  std::span<char> room_to_discard() {
    begin_ = parsed_ = end_ = 0;
    if (capacity_ == 0) resize(kSmall);
    return {data_.get(), capacity_};
  }

 private:
  void make_room(RequestHead& head, std::size_t size) {
    const char* const old = data_.get() + begin_;
    const std::size_t kept = end_ - begin_;
    if (capacity_ - kept < size) {
      std::size_t grown = capacity_;
      while (grown - kept < size) grown *= 2;
      std::unique_ptr<char[]> before = std::move(data_);
      resize(grown);
      std::memcpy(data_.get(), before.get() + begin_, kept);
      head.rebase(old, data_.get());
    } else {
      std::memmove(data_.get(), old, kept);
      head.rebase(old, data_.get());
    }
    parsed_ -= begin_;
    end_ = kept;
    begin_ = 0;
  }

  void resize(std::size_t capacity) {
    data_.reset(new char[capacity + Request::kBodyPadding]);
    capacity_ = capacity;
  }

  std::unique_ptr<char[]> data_;
  std::size_t capacity_ = 0;
  std::size_t begin_ = 0;   ///< of the request in work
  std::size_t parsed_ = 0;  ///< up to here the parser has been
  std::size_t end_ = 0;
};

}  // namespace fitgauge::http
