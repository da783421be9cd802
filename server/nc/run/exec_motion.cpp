#include "nc/run/channel.hpp"
#include "nc/run/m_functions.hpp"
#include "nc/run/positioning.hpp"
#include "nc/run/statements.hpp"
#include "nc/run/tool_orientation.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::Motion;

/// What the control takes into account and the simulated machine does not.
NcResult<void> note_what_has_no_effect(Channel& channel, const MotionWords& words) {
  if (!words.has_m(92)) return {};
  return channel.note("M92 counts from the machine datum, as M91: the setup has no second");
}

}  // namespace

NcResult<Next> execute(Channel& channel, const Motion& motion) {
  auto words = read_words(channel, motion.words);
  if (!words) return words.error();
  channel.contour.compensate(motion.compensation);
  if (channel.contour.drawing() != nullptr) {
    if (auto done = Positioning(channel, motion, *words).run(); !done) return done.error();
    return Next{};
  }
  if (auto noted = note_what_has_no_effect(channel, *words); !noted) return noted.error();
  if (auto done = start_m_functions(channel, words->m); !done) return done.error();
  if (auto done = orient_tool(channel, motion, *words); !done) return done.error();
  if (auto done = Positioning(channel, motion, *words).run(); !done) return done.error();
  return end_m_functions(channel, *words);
}

NcResult<Next> execute(Channel& channel, const klartext::MFunctions& functions) {
  const auto words = read_words(channel, functions.words);
  if (!words) return words.error();
  if (channel.contour.drawing() != nullptr) return Next{};
  if (auto done = start_m_functions(channel, words->m); !done) return done.error();
  return end_m_functions(channel, *words);
}

NcResult<Next> execute(Channel& channel, const klartext::Stop& stop) {
  const auto words = read_words(channel, stop.words);
  if (!words) return words.error();
  if (auto done = start_m_functions(channel, words->m); !done) return done.error();
  auto next = end_m_functions(channel, *words);
  if (!next || next->kind != Next::Kind::Block) return next;
  if (auto done = channel.programmed_stop("programmed stop"); !done) return done.error();
  return next;
}

}  // namespace fitgauge::interpreter
