#include "base/allowance.hpp"

#include <malloc.h>

namespace {

constinit thread_local std::int64_t held = 0;

/// With the word in which malloc keeps the size: of a small piece it is a third.
std::int64_t size_of(void* memory) {
  return static_cast<std::int64_t>(malloc_usable_size(memory) + sizeof(std::size_t));
}

template <class Take>
void* taken(const Take& take) {
  while (true) {
    if (void* const memory = take(); memory != nullptr) {
      held += size_of(memory);
      return memory;
    }
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

void give_back(void* memory) noexcept {
  if (memory == nullptr) return;
  held -= size_of(memory);
  std::free(memory);
}

}  // namespace

namespace fitgauge {

std::int64_t thread_memory() { return held; }

void hand_over_memory(std::int64_t bytes) { held += bytes; }

}  // namespace fitgauge

// Defines all forms, so that a sanitizer's runtime defines none: it would miss the others.

void* operator new(std::size_t size) {
  return taken([size] { return std::malloc(size == 0 ? 1 : size); });
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto align = static_cast<std::size_t>(alignment);
  return taken([=] { return std::aligned_alloc(align, (size + align - 1) / align * align); });
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept try {
  return operator new(size);
} catch (const std::bad_alloc&) {
  return nullptr;
}
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept
    try {
  return operator new(size, alignment);
} catch (const std::bad_alloc&) {
  return nullptr;
}
void* operator new[](std::size_t size) { return operator new(size); }
void* operator new[](std::size_t size, std::align_val_t a) { return operator new(size, a); }
void* operator new[](std::size_t size, const std::nothrow_t& n) noexcept {
  return operator new(size, n);
}
void* operator new[](std::size_t size, std::align_val_t a, const std::nothrow_t& n) noexcept {
  return operator new(size, a, n);
}

void operator delete(void* p) noexcept { give_back(p); }
void operator delete(void* p, std::size_t) noexcept { give_back(p); }
void operator delete(void* p, std::align_val_t) noexcept { give_back(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { give_back(p); }
void operator delete(void* p, const std::nothrow_t&) noexcept { give_back(p); }
void operator delete(void* p, std::align_val_t, const std::nothrow_t&) noexcept { give_back(p); }
void operator delete[](void* p) noexcept { give_back(p); }
void operator delete[](void* p, std::size_t) noexcept { give_back(p); }
void operator delete[](void* p, std::align_val_t) noexcept { give_back(p); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { give_back(p); }
void operator delete[](void* p, const std::nothrow_t&) noexcept { give_back(p); }
void operator delete[](void* p, std::align_val_t, const std::nothrow_t&) noexcept { give_back(p); }

namespace fitgauge {
namespace {

thread_local Allowance* current = nullptr;

}  // namespace

Allowance::Allowance(std::chrono::duration<double> time, std::size_t memory_bytes,
                     std::stop_token stop)
    : deadline_(std::chrono::steady_clock::now() +
                std::chrono::duration_cast<std::chrono::steady_clock::duration>(time)),
      memory_bytes_(static_cast<std::int64_t>(memory_bytes)),
      stop_(std::move(stop)),
      baseline_(thread_memory()) {}

Allowance::Spent Allowance::look() {
  if (spent_ != Spent::Nothing) return spent_;
  if (stop_.stop_requested()) {
    spent_ = Spent::Stop;
  } else if (thread_memory() - baseline_ > memory_bytes_) {
    spent_ = Spent::Memory;
  } else if (std::chrono::steady_clock::now() > deadline_) {
    spent_ = Spent::Time;
  } else if (looks_ != 0 && --looks_ == 0) {
    spent_ = at_look_;
  }
  return spent_;
}

Allowance::OfThread::OfThread(Allowance* allowance) { current = allowance; }
Allowance::OfThread::~OfThread() { current = nullptr; }

Allowance& Allowance::of_thread() {
  thread_local Allowance unlimited;
  return current != nullptr ? *current : unlimited;
}

}  // namespace fitgauge
