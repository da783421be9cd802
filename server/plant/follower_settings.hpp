#pragma once

#include "plant/log_follower.hpp"
#include "plant/settings.hpp"

namespace fitgauge::connections {

/// Describes `events`, the types of events that are sent.
template <class V>
void event_members(V& v, FollowerOptions& options) {
  v.optional("events", options.events,
             SomeOf{{kRecorded, "run.finished", "table.changed", "note.added"}},
             "What goes out; measurement.recorded when absent");
}

/// Describes the settings of every outgoing connection. Call it after event_members().
template <class V>
void follower_members(V& v, FollowerOptions& options) {
  v.optional("filter", options.filter, FilterForm{},
             "Which measurements go out; all that a gauge has measured when absent");
  v.optional("start", options.from_beginning, Choice<bool>{{{"now", false}, {"beginning", true}}},
             "Where a new connection begins; now when absent");
  v.optional("longest_wait_s", options.longest_wait, Within{1, 3600},
             "Between two attempts; 300 when absent");
  v.check([&](const auto&) {
    if (options.events.erase(std::string(kRecorded)) == 0) options.filter.verdicts.clear();
  });
}

}  // namespace fitgauge::connections
