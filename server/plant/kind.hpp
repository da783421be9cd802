#pragma once

#include "api/statistics/next_offset.hpp"
#include "plant/log_follower.hpp"
#include "plant/plant.hpp"
#include "plant/settings.hpp"

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

/// The settings of one connection, as its kind has read them.
class Settings {
 public:
  Settings() = default;
  Settings(const Settings&) = delete;
  Settings& operator=(const Settings&) = delete;
  virtual ~Settings() = default;

  /// Starts the connection. @param plant must outlive it.
  virtual std::unique_ptr<Worker> start(const Plant& plant) const = 0;
  /// Tests the other side once, independently of the worker. Blocks up to half a minute.
  virtual ConnectionTest test(const Plant& plant, const std::stop_token& stop) const = 0;
  /// Returns the options of an outgoing connection; null for others.
  virtual const FollowerOptions* follower() const = 0;
};

/// A kind of connection: its settings, work and test are in its folder, its name is in kinds.inc.
struct Kind {
  std::string_view name;
  api::schema::Fields (*fields)();
  /// @param body reports every bad field to its errors.
  std::shared_ptr<const Settings> (*read)(ReadSettings& body, const std::string& name);
};

/// The kinds of this build, in the order of kinds.inc.
const std::vector<Kind>& kinds();

/// The settings of a kind. Its folder defines for its options
///   `void members(V&, Options&)`, see base/json/body.hpp,
///   `make(const Options&, const Plant&)`, the Worker or, of options with a follower, the Outlet,
///   `ConnectionTest test_of(const Options&, const Plant&, const std::stop_token&)`.
template <class Options>
class SettingsOf final : public Settings {
 public:
  static api::schema::Fields fields() {
    Options options;
    api::BodySchema describe(api::Side::Order);
    members(describe, options);
    return describe.fields();
  }
  static std::shared_ptr<const Settings> read(ReadSettings& body, const std::string& name) {
    const auto settings = std::make_shared<SettingsOf>();
    if constexpr (kFollows) {
      settings->options_.follower.name = name;
    } else {
      settings->options_.name = name;
    }
    members(body, settings->options_);
    return settings;
  }

  std::unique_ptr<Worker> start(const Plant& plant) const override {
    if constexpr (kFollows) {
      return std::make_unique<LogFollower>(options_.follower, make(options_, plant), plant);
    } else {
      return make(options_, plant);
    }
  }
  ConnectionTest test(const Plant& plant, const std::stop_token& stop) const override {
    return test_of(options_, plant, stop);
  }
  const FollowerOptions* follower() const override {
    if constexpr (kFollows) return &options_.follower;
    return nullptr;
  }

 private:
  static constexpr bool kFollows = requires(Options options) { options.follower; };
  Options options_;
};

template <class Options>
Kind kind_of(std::string_view name) {
  return {name, SettingsOf<Options>::fields, SettingsOf<Options>::read};
}

}  // namespace fitgauge::connections
