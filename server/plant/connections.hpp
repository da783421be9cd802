#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "base/worker_pool.hpp"
#include "plant/definition.hpp"
#include "plant/workers.hpp"

namespace fitgauge::connections {

/// The most connections there may be.
inline constexpr std::size_t kMostConnections = 100;

/// All connections: those of the configuration file and those that are stored, each at work.
/// Changes and tests are made one after the other on a thread of their own. Thread-safe.
class Connections {
 public:
  /// Starts what `configured` and the storage have. A stored one that cannot be read, or that has
  /// the name of one of the file, is told to the log and not started.
  /// @errors those of the storage.
  static Result<std::unique_ptr<Connections>> start(std::vector<Definition> configured,
                                                    Surroundings around);
  /// Ends all connections and waits for them.
  ~Connections();
  Connections(const Connections&) = delete;
  Connections& operator=(const Connections&) = delete;

  std::vector<app::ConnectionState> states() const;
  /// For the resources; used no longer than this.
  app::ConnectionCalls calls();

 private:
  struct Known {
    Definition definition;
    bool is_read_only = false;
  };
  struct Entry {
    Known known;
    std::unique_ptr<Worker> worker;
  };

  explicit Connections(Surroundings around);

  void begin(Definition definition, bool is_read_only);
  /// Takes a connection out and waits until it has ended.
  void end(const std::string& key);
  std::optional<Known> find(std::string_view name) const;
  static app::ConnectionState state_of(const Entry& entry);

  // On the thread.
  Result<bool> put(const app::ConnectionCalls::Put& order);
  Result<void> remove(const std::string& name);
  Result<app::ConnectionTest> test(const std::string& name);

  const Surroundings around_;
  mutable std::mutex mutex_;
  std::map<std::string, Entry> entries_;  ///< by name in lower case
  std::stop_source stopping_;
  WorkerPool changes_;  // last: it uses all above
};

}  // namespace fitgauge::connections
