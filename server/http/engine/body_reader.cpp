#include "http/engine/body_reader.hpp"

#include "http/request.hpp"

namespace fitgauge::http {

void BodyReader::clear() {
  data_.reset();
  spooled_ = MappedFile();
  gunzip_.reset();
  share_ = ByteShare();
  size_ = capacity_ = discarded_ = let_go_ = 0;
}

/// Grows in few steps: the last one has room for every body within the limit.
BodyReader::Outcome BodyReader::grow(std::size_t size) {
  if (size > plan_.limit) return Outcome::TooLarge;
  const std::size_t part = std::min(BodyBudgets::kPart, plan_.limit);
  if (size > part) return hold(plan_.limit, budgets_.wholes);
  if (size > kFree) return hold(part, budgets_.parts);
  return hold(std::max(size, std::min(2 * capacity_, kFree)), budgets_.parts);
}

BodyReader::Outcome BodyReader::hold(std::size_t capacity, ByteBudget& budget) {
  ByteShare share;
  if (capacity > kFree) {
    if (!budget.try_take(capacity)) {
      lacking_ = &budget;
      return Outcome::NoBudget;
    }
    share = ByteShare(budget, capacity);
  }
  const std::size_t size = capacity + Request::kBodyPadding;
  const bool spools =
      plan_.spools && capacity > BodyBudgets::kPart && !budgets_.spool_folder.empty();
  auto spooled = spools ? MappedFile::unnamed(budgets_.spool_folder, size) : MappedFile();
  if (!spooled) return Outcome::DiskFull;
  // Not value-initialised: a page is touched only when bytes fill it.
  std::unique_ptr<char[]> grown(spooled->bytes() == nullptr ? new char[size] : nullptr);
  if (size_ > 0) std::memcpy(grown ? grown.get() : spooled->bytes(), data(), size_);
  data_ = std::move(grown);
  spooled_ = *std::move(spooled);
  share_ = std::move(share);
  capacity_ = capacity;
  return Outcome::Ok;
}

BodyReader::Outcome BodyReader::add(std::string_view& piece) {
  if (gunzip_) return add_decoded(piece);
  if (plan_.discard) {
    discarded_ += piece.size();
    piece = {};
    return discarded_ > plan_.limit ? Outcome::TooLarge : Outcome::Ok;
  }
  if (piece.size() > capacity_ - size_) {
    const Outcome outcome = grow(size_ + piece.size());
    if (outcome != Outcome::Ok) return outcome;
  }
  std::memcpy(data() + size_, piece.data(), piece.size());
  added(piece.size());
  piece = {};
  return Outcome::Ok;
}

BodyReader::Outcome BodyReader::add_decoded(std::string_view& piece) {
  std::array<char, 4096> thrown_away;
  while (!piece.empty() || gunzip_->has_more()) {
    if (!plan_.discard && size_ == capacity_) {
      if (capacity_ == plan_.limit) {
        // The output is full: the stream may end, but another byte is too much.
        char one = 0;
        const Gunzip::Step step = gunzip_->put(piece, {&one, 1});
        if (step.produced > 0) return Outcome::TooLarge;
        if (step.failed) return Outcome::Malformed;
        piece.remove_prefix(step.consumed);
        continue;
      }
      const Outcome outcome = grow(std::min(std::max<std::size_t>(4096, size_ + 1), plan_.limit));
      if (outcome != Outcome::Ok) return outcome;
    }
    const Gunzip::Step step =
        gunzip_->put(piece, plan_.discard ? std::span<char>(thrown_away) : room());
    if (step.failed) return Outcome::Malformed;
    piece.remove_prefix(step.consumed);
    if (plan_.discard) {
      discarded_ += step.produced;
      if (discarded_ > plan_.limit) return Outcome::TooLarge;
    } else {
      added(step.produced);
    }
  }
  return Outcome::Ok;
}

}  // namespace fitgauge::http
