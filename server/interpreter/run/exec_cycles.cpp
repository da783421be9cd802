#include <fmt/format.h>

#include <limits>

#include "program/cycle_arguments.hpp"
#include "run/channel.hpp"
#include "run/channel_cycle_host.hpp"
#include "run/dotted_arguments.hpp"
#include "run/drilling.hpp"
#include "run/m_functions.hpp"
#include "run/motion_words.hpp"
#include "run/statements.hpp"
#include "run/transformation_cycles.hpp"
#include "run/values.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::CycleFamily;
using klartext::CycleValue;
using klartext::QRef;

NcError unavailable(CycleFamily family, int number) {
  return nc_error(fmt::format("cycle {} {} is not available",
                              family == CycleFamily::TchProbe ? "TCH PROBE" : "CYCL DEF", number));
}

bool is_text(const klartext::Expr& expr) {
  const auto* parameter = std::get_if<QRef>(&expr);
  return std::holds_alternative<klartext::Text>(expr) ||
         (parameter != nullptr && parameter->is_string());
}

/// The value of a cycle parameter that is a number; MAX is infinity, AUTO the feed of TOOL CALL.
NcResult<double> number_value(Channel& channel, const klartext::CycleParameter& written) {
  const machine::Modes& modes = channel.machine().state().modes;
  switch (written.kind) {
    case CycleValue::Max: return std::numeric_limits<double>::infinity();
    case CycleValue::Auto: return channel.contour.tool_feed;
    case CycleValue::Fu: {
      const auto value = number(channel, written.value);
      return value ? NcResult<double>(*value * channel.length_unit() * modes.spindle_rpm) : value;
    }
    case CycleValue::Fz: return nc_error("a feed FZ is not available in cycles");
    default: return number(channel, written.value);
  }
}

NcResult<probing::ArgumentValue> argument(Channel& channel, const klartext::CycleParameter& written,
                                          const probing::CycleParameter& parameter) {
  if (auto value = literal(channel.program(), written, parameter)) return *std::move(value);
  if (written.kind == CycleValue::Expression && is_text(written.value)) {
    auto value = text(channel, written.value);
    if (!value) return value.error();
    return probing::ArgumentValue(*std::move(value));
  }
  const auto value = number_value(channel, written);
  if (!value) return value.error();
  return probing::ArgumentValue(*value * scale_of(parameter.unit, channel.linked().is_inch()));
}

/// Tells the observer which cycle commands the machine while this lives.
class MovedByCycle {
 public:
  MovedByCycle(Channel& channel, int number) : observer_(channel.environment.observer) {
    observer_.moved_by_cycle(number);
  }
  MovedByCycle(const MovedByCycle&) = delete;
  MovedByCycle& operator=(const MovedByCycle&) = delete;
  ~MovedByCycle() { observer_.moved_by_cycle(0); }

 private:
  RunObserver& observer_;
};

/// A travel that ends before the nominal contact finds only material that lies nearer.
NcResult<void> note_short_travel(Channel& channel, const probing::Arguments& arguments) {
  const auto probe = channel.machine().state().probe_system();
  if (!probe || arguments.descriptor().find(probing::q(320)) == nullptr) return {};
  const double clearance = probe->data.set_up + arguments.number(320);
  if (probe->data.distance >= clearance) return {};
  return channel.note(
      fmt::format("DIST = {} mm ends before SET_UP + Q320 = {} mm: material in its nominal place "
                  "is not touched",
                  probe->data.distance, clearance));
}

NcResult<void> run_probing(Channel& channel, const probing::TouchProbeCycle& cycle,
                           probing::Arguments arguments) {
  if (auto completed = arguments.complete(); !completed) return from_cycle(completed.error());
  if (auto noted = note_short_travel(channel, arguments); !noted) return noted;
  channel.active_cycle.last_probing = cycle.descriptor.number;
  const MovedByCycle moved(channel, cycle.descriptor.number);
  ChannelCycleHost host(channel);
  const auto done = probing::run_cycle(cycle, std::move(arguments), channel.machine(), host);
  if (host.failure()) return *host.failure();
  if (!done) return from_cycle(done.error());
  return {};
}

/// Cycle parameters that are lengths (1/10 inch a minute for feeds) in drilling cycles; others are
/// times, angles and selections.
probing::Unit unit_of_drilling(int parameter) {
  switch (parameter) {
    case 200:
    case 201:
    case 202:
    case 203:
    case 204:
    case 205:
    case 212:
    case 213:
    case 239:
    case 256:
    case 257:
    case 258:
    case 259:
    case 344:
    case 379: return probing::Unit::Length;
    case 206:
    case 207:
    case 208:
    case 253: return probing::Unit::Feed;
    default: return probing::Unit::None;
  }
}

NcResult<void> define_drilling(Channel& channel, const klartext::Cycle& cycle,
                               const DrillingCycle& drilling) {
  DrillingDefinition definition{&drilling, {}};
  for (const auto& written : channel.program().view(cycle.parameters)) {
    const auto value = number_value(channel, written);
    if (!value) return value.error();
    const int parameter = written.parameter.number;
    definition.values[parameter] =
        *value * scale_of(unit_of_drilling(parameter), channel.linked().is_inch());
  }
  channel.active_cycle.definition = std::move(definition);
  channel.active_cycle.number = cycle.number;
  return {};
}

}  // namespace

NcResult<void> execute(Channel& channel, const klartext::Cycle& cycle) {
  if (const auto* probing = probing_cycle(cycle.family, cycle.number);
      probing != nullptr && !probing->descriptor.dotted) {
    probing::Arguments arguments(probing->descriptor);
    for (const auto& written : channel.program().view(cycle.parameters)) {
      // Not null: the linker has refused parameters that the cycle does not have.
      const auto& parameter = *find_parameter(probing->descriptor, written.parameter);
      auto value = argument(channel, written, parameter);
      if (!value) return value.error();
      arguments.set(parameter.id, *std::move(value));
    }
    return run_probing(channel, *probing, std::move(arguments));
  }
  const auto* drilling = drilling_cycle(cycle.number);
  if (cycle.family == CycleFamily::CyclDef && drilling != nullptr) {
    return define_drilling(channel, cycle, *drilling);
  }
  return unavailable(cycle.family, cycle.number);
}

NcResult<void> execute_parts(Channel& channel, std::uint32_t first, std::uint32_t last) {
  const auto blocks = channel.program().blocks();
  const auto& opening = std::get<klartext::CyclePart>(blocks[first].statement);
  if (!is_available(opening.family, opening.number, true)) {
    return unavailable(opening.family, opening.number);
  }
  if (const auto* probing = probing_cycle(opening.family, opening.number)) {
    auto arguments = dotted_arguments(channel, *probing, first, last);
    if (!arguments) return arguments.error();
    return run_probing(channel, *probing, *std::move(arguments));
  }
  std::vector<klartext::Word> words;
  for (std::uint32_t i = first; i <= last; ++i) {
    const auto* part = std::get_if<klartext::CyclePart>(&blocks[i].statement);
    if (part == nullptr) continue;
    const auto view = channel.program().view(part->words);
    words.insert(words.end(), view.begin(), view.end());
  }
  return execute_transformation(channel, opening.number, words);
}

NcResult<Next> call_active_cycle(Channel& channel) {
  const auto& definition = channel.active_cycle.definition;
  if (const auto* program = std::get_if<ControlPath>(&definition)) {
    return call_program(channel, *program);
  }
  const auto* drilling = std::get_if<DrillingDefinition>(&definition);
  if (drilling == nullptr) return nc_error(1027);
  if (auto done = channel.contour.finish(channel); !done) return done.error();
  const MovedByCycle moved(channel, channel.active_cycle.number);
  if (auto done = drill(channel, *drilling); !done) return done.error();
  return Next{};
}

NcResult<Next> execute(Channel& channel, const klartext::CycleCall& call) {
  if (call.kind == klartext::CycleCallKind::Pattern) {
    return nc_error("CYCL CALL PAT is not available: point patterns are not simulated");
  }
  const auto words = read_words(channel, call.words);
  if (!words) return words.error();
  if (auto done = start_m_functions(channel, words->m); !done) return done.error();
  if (call.kind == klartext::CycleCallKind::Position) {
    machine::AxisWords target;
    for (const machine::Axis axis : machine::kAllAxes) {
      const auto& word = words->axes[machine::index(axis)];
      if (!word) continue;
      target[axis] =
          word->incremental ? channel.machine().position()[axis] + word->value : word->value;
    }
    const auto feed = words->feed.value_or(machine::Feed::rapid());
    if (auto moved = checked(channel.machine().move({target, feed})); !moved) return moved.error();
  }
  auto next = call_active_cycle(channel);
  if (!next || next->kind != Next::Kind::Block) return next;
  return end_m_functions(channel, *words);
}

}  // namespace fitgauge::interpreter
