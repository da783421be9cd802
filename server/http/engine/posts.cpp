#include "http/engine/posts.hpp"

#include <algorithm>

#include "http/answer_batch.hpp"
#include "http/engine/io_thread.hpp"

namespace fitgauge::http {
namespace {

thread_local Posts* posts_of_this_thread = nullptr;

}  // namespace

Posts* Posts::kept() { return posts_of_this_thread; }

Posts::Posts() { posts_of_this_thread = this; }

Posts::~Posts() {
  posts_of_this_thread = nullptr;
  for (auto& [thread, functions] : threads_) {
    thread->post([functions = std::move(functions)] {
      for (const std::function<void()>& function : functions) function();
    });
  }
}

void Posts::add(IoThread& thread, std::function<void()> function) {
  const auto is_same = [&](const auto& entry) { return entry.first == &thread; };
  auto entry = std::find_if(threads_.begin(), threads_.end(), is_same);
  if (entry == threads_.end()) entry = threads_.insert(entry, {&thread, {}});
  entry->second.push_back(std::move(function));
}

AnswerBatch::AnswerBatch() : posts_(std::make_unique<Posts>()) {}
AnswerBatch::~AnswerBatch() = default;

}  // namespace fitgauge::http
