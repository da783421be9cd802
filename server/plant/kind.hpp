#pragma once

#include "api/statistics/next_offset.hpp"
#include "plant/log_follower.hpp"

namespace fitgauge::connections {

/// Describes `events`, the types of events that are sent.
template <class V>
void event_members(V& v, FollowerOptions& options) {
  v.optional("events", options.events,
             SomeOf{{kRecorded, "run.finished", "table.changed", "note.added", api::kOffsetChanged,
                     api::kOffsetFailed}},
             "Events that are sent (default: measurement.recorded)");
}

/// Describes the settings of every outgoing connection. Call it after event_members().
template <class V>
void follower_members(V& v, FollowerOptions& options) {
  v.optional("filter", options.filter, FilterForm{},
             "Measurements that are sent (default: all measurements of gauges)");
  v.optional("start", options.from_beginning, Choice{"now", "beginning"},
             "Start of a new connection (default: now)");
  v.optional("longest_wait_s", options.longest_wait, Within{1, 3600},
             "Longest time between two attempts (default: 300)");
  v.check([&](const auto&) {
    if (options.events.erase(std::string(kRecorded)) == 0) options.filter.verdicts.clear();
  });
}

/// A folder that a connection takes files from, or writes files to.
struct FolderUse {
  std::filesystem::path folder{};
  std::vector<std::string> reads{};   ///< names of files, with * and ?
  std::vector<std::string> writes{};  ///< such names
};

/// The settings of one connection, as its kind has read them.
struct Settings {
  /// Starts the connection. @param plant must outlive it.
  std::function<std::unique_ptr<Worker>(const Plant& plant)> start;
  /// Tests the other side once, independently of the worker. Blocks up to half a minute.
  std::function<TestResult(const Plant& plant, const std::stop_token& stop)> test;
  std::optional<FollowerOptions> follower{};  ///< of an outgoing connection
  std::optional<FolderUse> folder{};          ///< of a folder in or out
};

/// A kind of connection: its settings, work and test are in its folder, its name is in kinds.inc.
struct Kind {
  std::string_view name;
  bool is_outgoing;
  api::schema::Fields (*fields)();
  /// @param body reports every bad field to its errors.
  Settings (*read)(ReadSettings& body, const std::string& name);
};

/// The kinds of this build, in the order of kinds.inc.
const std::vector<Kind>& kinds();

/// A kind whose folder defines for its options
///   `void members(V&, Options&)`, see base/json/body.hpp,
///   `make(const Options&, const Plant&)`, the Worker or, of options with a follower, the Outlet,
///   `TestResult test_of(const Options&, const Plant&, const std::stop_token&)`,
/// and `FolderUse folder_of(const Options&)` if it uses a folder.
template <class Options>
Kind kind_of(std::string_view kind) {
  static constexpr bool kFollows = requires(Options options) { options.follower; };
  const auto fields = [] {
    Options options;
    api::BodySchema describe(api::Side::Order);
    members(describe, options);
    return describe.fields();
  };
  const auto read = [](ReadSettings& body, const std::string& name) {
    const auto options = std::make_shared<Options>();
    Settings settings;
    if constexpr (kFollows) {
      options->follower.name = name;
      members(body, *options);
      settings.follower = options->follower;
      settings.start = [options](const Plant& plant) -> std::unique_ptr<Worker> {
        return follow(options->follower, make(*options, plant), plant);
      };
    } else {
      options->name = name;
      members(body, *options);
      settings.start = [options](const Plant& plant) { return make(*options, plant); };
    }
    if constexpr (requires { folder_of(*options); }) settings.folder = folder_of(*options);
    settings.test = [options](const Plant& plant, const std::stop_token& stop) {
      return test_of(*options, plant, stop);
    };
    return settings;
  };
  return {kind, kFollows, fields, read};
}

}  // namespace fitgauge::connections
