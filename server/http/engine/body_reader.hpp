#pragma once

#include "base/gzip.hpp"
#include "base/mapped_file.hpp"

namespace fitgauge::http {

/// Bytes of large bodies that may be in memory, and how many bodies wait. Thread-safe.
class ByteBudget {
 public:
  explicit ByteBudget(std::size_t limit) : limit_(limit) {}

  bool try_take(std::size_t bytes) {
    std::size_t used = used_.load(std::memory_order_relaxed);
    do {
      if (bytes > limit_ - used) return false;
    } while (!used_.compare_exchange_weak(used, used + bytes, std::memory_order_relaxed));
    return true;
  }
  void give_back(std::size_t bytes) { used_.fetch_sub(bytes, std::memory_order_relaxed); }

  /// @returns how many wait, with this one.
  std::size_t begin_wait() { return waiting_.fetch_add(1, std::memory_order_relaxed) + 1; }
  void end_wait() { waiting_.fetch_sub(1, std::memory_order_relaxed); }

  std::size_t used() const { return used_.load(std::memory_order_relaxed); }
  /// Returns whether somebody waits: a stopped sender must then give up its memory.
  bool is_short() const { return waiting_.load(std::memory_order_relaxed) > 0; }

 private:
  const std::size_t limit_;
  std::atomic<std::size_t> used_{0};
  std::atomic<std::size_t> waiting_{0};
};

/// Bytes of a budget; the destructor returns them.
class ByteShare {
 public:
  ByteShare() = default;
  ByteShare(ByteBudget& budget, std::size_t bytes) : budget_(&budget), bytes_(bytes) {}
  ByteShare(ByteShare&& other) noexcept
      : budget_(std::exchange(other.budget_, nullptr)), bytes_(other.bytes_) {}
  ByteShare& operator=(ByteShare&& other) noexcept {
    std::swap(budget_, other.budget_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~ByteShare() {
    if (budget_ != nullptr) budget_->give_back(bytes_);
  }

  bool is_wanted() const { return budget_ != nullptr && budget_->is_short(); }

 private:
  ByteBudget* budget_ = nullptr;
  std::size_t bytes_ = 0;
};

/// Two budgets, so that no body waits for bytes of a waiting body: a body of unknown length uses up
/// to kPart of `parts`, then its whole limit of `wholes` at once. A body with bytes of `wholes`
/// never waits, so all waiting bodies are served in the end.
struct BodyBudgets {
  static constexpr std::size_t kPart = std::size_t{1} << 20;

  ByteBudget wholes;
  ByteBudget parts{16 * kPart};
  std::string spool_folder{};  ///< of bodies that need not stay in memory; empty: they do

  std::size_t used() const { return wholes.used() + parts.used(); }
  bool is_short() const { return wholes.is_short() || parts.is_short(); }
};

/// Collects one request's body in memory, or on disk if it spools and has more than kPart: decodes
/// gzip, applies the limit after decompression and charges more than kFree to the budgets. Used by
/// one thread. After TooLarge, Malformed or DiskFull only clear() is allowed.
class BodyReader {
 public:
  /// Bytes that every body may use without a permission: small requests never wait.
  static constexpr std::size_t kFree = std::size_t{16} << 10;

  enum class Outcome { Ok, NoBudget, TooLarge, Malformed, DiskFull };

  explicit BodyReader(BodyBudgets& budgets) : budgets_(budgets) {}
  BodyReader& operator=(BodyReader&&) = delete;  // neither copied nor moved

  struct Plan {
    std::size_t limit = 0;
    bool gzip = false;
    bool discard = false;  ///< count and decode only
    bool spools = false;

    /// Whether the bytes are stored unchanged.
    bool is_verbatim() const { return !gzip && !discard; }
  };
  void start(const Plan& plan) {
    clear();
    plan_ = plan;
    if (plan.gzip) gunzip_.emplace();
  }
  const Plan& plan() const { return plan_; }

  /// Makes room for a body of `size` bytes; NoBudget leaves everything as it was.
  Outcome reserve(std::size_t size) {
    if (size > plan_.limit) return Outcome::TooLarge;
    return hold(size, budgets_.wholes);
  }

  /// Consumes bytes from the front of `piece`; after NoBudget add the rest later.
  Outcome add(std::string_view& piece);

  /// Room for bytes that need no decoding, to be filled and then announced by `added`.
  std::span<char> room() const { return {data() + size_, capacity_ - size_}; }
  void added(std::size_t count) {
    size_ += count;
    if (size_ - let_go_ < FileText::kStretch) return;
    bytes().let_go(let_go_, size_);
    let_go_ = size_;
  }

  /// Ends the body: Malformed if its coding is incomplete.
  Outcome finish() const {
    return gunzip_ && !gunzip_->is_complete() ? Outcome::Malformed : Outcome::Ok;
  }

  FileText bytes() const { return {{data(), size_}, spooled_.bytes() != nullptr}; }
  /// Returns the budget that lacked the bytes. @pre the result was NoBudget
  ByteBudget& lacking() const { return *lacking_; }
  /// Another body waits for bytes of this body.
  bool is_wanted() const { return share_.is_wanted(); }

  void clear();

 private:
  Outcome add_decoded(std::string_view& piece);
  Outcome grow(std::size_t size);
  Outcome hold(std::size_t capacity, ByteBudget& budget);
  char* data() const { return spooled_.bytes() != nullptr ? spooled_.bytes() : data_.get(); }

  BodyBudgets& budgets_;
  ByteBudget* lacking_ = nullptr;
  Plan plan_;
  ByteShare share_;  // outlives the bytes
  std::unique_ptr<char[]> data_;
  MappedFile spooled_;  // in place of data_
  std::size_t size_ = 0;
  std::size_t let_go_ = 0;
  std::size_t capacity_ = 0;
  std::size_t discarded_ = 0;
  std::optional<Gunzip> gunzip_;
};

}  // namespace fitgauge::http
