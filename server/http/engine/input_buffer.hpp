#pragma once

#include <cassert>
#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "http/engine/request_head.hpp"
#include "http/request.hpp"

namespace fitgauge::http {

/// The bytes read from a connection: the head of the request in work, then what has not been parsed
/// yet. Small while idle, grows with a long head. A head that is complete does not move: pin_head()
/// puts it aside before its body is read.
class InputBuffer {
 public:
  static constexpr std::size_t kSmall = 4096;

  std::string_view unread() const { return {data_.get() + parsed_, end_ - parsed_}; }
  void advance(std::size_t count) { parsed_ += count; }
  void added(std::size_t count) { end_ += count; }

  /// The request in work is done: what follows begins the next one.
  void next_request() {
    begin_ = parsed_;
    pinned_.reset();
  }

  /// Room to read into for a head that is not complete. What was read may move; `head` follows.
  std::span<char> room_for_head(RequestHead& head) {
    assert(!pinned_);
    if (begin_ == end_) {
      begin_ = parsed_ = end_ = 0;
      if (capacity_ != kSmall) resize(kSmall);
    } else if (end_ == capacity_) {
      const char* const old = data_.get() + begin_;
      const std::unique_ptr<char[]> before = begin_ > 0 ? nullptr : grow(begin_, 1);
      if (!before) move_to_front();
      head.rebase(old, data_.get());
    }
    return {data_.get() + end_, capacity_ - end_};
  }

  /// The head is complete and its body has to be read: the head stays where it is until
  /// next_request(), what is unread goes to memory of its own.
  /// @pre nothing is being read into the buffer.
  void pin_head() {
    assert(!pinned_);
    pinned_ = grow(parsed_, kSmall);
  }

  /// Room to read `size` bytes of a body into, behind what is unread. @pre pin_head()
  std::span<char> room_for_body(std::size_t size) {
    assert(pinned_);
    if (capacity_ - end_ < size) grow(parsed_, size);
    return {data_.get() + end_, capacity_ - end_};
  }

  /// Forgets everything: what is read from now on is thrown away.
  std::span<char> room_to_discard() {
    begin_ = parsed_ = end_ = 0;
    if (capacity_ == 0) resize(kSmall);
    return {data_.get(), capacity_};
  }

 private:
  void move_to_front() {
    std::memmove(data_.get(), data_.get() + begin_, end_ - begin_);
    parsed_ -= begin_;
    end_ -= begin_;
    begin_ = 0;
  }

  /// Copies what was read from `from` on to new memory with room for `size` more bytes.
  /// @returns the old memory.
  std::unique_ptr<char[]> grow(std::size_t from, std::size_t size) {
    const std::size_t kept = end_ - from;
    std::size_t capacity = kSmall;
    while (capacity < kept + size) capacity *= 2;
    std::unique_ptr<char[]> before = std::move(data_);
    resize(capacity);
    std::memcpy(data_.get(), before.get() + from, kept);
    parsed_ -= from;
    end_ = kept;
    begin_ = 0;
    return before;
  }

  void resize(std::size_t capacity) {
    data_.reset(new char[capacity + Request::kBodyPadding]);
    capacity_ = capacity;
  }

  std::unique_ptr<char[]> data_;
  std::unique_ptr<char[]> pinned_;  ///< the head, while its body is read
  std::size_t capacity_ = 0;
  std::size_t begin_ = 0;   ///< of the request in work
  std::size_t parsed_ = 0;  ///< up to here the parser has been
  std::size_t end_ = 0;
};

}  // namespace fitgauge::http
