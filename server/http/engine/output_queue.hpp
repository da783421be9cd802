#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace fitgauge::http {

/// Bytes on their way to the socket: text that is appended, then at most one long body that is sent
/// from where it lies. What is being sent does not move while more is appended.
class OutputQueue {
 public:
  static constexpr std::size_t kLongBody = std::size_t{64} << 10;

  /// Where answers are appended. @pre !has_long_body()
  std::string& text() { return queued_; }

  /// A body that follows the text, kept alive by `owner`. @pre !has_long_body()
  void append_long(std::shared_ptr<const void> owner, std::string_view bytes) {
    owner_ = std::move(owner);
    long_body_ = bytes;
  }

  bool has_long_body() const { return !long_body_.empty(); }
  std::size_t long_body_size() const { return long_body_.size(); }
  bool empty() const { return sent_ == sending_.size() && queued_.empty() && !has_long_body(); }
  std::size_t queued_text() const { return queued_.size(); }

  /// The next bytes to send; they stay where they are until consume().
  std::string_view front() {
    if (sent_ == sending_.size() && !queued_.empty()) {
      sending_.clear();
      sending_.swap(queued_);
      sent_ = 0;
    }
    return sent_ < sending_.size() ? std::string_view(sending_).substr(sent_) : long_body_;
  }

  void consume(std::size_t count) {
    if (sent_ < sending_.size()) {
      sent_ += count;
      return;
    }
    long_body_.remove_prefix(count);
    if (long_body_.empty()) owner_.reset();
  }

  /// Gives back what an idle connection need not keep. @pre empty()
  void shrink() {
    constexpr std::size_t kKept = 1024;
    sending_.clear();
    sent_ = 0;
    if (sending_.capacity() > kKept) sending_ = {};
    if (queued_.capacity() > kKept) queued_ = {};
  }

 private:
  std::string queued_;
  std::string sending_;
  std::size_t sent_ = 0;
  std::shared_ptr<const void> owner_;
  std::string_view long_body_;
};

}  // namespace fitgauge::http
