#pragma once

#include <filesystem>

#include "network.hpp"
#include "plant/centre/forwarder.hpp"
#include "plant/connections.hpp"
#include "service/application.hpp"
#include "service/measurements/gauges_in_use.hpp"
#include "world.hpp"

namespace fitgauge::simulation {

/// A record as a list shows it.
struct Listed {
  std::string id{};
  std::string part{};
  std::string corrects{};  ///< the id of the record that it corrects
};

/// A machine with a service on it, as daemon/serve.cpp puts it together, less its HTTP server.
class Node {
 public:
  /// @param centre its host; empty: none. @param receiver the host of its webhook
  Node(std::string name, std::filesystem::path folder, std::string centre, std::string receiver);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  Machine machine{};
  const std::filesystem::path folder;

  bool is_up() const { return up_ != nullptr; }
  /// @returns whether it serves.
  bool start();
  /// Ends as on SIGTERM, or, when the machine is dead, leaves everything as it was at its death.
  void end();

  /// @param of the id of the record that it corrects; empty: none.
  /// @returns the id; none: there was no answer, or a refusal.
  std::optional<std::string> post(const std::string& part, const std::string& of);
  /// A note beside the record `of`. @returns as post().
  std::optional<std::string> add_note(const std::string& text, const std::string& of);
  /// The texts of the notes beside a record, by their ids.
  std::map<std::string, std::string> notes(const std::string& of);
  /// The records behind an id; none: it does not know the id, or cannot.
  std::optional<std::vector<Listed>> list(const std::string& after = {});
  bool backup(const std::filesystem::path& file);
  /// The newest signed head.
  std::string head();
  /// Why its proof that it has this record does not hold; empty: it holds.
  std::string prove(const std::string& id);
  /// The findings of verify. @param notes heads that it has to cover
  std::vector<std::string> verify(const std::map<std::string, std::string>& notes);
  /// Nothing waits to go out, and nothing has failed.
  bool is_quiet();
  bool is_ready();
  /// How its connections are, for people.
  std::string state();
  /// Its log.
  std::vector<std::string> told{};

  std::optional<Reply> answer(const Exchange& exchange);

 private:
  struct Up;
  const std::string centre_;
  const std::string receiver_;
  std::unique_ptr<Up> up_;
  int guests_ = 0;  ///< calls from outside under way
};

}  // namespace fitgauge::simulation
