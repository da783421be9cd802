#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace fitgauge::http {

/// Bytes on their way to the socket: text, then at most one long body that is sent from where it
/// lies. The text is appended to a string that all connections of a thread share, since most of it
/// leaves at once; keep() takes what has not left into memory of its own. Between two callbacks of
/// the thread the shared string is empty.
class OutputQueue {
 public:
  static constexpr std::size_t kLongBody = std::size_t{64} << 10;

  explicit OutputQueue(std::string& shared) : shared_(shared) {}

  /// Where answers are appended. @pre !has_long_body()
  std::string& text() { return shared_; }

  /// A body that follows the text, kept alive by `owner`. @pre !has_long_body()
  void append_long(std::shared_ptr<const void> owner, std::string_view bytes) {
    owner_ = std::move(owner);
    long_body_ = bytes;
    owned_ = bytes.size();
  }

  bool has_long_body() const { return !long_body_.empty(); }
  std::size_t long_body_size() const { return long_body_.size(); }
  std::size_t text_size() const { return shared_.size(); }
  /// The bytes of memory that it alone keeps: they are free once all has left, or at discard().
  std::size_t held() const {
    return kept_.size() + later_.size() + (owner_.use_count() == 1 ? owned_ : 0);
  }
  bool empty() const { return kept_.empty() && shared_.empty() && !has_long_body(); }

  /// The next bytes to send.
  std::string_view front() const {
    if (!kept_.empty()) return std::string_view(kept_).substr(sent_);
    return shared_.empty() ? long_body_ : std::string_view(shared_).substr(sent_);
  }

  void consume(std::size_t count) {
    if (kept_.empty() && shared_.empty()) {
      long_body_.remove_prefix(count);
      if (long_body_.empty()) owner_.reset();
      return;
    }
    sent_ += count;
    if (sent_ < (kept_.empty() ? shared_ : kept_).size()) return;
    sent_ = 0;
    if (kept_.empty()) {
      clear_shared();
    } else {
      kept_ = std::exchange(later_, {});
    }
  }

  /// Takes what has not left out of the shared string; front() then stays where it is until
  /// consume(), whatever is appended and kept.
  void keep() {
    if (shared_.empty()) return;
    if (kept_.empty()) {
      kept_ = shared_.substr(std::exchange(sent_, 0));
    } else {
      later_.append(shared_);
    }
    clear_shared();
  }

  /// Forgets everything.
  void discard() {
    clear_shared();
    kept_ = {};
    later_ = {};
    long_body_ = {};
    owner_.reset();
    sent_ = 0;
  }

 private:
  void clear_shared() {
    shared_.clear();
    if (shared_.capacity() > 4 * kLongBody) shared_.shrink_to_fit();
  }

  std::string& shared_;
  std::string kept_;      ///< before the shared text
  std::string later_;     ///< behind kept_, which is being sent and must not move
  std::size_t sent_ = 0;  ///< of kept_, or of the shared text when there is none
  std::shared_ptr<const void> owner_;
  std::string_view long_body_;
  std::size_t owned_ = 0;  ///< bytes behind owner_
};

}  // namespace fitgauge::http
