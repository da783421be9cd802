#pragma once

#include "api/resources.hpp"
#include "base/worker_pool.hpp"
#include "plant/kind.hpp"

namespace fitgauge::connections {

/// A connection as its settings make it.
struct Definition {
  std::string name{};
  std::string kind{};
  std::string text{};   ///< JSON, as stored
  std::string shown{};  ///< text without its secrets
  Settings settings{};
  bool is_read_only = false;  ///< belongs to the configuration file
  std::string fault{};        ///< why it was not started; empty: it runs
};

/// Letters, digits, - and _, 1 to 63 of them. @errors PathMalformed
Result<void> check_name(std::string_view name);

/// Whether a setting is never shown.
bool is_secret(std::string_view setting);

/// Adds the values of `before` that `body` leaves out: its secrets, and a password for the same
/// broker and user.
void keep_secrets(JsonValue& body, const Definition& before);

/// @param body an object with `kind` and the settings of its kind.
/// @param allowed folders that it may use.
/// @errors PathMalformed; RequestInvalid with every bad field.
Result<Definition> read_definition(std::string name, const JsonValue& body,
                                   const FolderPermissions& allowed);

/// Returns why both must not run: one would store again what the other takes or writes. None: they
/// may.
std::optional<std::string> fault_of_both(const Definition& one, const Definition& other);

/// The most connections there may be.
inline constexpr std::size_t kMostConnections = 100;

/// All connections, from the configuration file and from the storage. Changes run in turn
/// on a separate thread; tests run beside them, those of one connection in turn. Thread-safe.
class Connections {
 public:
  /// Starts the connections of `configured` and of the storage. A stored connection that cannot be
  /// read, or must not run together with another one, is logged and shown as failing; one that has
  /// a name of the file or an unknown kind is only logged.
  /// @errors those of the storage.
  static Result<std::unique_ptr<Connections>> start(std::vector<Definition> configured,
                                                    Plant plant);
  /// Ends all connections and waits for them.
  ~Connections();
  Connections& operator=(Connections&&) = delete;  // neither copied nor moved

  Timestamp now() const { return plant_.clock.now(); }
  std::vector<ConnectionState> states() const;  ///< by name
  std::optional<ConnectionState> state(std::string_view name) const;

  /// Queues a task for the one thread that changes connections, or for those that test them. Does
  /// not block. @returns false if too many tasks wait.
  bool run(std::function<void()> work, bool is_test) {
    return (is_test ? tests_ : changes_).submit(std::move(work)).has_value();
  }

  // These wait, `test` up to half a minute for the other side, and are called inside of `run`.

  /// Stores a connection and starts it. @returns whether it is new. @errors RequestInvalid,
  /// PathMalformed, ConnectionReadOnly, those of JSON and storage.
  Result<bool> put(const std::string& name, std::string_view body,
                   const std::optional<std::string>& caller);
  /// Ends a connection and deletes its position.
  /// @errors ConnectionUnknown, ConnectionReadOnly, those of storage.
  Result<void> remove(const std::string& name, const std::optional<std::string>& caller);
  /// Sends again from a place, with the same ids.
  /// @errors ConnectionUnknown; RequestInvalid, also if it is incoming; those of JSON and storage.
  Result<void> replay(const std::string& name, std::string_view body);
  /// @errors ConnectionUnknown.
  Result<ConnectionTest> test(const std::string& name);

 private:
  struct Entry {
    Definition definition;
    std::unique_ptr<Worker> worker;  ///< none of a connection that was not started
  };

  explicit Connections(Plant plant);

  void begin(Definition definition);
  /// Removes a connection and waits until it has ended.
  void end(const std::string& key);
  /// Returns the connection whose name differs at most in upper and lower case.
  std::optional<Definition> find(std::string_view name) const;
  /// Returns why it must not run together with the other connections; none: it may.
  std::optional<std::string> fault_with_others(const Definition& definition) const;
  /// Returns name and text of the stored connection of such a name, which may not have started.
  /// Blocks. @errors those of storage.
  Result<std::optional<Definition>> find_stored(std::string_view name) const;
  /// @errors ConnectionUnknown.
  Result<Definition> named(std::string_view name) const;
  static ConnectionState state_of(const Entry& entry);

  const Plant plant_;
  mutable std::mutex mutex_;
  std::map<std::string, Entry> entries_;  ///< by name in lower case
  std::stop_source stopping_;
  std::set<std::string> under_test_;  ///< names; under mutex_
  std::condition_variable tested_;
  WorkerPool changes_;  // the last two: they use all above
  WorkerPool tests_;
};

/// /v1/connections: connections to other systems. @param all must outlive the routes.
void add_connections_routes(api::Routes& add, Connections& all);
/// Their components of /openapi.json.
void add_connection_schemas(api::Schemas& schemas);

}  // namespace fitgauge::connections
