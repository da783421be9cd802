#include <sqlite3.h>

#include "world.hpp"

// The memory of SQLite, which asks for most of it: free blocks by their size. All threads of the
// world are one to the kernel, so nothing is locked.

namespace fitgauge::simulation {
namespace {

constexpr std::size_t kLeast = 16;
constexpr std::size_t kChunk = std::size_t{1} << 20;

struct Block {
  std::size_t kind;
  Block* next;  ///< while it is free; given out, SQLite's bytes begin here
};
constexpr std::size_t kHead = offsetof(Block, next);

Block* free_blocks[128];  // by kind: four between two powers of two
char* chunk = nullptr;
std::size_t left = 0;

std::size_t kind_of(std::size_t size) {
  const std::size_t last = std::max(size, kLeast) - 1;
  const auto power = static_cast<std::size_t>(std::bit_width(last)) - 1;
  return 4 * (power - 3) + (last >> (power - 2)) % 4;
}
std::size_t size_of(std::size_t kind) { return (kind % 4 + 5) << (kind / 4 + 1); }

Block& block_of(void* bytes) {
  return *reinterpret_cast<Block*>(static_cast<char*>(bytes) - kHead);
}

int rounded(int size) { return (size + 7) & ~7; }

void* take(int bytes) {
  const std::size_t kind = kind_of(static_cast<std::size_t>(rounded(bytes)));
  Block*& free_block = free_blocks[kind];
  if (free_block != nullptr) return &std::exchange(free_block, free_block->next)->next;
  const std::size_t size = kHead + size_of(kind);
  if (size > kChunk) {
    auto* const own = static_cast<Block*>(std::malloc(size));
    if (own == nullptr) return nullptr;
    own->kind = kind;
    return &own->next;
  }
  if (size > left) {
    chunk = static_cast<char*>(std::malloc(kChunk));
    left = chunk == nullptr ? 0 : kChunk;
    if (chunk == nullptr) return nullptr;
  }
  left -= size;
  auto* const made = reinterpret_cast<Block*>(std::exchange(chunk, chunk + size));
  made->kind = kind;
  return &made->next;
}

void give_back(void* bytes) {
  if (bytes == nullptr) return;
  Block& block = block_of(bytes);
  block.next = std::exchange(free_blocks[block.kind], &block);
}

int size_taken(void* bytes) {
  return bytes == nullptr ? 0 : static_cast<int>(size_of(block_of(bytes).kind));
}

void* take_more(void* bytes, int size) {
  const int before = size_taken(bytes);
  if (size <= before) return bytes;
  void* const more = take(size);
  if (more == nullptr) return nullptr;
  std::memcpy(more, bytes, static_cast<std::size_t>(before));
  give_back(bytes);
  return more;
}

}  // namespace

void keep_memory_of_sqlite() {
  static const sqlite3_mem_methods methods{take,         give_back, take_more,
                                           size_taken,   rounded,   [](void*) { return SQLITE_OK; },
                                           [](void*) {}, nullptr};
  sqlite3_config(SQLITE_CONFIG_MALLOC, &methods);
  sqlite3_config(SQLITE_CONFIG_MEMSTATUS, 0);  // as db/sqlite has it, which comes too late here
}

}  // namespace fitgauge::simulation
