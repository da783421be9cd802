#pragma once

#include "db/sqlite/checkpointer.hpp"
#include "db/sqlite/session.hpp"

namespace fitgauge::store::sqlite {

/// The writer's session with the checkpoints of what it commits. It closes last of all connections,
/// and so checkpoints.
class WriterSession final : public Session {
 public:
  WriterSession(const OpenOptions& options, const Clock& clock)
      : Session(options, clock, Mode::Write), checkpointer_(options) {
    checkpointer_.install(connection);
  }

  void tidy_up(WriterCounters& counters) override {
    counters.log_pages = static_cast<std::uint64_t>(checkpointer_.log_pages());
    checkpointer_.after_commit(connection);
  }

 private:
  Checkpointer checkpointer_;
};

}  // namespace fitgauge::store::sqlite
