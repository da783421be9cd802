#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "base/gzip.hpp"
#include "http/engine/byte_budget.hpp"

namespace fitgauge::http {

/// Gathers one request's body in memory: decodes gzip, holds the limit after decompression and
/// takes what is more than kFree from the budgets. Used by one thread. After TooLarge or Malformed
/// only clear() may follow.
class BodyReader {
 public:
  /// What every body may use without asking: small requests never wait.
  static constexpr std::size_t kFree = std::size_t{16} << 10;

  enum class Outcome { Ok, NoBudget, TooLarge, Malformed };

  explicit BodyReader(BodyBudgets& budgets) : budgets_(budgets) {}
  BodyReader(const BodyReader&) = delete;
  BodyReader& operator=(const BodyReader&) = delete;

  struct Plan {
    std::size_t limit = 0;
    bool gzip = false;
    bool discard = false;  ///< count and decode only

    /// Whether what comes is kept as it is.
    bool is_verbatim() const { return !gzip && !discard; }
  };
  void start(const Plan& plan);
  const Plan& plan() const { return plan_; }

  /// Makes room for a body of `size` bytes; NoBudget leaves everything as it was.
  Outcome reserve(std::size_t size);

  /// Takes bytes off the front of `piece`; NoBudget leaves the rest to be added later.
  Outcome add(std::string_view& piece);

  /// Room for bytes that need no decoding, to be filled and then announced by `added`.
  std::span<char> room() const { return {data_.get() + size_, capacity_ - size_}; }
  void added(std::size_t count) { size_ += count; }

  /// The body has ended: Malformed when its coding has not.
  Outcome finish() const;

  std::string_view bytes() const { return {data_.get(), size_}; }
  /// After NoBudget: the budget that lacked the bytes.
  ByteBudget& lacking() const { return *lacking_; }
  /// Another body waits for bytes that this one holds.
  bool is_wanted() const { return share_.is_wanted(); }

  void clear();

 private:
  Outcome add_decoded(std::string_view& piece);
  Outcome grow(std::size_t size);
  Outcome hold(std::size_t capacity, ByteBudget& budget);

  BodyBudgets& budgets_;
  ByteBudget* lacking_ = nullptr;
  Plan plan_;
  ByteShare share_;  // outlives the bytes
  std::unique_ptr<char[]> data_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
  std::size_t discarded_ = 0;
  std::optional<Gunzip> gunzip_;
};

}  // namespace fitgauge::http
